#include "evaluate/blanking.hpp"
#include "core/index.hpp"

#include "evaluate/blanking_parts.hpp"
#include "evaluate/force_stroke.hpp"
#include "mechanics/statics/rigid_motion.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

namespace cnem::evaluate {

namespace {

/// The part with the most volume where t is in a band; −1 when there is none.
std::int32_t part_in(const CutTools& tools, const CutSheet& sheet, double from, double to) {
  std::map<std::int32_t, double> volume;
  for (std::size_t i = 0; i < sheet.position.size(); ++i)
    if (const double t = tools.across(sheet.position[i]); t >= from && t <= to)
      volume[sheet.part[i]] += sheet.volume[i];
  std::int32_t most = -1;
  for (const auto& [part, v] : volume)
    if (most < 0 || v > volume[most]) most = part;
  return most;
}

/// A body's shape by least squares of s over t: slope of a line, or height of an arc.
struct Shape {
  double angle = std::numeric_limits<double>::quiet_NaN();
  double dishing = std::numeric_limits<double>::quiet_NaN();
};
struct Sample {
  double t = 0.0, s = 0.0, weight = 0.0;
};
/// plane: t of a plane of symmetry, about which the arc is even.
Shape shape_of(const std::vector<Sample>& samples, bool arc, std::optional<double> plane) {
  double mean = 0.0, weight = 0.0, low = INFINITY, high = -INFINITY;
  for (const Sample& x : samples) {
    mean += x.weight * x.t;
    weight += x.weight;
    low = std::min(low, x.t);
    high = std::max(high, x.t);
  }
  Shape shape;
  if (samples.size() < 3 || !(high > low)) return shape;
  mean = plane.value_or(mean / weight);
  const double half = plane ? std::max(high - mean, mean - low) : 0.5 * (high - low);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Sample& x : samples) {
    const double t = (x.t - mean) / half;
    const Eigen::Vector3d row(1.0, plane ? 0.0 : t, arc ? t * t : 0.0);
    normal += x.weight * row * row.transpose();
    right += x.weight * x.s * row;
  }
  for (Eigen::Index k = 0; k < 3; ++k)
    if (normal(k, k) == 0.0) normal(k, k) = weight; // what is not asked for stays zero
  const Eigen::Vector3d fit = normal.ldlt().solve(right);
  if (!plane) shape.angle = std::atan(fit[1] / half);
  if (arc) shape.dishing = -fit[2];
  return shape;
}

std::vector<char> nodes_on_planes(const Supports<2>& supports, const Vec2& direction, std::size_t nodes) {
  std::vector<char> on(nodes, 0);
  for (const Support<2>& support : supports.list())
    if (along_the_cut(support, direction))
      for (const NodeIndex i : support.nodes) on[index_of(i)] = 1;
  return on;
}

double largest_of(const Fields<2>& displacement, const std::vector<std::int32_t>& part, std::int32_t wanted) {
  double most = 0.0;
  for (std::size_t i = 0; i < part.size(); ++i)
    if (part[i] == wanted) most = std::max(most, std::hypot(displacement[0][i], displacement[1][i]));
  return most;
}

} // namespace

std::vector<PieceIndex> other_pieces(const input::Domain& domain,
                                     const IndexedVector<PieceIndex, std::string>& names) {
  std::vector<PieceIndex> others;
  if (domain.block || domain.faceted) return others;
  for (const PieceIndex piece : names.indices()) {
    const std::string& name = names[piece];
    const bool end = domain.sweep && std::ranges::count(domain.sweep->ends, name) > 0;
    if (name != input::Adaptation::fracture_piece && !end &&
        std::ranges::none_of(domain.outer.pieces, [&](const CurvePiece& part) { return part.name == name; }))
      others.push_back(piece);
  }
  return others;
}

std::vector<Vec2> points_of(const Curve& curve, const Vec2& shift) {
  constexpr int divisions = 32;
  std::vector<Vec2> points;
  for (const CurvePiece& piece : curve.pieces)
    for (int k = 0; k < (piece.is_arc() ? divisions : 1); ++k)
      points.push_back(piece.point(k / double(divisions)) + shift);
  return points;
}

double thickness_at(const CutTools& tools, std::span<const std::vector<Vec2>> outlines, double t) {
  double low = INFINITY, high = -INFINITY;
  for (const std::vector<Vec2>& polygon : outlines)
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      const double ta = tools.across(a) - t, tb = tools.across(b) - t;
      if ((ta < 0.0) == (tb < 0.0)) continue;
      const double share = ta / (ta - tb), s = (1.0 - share) * tools.along(a) + share * tools.along(b);
      low = std::min(low, s);
      high = std::max(high, s);
    }
  return high > low ? high - low : 0.0;
}

