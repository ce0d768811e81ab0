#include "study/laminate.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "evaluate/cutting_result.hpp"
#include "input/cutting_edge.hpp"
#include "input/cutting_tool.hpp"
#include "input/schema/document.hpp"
#include "input/schema/units.hpp"
#include "results/si_format.hpp"
#include "study/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <numbers>
#include <optional>

namespace cnem::study {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Means over the thickness that say something where a laminate names none.
constexpr const char* default_columns[] = {"metrics.cutting.Fc_per_width", "metrics.cutting.Ft_per_width",
                                           "metrics.cutting.specific_energy", "metrics.cutting.fibre_damage",
                                           "metrics.cutting.matrix_damage"};

/// rad; none where the run has no such key, or another quantity there.
std::optional<double> angle_of(const StudyRun& run, const RunRecord& record, const std::string& key) {
  if (is_variable(key)) {
    for (const input::Variable& variable : record.variables)
      if ("let." + variable.name == key && variable.unit == "rad") return variable.value;
    return {};
  }
  const input::Value* value = run.find(key);
  if (!value || value->kind != input::Value::Kind::text) return {};
  try {
    return input::parse_quantity(value->text, input::dimension::angle);
  } catch (const input::UnitError&) { return {}; }
}

/// Fibres look the same after half a turn.
bool same_fibres(double a, double b) {
  constexpr double slack = 1e-9;
  return std::abs(std::remainder(a - b, std::numbers::pi)) < slack;
}

bool has_chosen(const StudyRun& run, const LaminatePly& ply) {
  return std::all_of(ply.chosen.begin(), ply.chosen.end(), [&](const input::Override& choice) {
    const input::Value* own = run.find(choice.key);
    return own && same_value(*own, choice.value);
  });
}

double in_degrees(double angle) { return angle * 180.0 / std::numbers::pi; }

/// "a feed of 0.1 mm and 0.2 mm", of the first that differs; empty: both are cut alike.
std::string difference(const CutConditions& a, const CutConditions& b) {
  const auto differ = [](double x, double y, double size) {
    constexpr double slack = 1e-9;
    return std::abs(x - y) > slack * size;
  };
  const auto both = [](const char* what, double x, double y, const char* unit) {
    return fmt::format("a {} of {} and {}", what, results::si_format(x, unit, 6),
                       results::si_format(y, unit, 6));
  };
  const auto both_angles = [](const char* what, double x, double y) {
    return fmt::format("a {} of {:.6g} deg and {:.6g} deg", what, in_degrees(x), in_degrees(y));
  };
  if (differ(a.rake, b.rake, 1.0)) return both_angles("rake", a.rake, b.rake);
  if (differ(a.clearance, b.clearance, 1.0)) return both_angles("clearance", a.clearance, b.clearance);
  if (differ(a.edge_radius, b.edge_radius, std::max(a.edge_radius, b.edge_radius)))
    return both("radius of the edge", a.edge_radius, b.edge_radius, "m");
  if (differ(a.feed, b.feed, std::max(a.feed, b.feed))) return both("feed", a.feed, b.feed, "m");
  if (differ(a.speed, b.speed, std::max(a.speed, b.speed))) return both("speed", a.speed, b.speed, "m/s");
  if (a.friction != b.friction) return fmt::format("a friction of {} and {}", a.friction, b.friction);
  return {};
}

/// m/s, the largest that is prescribed in the run; of a driven tool that at its beginning.
double speed_of(const input::Tool& tool, double end) {
  if (tool.drive) return tool.drive->initial_velocity.norm();
  std::vector<double> times{0.0, end};
  for (const auto& component : tool.velocity)
    if (component) times.insert(times.end(), component->times().begin(), component->times().end());
  double most = 0.0;
  for (const double t : times) {
    double square = 0.0;
    for (const auto& component : tool.velocity)
      if (component) square += std::pow((*component)(std::min(t, end)), 2);
    most = std::max(most, std::sqrt(square));
  }
  return most;
}

/// With all of its constants.
std::string friction_of(const input::Case& input, const std::string& tool) {
  const input::Value document = input::parse_document(input.resolved, "resolved case");
  const input::Value* at = &document;
  for (const char* key : {"tools", tool.c_str(), "friction"}) {
    const input::Member* member = at->find(key);
    if (!member) return "none";
    at = &member->value;
  }
  return input::toml_text(*at);
}

/// Forces of a ply over the cut, N/m.
struct Course {
  std::vector<double> cut, Fc;

