// Clearances, and edges of tools beside the cells that are to feel them.
#include "app/plausibility/list.hpp"
#include "app/plausibility/tool_gap.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::app {

namespace {

std::string side(const evaluate::Clearance& clearance) {
  return clearance.name.empty() ? "" : clearance.name + " ";
}

/// An edge of a tool that stands at the workpiece.
struct Edge {
  const input::Tool* tool = nullptr;
  double radius = 0.0, spacing = 0.0; ///< m
};

/// The sharpest arc of each tool over the cells there, where it lies no further from the workpiece than that
/// is wide.
std::vector<Edge> edges(const input::Case& input, const ExplicitSolver<2>& solver) {
  const StartingSurface<2> surface(solver);
  const double reach = 0.5 * smaller_side(input);
  std::vector<Edge> list;
  for (const input::Tool& tool : input.tools) {
    Edge sharpest{&tool, INFINITY, 0.0};
    for (const CurvePiece& piece : tool.outline.pieces) {
      if (!piece.is_arc() || piece.sweep() < 0.0 || piece.radius >= sharpest.radius) continue;
      const auto near = surface.nearest(piece.point(0.5));
      if (near.distance > reach) continue;
      sharpest.radius = piece.radius;
      sharpest.spacing = std::min(near.spacing, adapted_spacing(input));
    }
    if (sharpest.spacing > 0.0) list.push_back(sharpest);
  }
  return list;
}

} // namespace

Vec2 led_stroke(const ExplicitSolver<2>& solver, const input::BlankingReport& asked, double t) {
  const auto& tools = solver.conditions().contact.tools();
  Vec2 stroke = tools[as<ToolIndex>(asked.punch)].led_displacement(t);
  for (const std::size_t die : asked.dies)
    stroke -= tools[as<ToolIndex>(die)].led_displacement(t) / static_cast<double>(asked.dies.size());
  return stroke;
}

std::vector<evaluate::Clearance> clearances(const input::Case& input, const ExplicitSolver<2>& solver,
                                            const input::BlankingReport& asked) {
  evaluate::CutTools cut;
  cut.punch = evaluate::points_of(input.tools[asked.punch].outline, Vec2::Zero());
  for (const std::size_t die : asked.dies)
    for (const Vec2& x : evaluate::points_of(input.tools[die].outline, Vec2::Zero())) cut.die.push_back(x);
  const Vec2 stroke = led_stroke(solver, asked, input.time.end);
  if (!(stroke.norm() > 0.0)) return {};
  cut.direction = stroke.normalized();
  return evaluate::find_clearances(cut, evaluate::points_of(input.domain.outer, Vec2::Zero()));
}

namespace {

std::vector<evaluate::Clearance> reported(const input::Case& input, const ExplicitSolver<2>& solver) {
  if (!input.report.blanking) return {};
  return clearances(input, solver, *input.report.blanking);
}

/// Of a cut whose clearances are sound: how wide, how far the punch goes, how many cells.
void doubt_cut(const input::Case& input, const ExplicitSolver<2>& solver, const evaluate::Clearance& one,
               Doubts& doubts) {
  constexpr double wide = 0.5, shallow = 0.005, few = 4.0; // of the thickness, cells
  if (one.gap > wide * one.thickness)
    doubts.push_back(doubt_about(input, "report.blanking",
                                 fmt::format("{}clearance of {:.0f}% of the thickness, where 2 to 15% are "
                                             "usual: the sheet is bent into the gap rather than cut",
                                             side(one), 100.0 * one.gap / one.thickness)));
  const input::BlankingReport& asked = *input.report.blanking;
  const contact::Tool<2>& punch = solver.conditions().contact.tools()[as<ToolIndex>(asked.punch)];
  double stroke = 0.0; // the farthest: a punch may come back
  constexpr int samples = 64;
  for (int k = 1; k <= samples; ++k)
    stroke = std::max(stroke, led_stroke(solver, asked, k * input.time.end / samples).norm());
  if ((!punch.drive || punch.drive->spring) && stroke < shallow * one.thickness)
    doubts.push_back(
        doubt_about(input, fmt::format("tools.{}.velocity", punch.name),
                    fmt::format("{} goes {:.3g} mm by time.end, {:.2g}% of the thickness: nothing is cut",
                                punch.name, 1e3 * stroke, 100.0 * stroke / one.thickness)));
  const double spacing = std::min(input.cloud.at(one.at), adapted_spacing(input));
  if (one.thickness < few * spacing)
    doubts.push_back(doubt_about(
        input, "cloud.spacing",
        fmt::format(
            "{:.2g} cells over the thickness of {:.3g} mm, expected {:g} at least, better 20 where it "
            "is cut (cloud.refine, adapt.indicator)",
            one.thickness / spacing, 1e3 * one.thickness, few)));
}

/// Of tools of a cut none of which is led or has a mass.
void doubt_rest(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts) {
  if (!input.report.blanking || !waits_for_tools(input, solver)) return;
  const auto stands = [&](std::size_t index) {
    const input::Tool& tool = input.tools[index];
    return !tool.drive && !input::moves(tool.velocity);
  };
  const input::BlankingReport& asked = *input.report.blanking;
  if (!stands(asked.punch) || !std::all_of(asked.dies.begin(), asked.dies.end(), stands)) return;
  const std::string& punch = input.tools[asked.punch].name;
  doubts.push_back(doubt_about(
      input, "tools." + punch,
      fmt::format("{} stands still, and so does the die: nothing is cut, expected tools.{}.velocity", punch,
                  punch)));
}

} // namespace