std::vector<Clearance> find_clearances(const CutTools& tools, const std::vector<Vec2>& outline) {
  std::vector<Clearance> list;
  double low = INFINITY, high = -INFINITY; // of the punch
  for (const Vec2& x : tools.punch) {
    low = std::min(low, tools.across(x));
    high = std::max(high, tools.across(x));
  }
  double top = INFINITY, bottom = -INFINITY; // of the sheet; what lies a sheet further down is no edge
  for (const Vec2& x : outline) {
    top = std::min(top, tools.along(x));
    bottom = std::max(bottom, tools.along(x));
  }
  const double deepest = 2.0 * bottom - top;
  for (const double side : {-1.0, 1.0}) {
    const double reach = side > 0.0 ? high : -low, middle = side * 0.5 * (low + high);
    double edge = INFINITY;
    for (const Vec2& x : tools.die)
      if (const double t = side * tools.across(x); t > middle && tools.along(x) < deepest)
        edge = std::min(edge, t);
    if (!std::isfinite(edge)) continue; // no die on this side
    const double gap = side * 0.5 * (reach + edge), thickness = thickness_at(tools, {&outline, 1}, gap);
    if (thickness > 0.0)
      list.push_back({side < 0.0 ? "left" : "right", edge - reach, thickness,
                      tools.place(gap, 0.5 * (top + bottom)), tools.place(side, 0.0)});
  }
  if (list.size() == 1) list.front().name.clear();
  return list;
}

std::optional<CutEdges> edges_on(const CutTools& tools, double side) {
  double reach = -INFINITY, edge = INFINITY;
  for (const Vec2& x : tools.punch) reach = std::max(reach, side * tools.across(x));
  for (const Vec2& x : tools.die)
    if (const double t = side * tools.across(x); t >= reach - 1e-9 * std::abs(reach))
      edge = std::min(edge, t);
  if (!std::isfinite(reach) || !std::isfinite(edge)) return std::nullopt;
  return CutEdges{side, side * reach, side * edge};
}

Cut cut_between(const CutTools& tools, const CutSheet& sheet, const CutEdges& edges, double thickness) {
  Cut cut;
  static_cast<CutEdges&>(cut) = edges;
  cut.thickness = thickness;
  const double inner = cut.punch - cut.side * thickness, outer = cut.die + cut.side * thickness;
  cut.slug = part_in(tools, sheet, std::min(inner, cut.punch), std::max(inner, cut.punch));
  cut.skeleton = part_in(tools, sheet, std::min(outer, cut.die), std::max(outer, cut.die));
  return cut;
}

std::vector<Cut> find_cuts(const CutTools& tools, const CutSheet& sheet) {
  std::vector<Cut> cuts;
  for (const double side : {-1.0, 1.0}) {
    const auto edges = edges_on(tools, side);
    if (!edges) continue;
    const double thickness = thickness_at(tools, {&sheet.initial_outline, 1}, edges->middle());
    if (thickness > 0.0) cuts.push_back(cut_between(tools, sheet, *edges, thickness));
  }
  if (cuts.size() == 2) {
    cuts[0].name = "left";
    cuts[1].name = "right";
  }
  return cuts;
}

std::vector<BodySpringback> springback_of_bodies(std::span<const Cut> cuts, const CutTools& tools,
                                                 const CutSheet& sheet, const Fields<2>& displacement,
                                                 const Field& mass) {
  std::vector<BodySpringback> bodies;
  const auto add = [&](const std::string& name, std::int32_t part, bool arc, auto&& inside) {
    BodySpringback body;
    body.body = name;
    std::vector<Sample> before, after;
    std::optional<double> plane;
    for (std::size_t i = 0; i < sheet.position.size(); ++i) {
      const double t = tools.across(sheet.position[i]);
      if (sheet.part[i] != part || !inside(t)) continue;
      if (sheet.on_plane[i]) plane = t;
      const Vec2 move(displacement[0][i], displacement[1][i]);
      body.largest = std::max(body.largest, move.norm());
      before.push_back({t, tools.along(sheet.position[i]), mass[i]});
      after.push_back(
          {tools.across(sheet.position[i] + move), tools.along(sheet.position[i] + move), mass[i]});
    }
    if (before.empty()) return;
    const Shape a = shape_of(before, arc, plane), b = shape_of(after, arc, plane);
    body.angle_before = a.angle;
    body.angle_change = b.angle - a.angle;
    body.dishing_before = a.dishing;
    body.dishing_change = b.dishing - a.dishing;
    bodies.push_back(std::move(body));
  };
  if (cuts.empty()) return bodies;
  add("slug", cuts.front().slug, true, [&](double t) {
    return std::all_of(cuts.begin(), cuts.end(),
                       [&](const Cut& cut) { return cut.side * (t - cut.die) <= 0.0; });
  });
  for (const Cut& cut : cuts)
    add(cut.name.empty() ? "skeleton" : fmt::format("skeleton_{}", cut.name), cut.skeleton, false,
        [&](double t) { return cut.side * (t - cut.punch) >= 0.0; });
  return bodies;
}