  explicit Course(const results::HistoryTable& table) {
    const int along = table.find("cut"), force = table.find("Fc.filtered");
    if (along < 0 || force < 0) return;
    cut = table.column[index_of(along)];
    Fc = table.column[index_of(force)];
  }
  double at(double s) const {
    const auto above = std::upper_bound(cut.begin(), cut.end(), s);
    if (above == cut.begin()) return Fc.front();
    if (above == cut.end()) return Fc.back();
    const auto k = index_of(above - cut.begin());
    return Fc[k - 1] + (Fc[k] - Fc[k - 1]) * (s - cut[k - 1]) / (cut[k] - cut[k - 1]);
  }
};

/// Of fibres, matrix and bonds the deepest of those that a cut tells of.
double damage_depth(const evaluate::CuttingResult& cut) {
  double depth = not_known;
  for (const double one : {cut.fibre_depth, cut.matrix_depth, cut.debonded_depth})
    if (!(one <= depth) && std::isfinite(one)) depth = one;
  return depth;
}

/// Forces over the cut as far as all plies are cut, and the largest sum up to the length `until`, m, if they
/// are cut as far as `completed`, m.
void add_courses(const Study& study, const std::vector<Course>& courses, double completed, double until,
                 LaminateCut& result) {
  const std::vector<LaminatePly>& plies = study.laminate->plies;
  result.forces.title = "Cutting force of the laminate";
  result.forces.x_label = "cut", result.forces.x_unit = "m";
  result.forces.y_label = "Fc", result.forces.y_unit = "N";
  double common = INFINITY;
  std::vector<double> cut;
  for (const Course& course : courses) {
    common = course.cut.empty() ? -INFINITY : std::min(common, course.cut.back());
    cut.insert(cut.end(), course.cut.begin(), course.cut.end());
    if (course.cut.empty()) break;
  }
  std::sort(cut.begin(), cut.end());
  cut.erase(std::unique(cut.begin(), cut.end()), cut.end());
  std::erase_if(cut, [&](double s) { return s > common; });
  if (cut.empty()) return;
  report::ChartSeries sum{.label = "laminate", .x = cut, .y = std::vector<double>(cut.size(), 0.0)};
  std::vector<report::ChartSeries> shares;
  for (std::size_t k = 0; k < plies.size(); ++k) {
    report::ChartSeries share{.label = fmt::format("{}: {:.6g}°", plies[k].name, in_degrees(plies[k].angle)),
                              .x = cut,
                              .y = {},
                              .colour = static_cast<int>(k) + 1};
    for (std::size_t row = 0; row < cut.size(); ++row) {
      share.y.push_back(plies[k].thickness * courses[k].at(cut[row]));
      sum.y[row] += share.y.back();
    }
    shares.push_back(std::move(share));
  }
  result.common = common;
  constexpr double rounding = 1.0 + 1e-6; // of lengths as files have them
  for (std::size_t row = 0;
       row < cut.size() && cut[row] <= until * rounding && completed <= common * rounding; ++row)
    if (!(sum.y[row] <= result.peak)) result.peak = sum.y[row], result.peak_at = cut[row];
  result.forces.series.push_back(std::move(sum));
  for (report::ChartSeries& share : shares) result.forces.series.push_back(std::move(share));
}

std::vector<std::string> columns_of(const Laminate& laminate, const std::vector<RunRecord>& runs) {
  if (!laminate.columns.empty()) return laminate.columns;
  std::vector<std::string> columns(std::begin(default_columns), std::end(default_columns));
  std::erase_if(columns, [&](const std::string& name) {
    return std::none_of(runs.begin(), runs.end(),
                        [&](const RunRecord& run) { return run.status && status_number(*run.status, name); });
  });
  return columns;
}

} // namespace

std::optional<CutConditions> cut_conditions(const input::Case& input) {
  if (!input.report.cutting) return {};
  const input::CuttingReport& report = *input.report.cutting;
  const input::Tool& tool = input.tools[report.tool];
  const input::CuttingEdge edge = input::cutting_edge(input, report.tool);
  return CutConditions{.rake = input::cutting_tool(input, report.tool).rake,
                       .feed = report.feed,
                       .speed = speed_of(tool, input.time.end),
                       .clearance = edge.clearance,
                       .edge_radius = edge.radius,
                       .friction = friction_of(input, tool.name)};
}