void doubt_edges(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts) {
  const double touching = 1e-6; // of the thickness
  doubt_rest(input, solver, doubts);
  const std::vector<evaluate::Clearance> all = reported(input, solver);
  if (!all.empty()) doubt_cut(input, solver, all.front(), doubts);
  for (const evaluate::Clearance& one : all) {
    if (one.gap > touching * one.thickness) continue;
    const std::string punch = input.tools[input.report.blanking->punch].name;
    doubts.push_back(doubt_about(
        input, "report.blanking",
        one.gap < -touching * one.thickness
            ? fmt::format("{}{} and the die overlap by {:.3g} mm across the cut, expected a clearance: 2 to "
                          "15% of the "
                          "thickness are usual",
                          side(one), punch, -1e3 * one.gap)
            : fmt::format(
                  "no {}clearance between {} and the die: metal between their edges cannot part; 2 to 15% of "
                  "the thickness are usual",
                  side(one), punch)));
  }
  for (const Edge& edge : edges(input, solver)) {
    // A cut whose cells are as wide everywhere is asked for: its table alone makes those at the edge fine.
    constexpr double uniform = 0.75; // share of the widest cells
    if (input.cutting && edge.spacing > uniform * input.cloud.spacing) continue;
    doubt_arc(input, edge.tool->name, edge.radius, edge.spacing, doubts);
  }
}

void doubt_arc(const input::Case& input, const std::string& tool, double radius, double spacing,
               Doubts& doubts) {
  constexpr double felt = 2.0, rounding = 1e-6; // spacings
  if (radius >= (felt - rounding) * spacing) return;
  doubts.push_back(doubt_about(
      input, fmt::format("tools.{}", tool),
      fmt::format(
          "its arc of {:.3g} mm is {:.1f} spacings of the nodes that meet it, where fewer than {:g} hardly "
          "feel that it is round: refine there (adapt.tool_spacing, cloud.refine) to {:.2g} mm",
          1e3 * radius, radius / spacing, felt, 1e3 * radius / 4.0)));
}

std::vector<std::pair<std::string, std::string>> tool_measures(const input::Case& input,
                                                               const ExplicitSolver<2>& solver) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const evaluate::Clearance& one : reported(input, solver))
    lines.emplace_back("clearance", fmt::format("{}{:.4g} mm, {:.3g}% of {:.4g} mm", side(one), 1e3 * one.gap,
                                                100.0 * one.gap / one.thickness, 1e3 * one.thickness));
  const StartingSurface<2> surface(solver);
  for (const contact::Tool<2>& tool : solver.conditions().contact.tools()) {
    constexpr double rounding = 1e-12; // m
    const double gap = surface.gap(*tool.shape, Vec2::Zero()).distance;
    lines.emplace_back("gap",
                       fmt::format("{} {:.4g} mm", tool.name, std::abs(gap) < rounding ? 0.0 : 1e3 * gap));
  }
  for (const Edge& edge : edges(input, solver))
    lines.emplace_back("edge", fmt::format("{} radius {:.4g} mm, {:.1f} spacings", edge.tool->name,
                                           1e3 * edge.radius, edge.radius / edge.spacing));
  return lines;
}

} // namespace cnem::app