std::vector<MeasuredHeights> measured_beside(const std::vector<ShearedFace>& faces,
                                             const std::vector<input::MeasuredFace>& measured) {
  std::vector<MeasuredHeights> list;
  for (const ShearedFace& face : faces)
    for (const input::MeasuredFace& one : measured) {
      const auto same = [&](const MeasuredHeights& known) { // of a section at another angle
        return known.cut == face.cut && known.body == face.body;
      };
      if (one.body != face.body || std::any_of(list.begin(), list.end(), same)) continue;
      MeasuredHeights& heights = list.emplace_back(MeasuredHeights{face.cut, face.body});
      const auto set = [&](double& height, const std::optional<input::MeasuredHeight>& given) {
        if (given) height = given->share ? given->value * face.thickness : given->value;
      };
      set(heights.rollover, one.rollover);
      set(heights.burnish, one.burnish);
      set(heights.fracture, one.fracture);
      set(heights.burr, one.burr);
      if (one.fracture_angle) heights.fracture_angle = *one.fracture_angle;
    }
  return list;
}

BlankingResult evaluate_blanking(const input::Case& input, const results::Snapshot<2>& shot,
                                 const Supports<2>& supports, const Springback* springback,
                                 const results::HistoryTable& history) {
  BlankingResult result;
  result.time = shot.state.time;
  if (input.analysis.kinematics == input::Analysis::Kinematics::axisymmetric) {
    result.force_unit = "N";
    result.work_unit = "J";
  }
  const auto each_part = [&] {
    for (std::int32_t part = 0; springback && part < springback->bodies; ++part) {
      result.springback.emplace_back().body = fmt::format("body_{}", part + 1);
      result.springback.back().largest = largest_of(springback->displacement, springback->body, part);
    }
  };
  if (!input.report.blanking) {
    each_part();
    return result;
  }
  const input::BlankingReport& asked = *input.report.blanking;
  result.punch = input.tools[asked.punch].name;
  result.parallel = asked.parallel;
  const double now = shot.state.time;
  CutTools tools;
  Vec2 stroke = shot.contact.displacement(asked.punch, now);
  tools.punch = points_of(input.tools[asked.punch].outline, stroke);
  for (const std::size_t die : asked.dies) {
    result.dies.push_back(input.tools[die].name);
    const Vec2 moved = shot.contact.displacement(die, now);
    const std::vector<Vec2> points = points_of(input.tools[die].outline, moved);
    tools.die.insert(tools.die.end(), points.begin(), points.end());
    stroke -= moved / static_cast<double>(asked.dies.size());
  }
  result.stroke = stroke.norm();
  if (!(result.stroke > 0.0)) {
    result.note = fmt::format("{} has not moved", result.punch);
    each_part();
    return result;
  }
  tools.direction = stroke.normalized();
  result.direction_x = tools.direction.x();
  result.direction_y = tools.direction.y();
  if (history.rows() > 0)
    for (const input::Tool& tool : input.tools)
      result.forces.push_back(largest_force(force_curve(history, tool.name, result.punch, result.dies,
                                                        Vec3(tools.direction.x(), tools.direction.y(), 0.0)),
                                            tool.name));

  const auto& pieces = shot.cloud.piece_names;
  const auto piece = std::find(pieces.begin(), pieces.end(), input::Adaptation::fracture_piece);
  CutSheet sheet{places<2>(shot.state.node.position),
                 shot.cloud.facets,
                 piece == pieces.end() ? PieceIndex::none : as<PieceIndex>(piece - pieces.begin()),
                 {},
                 shot.approximation.node_volume,
                 nodes_on_planes(supports, tools.direction, shot.state.node.size()),
                 points_of(input.domain.outer, Vec2::Zero()),
                 other_pieces(input.domain, pieces),
                 places<2>(shot.state.node.initial_position),
                 broken_nodes(shot)};
  for (const std::size_t root : parts_of(shot.approximation.mechanics, sheet.position.size()))
    sheet.part.push_back(static_cast<std::int32_t>(root));
  const std::vector<Cut> cuts = find_cuts(tools, sheet);
  if (cuts.empty()) {
    result.note = fmt::format("no side of {} passes an edge of {} where there was sheet", result.punch,
                              fmt::join(result.dies, ", "));
    each_part();
    return result;
  }
  for (const Cut& cut : cuts)
    result.cut_length += result.force_unit == "N" ? 2.0 * std::numbers::pi * std::abs(cut.punch) : 1.0;
  result.smoothing = asked.smoothing.value_or(cuts.front().thickness / 50.0);
  for (const Cut& cut : cuts)
    for (ShearedFace& face : measure_cut(cut, tools, sheet, asked.parallel, result.smoothing))
      result.faces.push_back(std::move(face));
  result.measured = measured_beside(result.faces, asked.measured);
  if (springback)
    result.springback =
        springback_of_bodies(cuts, tools, sheet, springback->displacement, shot.state.node.mass);
  return result;
}

} // namespace cnem::evaluate