std::vector<std::size_t> runs_of_plies(const Study& study, const std::vector<RunRecord>& runs,
                                       const std::vector<std::optional<CutConditions>>& cuts) {
  const Laminate& laminate = *study.laminate;
  std::vector<std::optional<double>> angle;
  std::vector<double> known;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    angle.push_back(angle_of(study.runs[r], runs[r], laminate.angle));
    if (!angle[r])
      throw InputError(
          fmt::format("{}: key 'laminate.angle': found \"{}\", expected a variable of the case or a key of "
                      "the study that is an angle in all runs; it is none in run '{}'",
                      laminate.where.text(), laminate.angle, study.runs[r].name));
    if (std::none_of(known.begin(), known.end(), [&](double one) { return same_fibres(one, *angle[r]); }))
      known.push_back(*angle[r]);
  }
  std::vector<std::string> shown;
  for (const double one : known) shown.push_back(fmt::format("{:.6g} deg", in_degrees(one)));
  std::vector<std::size_t> result;
  for (const LaminatePly& ply : laminate.plies) {
    const auto refuse = [&](const std::string& found) {
      throw InputError(fmt::format("{}: key 'laminate.plies': {}", ply.where.text(), found));
    };
    std::vector<std::size_t> fitting;
    for (std::size_t r = 0; r < runs.size(); ++r)
      if (same_fibres(*angle[r], ply.angle) && has_chosen(study.runs[r], ply)) fitting.push_back(r);
    if (fitting.empty())
      refuse(fmt::format("found the angle {:.6g} deg, expected one of those of the runs{}: {}",
                         in_degrees(ply.angle), ply.chosen.empty() ? "" : " with these values",
                         fmt::join(shown, ", ")));
    if (fitting.size() > 1)
      refuse(fmt::format("{} runs have this angle, '{}' and '{}' among them, expected a 'set' with the value "
                         "of a key in which they differ",
                         fitting.size(), study.runs[fitting[0]].name, study.runs[fitting[1]].name));
    if (!cuts[fitting.front()])
      refuse(fmt::format("run '{}' has no [report.cutting], expected an orthogonal cut in each run of a ply",
                         study.runs[fitting.front()].name));
    result.push_back(fitting.front());
    const std::size_t first = result.front(), last = result.back();
    if (const std::string differs = difference(*cuts[first], *cuts[last]); !differs.empty())
      refuse(fmt::format("found plies '{}' and '{}' cut with {} (runs '{}' and '{}'), expected one tool: the "
                         "same rake, clearance, edge radius, feed, speed and friction for all plies",
                         laminate.plies.front().name, ply.name, differs, study.runs[first].name,
                         study.runs[last].name));
  }
  return result;
}

LaminateCut cut_of_laminate(const Study& study, const std::vector<RunRecord>& runs,
                            const std::vector<std::size_t>& run, const std::filesystem::path& folder) {
  const std::vector<LaminatePly>& plies = study.laminate->plies;
  LaminateCut result;
  result.peak = result.peak_at = result.common = not_known;
  std::vector<Course> courses;
  double completed = 0.0, until = 0.0;
  for (std::size_t k = 0; k < plies.size(); ++k) {
    evaluate::CuttingResult cut;
    if (runs[run[k]].status)
      cut = evaluate::read_cutting(folder / study.runs[run[k]].name).value_or(evaluate::CuttingResult{});
    const double t = plies[k].thickness;
    result.thickness += t;
    result.Fc.push_back(t * cut.Fc);
    result.Ft.push_back(t * cut.Ft);
    result.Fc_peak.push_back(t * cut.Fc_peak);
    result.Fc_sum += result.Fc.back();
    result.Ft_sum += result.Ft.back();
    result.damage_depth.push_back(damage_depth(cut));
    courses.emplace_back(cut.forces);
    const double off = std::isfinite(cut.completed_at) ? cut.completed_at : INFINITY;
    if (cut.breaks) completed = std::max(completed, off);
    until = std::max(until, off);
  }
  for (std::size_t k = 1; k < plies.size(); ++k)
    result.delamination.push_back(std::abs(result.damage_depth[k] - result.damage_depth[k - 1]));
  add_courses(study, courses, completed, until, result);
  for (const std::string& name : columns_of(*study.laminate, runs)) {
    LaminateColumn& column = result.columns.emplace_back();
    column.name = name;
    column.unit = column_unit(runs, name);
    for (std::size_t k = 0; k < plies.size(); ++k) {
      const auto& status = runs[run[k]].status;
      column.ply.push_back(status ? status_number(*status, name).value_or(not_known) : not_known);
      column.mean += plies[k].thickness * column.ply.back() / result.thickness;
    }
  }
  return result;
}

} // namespace cnem::study
