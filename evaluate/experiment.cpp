#include "evaluate/experiment.hpp"

#include "evaluate/force_stroke.hpp"
#include "evaluate/json_carrier.hpp"
#include "input/measured_file.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>
#include <string_view>

namespace cnem::evaluate {
namespace {

constexpr std::array<const char*, 4> component_names{"along", "across", "x", "y"};

template<class Result, class Carry> void carry_experiment(Result& result, Carry& carry) {
  carry("name", result.name);
  carry("tool", result.tool);
  carry("component", result.component);
  carry("over_stroke", result.over_stroke);
  carry("force_unit", result.force_unit);
  carry("work_unit", result.work_unit);
  carry("factor", result.factor);
  carry("note", result.note);
}

constexpr auto experiment_carrier = [](auto& result, auto& carry) { carry_experiment(result, carry); };

std::size_t peak_of(const ComparedCurve& curve) {
  return index_of(std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin());
}

/// x of both curves within a range, with its ends.
std::vector<double> common_knots(const ComparedCurve& a, const ComparedCurve& b, double from, double to) {
  std::vector<double> knots{from, to};
  for (const ComparedCurve* curve : {&a, &b})
    for (const double x : curve->x)
      if (x > from && x < to) knots.push_back(x);
  std::sort(knots.begin(), knots.end());
  return knots;
}

/// In how many places the punch cuts.
std::size_t cuts_of(const BlankingResult* blanking) {
  std::set<std::string> cuts;
  if (blanking)
    for (const ShearedFace& face : blanking->faces) cuts.insert(face.cut);
  return std::max<std::size_t>(1, cuts.size());
}

/// The cut, or what else moves: its direction, and over whose stroke.
LeadingForce motion_of(const std::string& tool, const results::HistoryTable& history,
                       const BlankingResult* blanking) {
  if (blanking &&
      (blanking->direction_x != 0.0 || blanking->direction_y != 0.0 || blanking->direction_z != 0.0))
    return leading_force(*blanking);
  const std::optional<LeadingForce> leading = leading_force(history);
  if (leading && leading->over_stroke) return *leading;
  return {.of = tool, .along = leading ? leading->along : Vec3(1, 0, 0)};
}

Vec3 direction(input::Experiment::Component component, const Vec3& motion) {
  switch (component) {
  case input::Experiment::Component::along:
    break;
  case input::Experiment::Component::across:
    return {-motion.y(), motion.x(), 0.0};
  case input::Experiment::Component::x:
    return {1, 0, 0};
  case input::Experiment::Component::y:
    return {0, 1, 0};
  }
  return motion;
}

/// The force of a tool and the stroke of the one that leads, or the time in its place; positive where the
/// force is largest.
struct ToolCurve {
  ForceCurve force;
  std::vector<double> x, even_x; ///< of each row, at even times
  double sign = 1.0;
};

ToolCurve tool_curve(const results::HistoryTable& history, const std::string& tool,
                     const LeadingForce& motion, const input::Experiment& experiment) {
  const auto along = [&](const Vec3& way) {
    return force_curve(history, tool, motion.of, motion.against, way);
  };
  ToolCurve curve{.force = along(direction(experiment.component, motion.along)), .x = {}, .even_x = {}};
  const ForceCurve stroke = along(motion.along);
  curve.x = experiment.over_stroke ? stroke.stroke : curve.force.time;
  curve.even_x = experiment.over_stroke ? stroke.even_stroke : curve.force.even_time;
  if (curve.force.smooth[curve.force.largest] < 0.0) curve.sign = -1.0;
  return curve;
}

ComparedCurve computed_curve(const ToolCurve& tool, double factor) {
  ComparedCurve curve;
  for (std::size_t k = 0; k < tool.even_x.size(); ++k) { // of few rows the low-pass may find none near enough
    if (!std::isfinite(tool.even_x[k]) || !std::isfinite(tool.force.smooth[k])) continue;
    curve.x.push_back(tool.even_x[k]);
    curve.y.push_back(tool.sign * factor * tool.force.smooth[k]);
  }
  input::keep_growing(curve.x, curve.y);
  return curve;
}

/// A curve blunts where it rises by a low-pass: the measured one is taken row by row of the run and goes
/// through the same, with the same rows.
void pass_alike(ExperimentResult& result, const ToolCurve& tool) {
  const std::vector<double>& time = tool.force.time;
  const double sigma = force_filter(time);
  if (!(sigma > 0.0)) return;
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> measured = interpolated(result.measured.x, result.measured.y, tool.x),
                      computed = tool.force.force;
  const auto farthest = index_of(std::max_element(tool.x.begin(), tool.x.end()) - tool.x.begin());
  for (std::size_t k = 0; k < time.size(); ++k)
    if (k > farthest || !std::isfinite(computed[k]) || tool.x[k] < result.measured.x.front() ||
        tool.x[k] > result.measured.x.back())
      measured[k] = computed[k] = none;
  const std::vector<double> a = gaussian_filter(time, measured, sigma, tool.force.even_time),
                            b = gaussian_filter(time, computed, sigma, tool.force.even_time);
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double x = tool.even_x[k];
    std::vector<double>& places = result.passed_measured.x;
    if (!std::isfinite(a[k]) || !std::isfinite(b[k]) || x < result.measured.x.front() ||
        x > result.measured.x.back() || (!places.empty() && x <= places.back()))
      continue;
    places.push_back(x);
    result.passed_measured.y.push_back(a[k]);
    result.passed_computed.y.push_back(tool.sign * result.factor * b[k]);
  }
  result.passed_computed.x = result.passed_measured.x;
}

std::string note_of(const ExperimentResult& result) {
  const CurveDifference& d = result.difference;
  const auto text = [&](double x) {
    return fmt::format("{} {}", results::number_format(1e3 * x), result.over_stroke ? "mm" : "ms");
  };
  const ComparedCurve &m = result.measured, &c = result.computed;
  if (c.x.empty()) return fmt::format("The run has no force of {}.", result.tool);
  if (!d.common())
    return fmt::format("The curves have no {} in common: the measured one is from {} to {}, the computed one "
                       "from {} to {}.",
                       result.over_stroke ? "stroke" : "time", text(m.x.front()), text(m.x.back()),
                       text(c.x.front()), text(c.x.back()));
  if (d.to < d.at_measured)
    return fmt::format("The run ends at {}, before the measured peak: the computed peak is the largest force "
                       "up to there.",
                       text(d.to));
  if (d.to < d.at_computed)
    return fmt::format("The measured curve ends at {}, before the computed peak.", text(d.to));
  return "";
}

/// Those of a result by the names they have in its file.
template<class Result> auto curves_of(Result& result) {
  return std::array{std::pair{"measured", &result.measured}, std::pair{"computed", &result.computed},
                    std::pair{"passed_measured", &result.passed_measured},
                    std::pair{"passed_computed", &result.passed_computed}};
}

double relative(double computed, double measured) { return computed / measured - 1.0; }

} // namespace

CurveDifference compare_curves(const ComparedCurve& measured, const ComparedCurve& computed) {
  CurveDifference d;
  const std::size_t m = peak_of(measured), c = peak_of(computed);
  d.peak_measured = measured.y[m];
  d.at_measured = measured.x[m];
  if (computed.x.empty()) return d;
  d.peak_computed = computed.y[c];
  d.at_computed = computed.x[c];
  d.from = std::max(measured.x.front(), computed.x.front());
  d.to = std::min(measured.x.back(), computed.x.back());
  if (!d.common()) return d;
  const std::vector<double> knots = common_knots(measured, computed, d.from, d.to);
  const std::vector<double> a = interpolated(measured.x, measured.y, knots),
                            b = interpolated(computed.x, computed.y, knots);
  d.area_measured = d.area_computed = 0.0;
  double squares = 0.0;
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const double h = knots[k] - knots[k - 1], p = b[k - 1] - a[k - 1], q = b[k] - a[k];
    d.area_measured += 0.5 * h * (a[k - 1] + a[k]);
    d.area_computed += 0.5 * h * (b[k - 1] + b[k]);
    squares += h / 3.0 * (p * p + p * q + q * q);
  }
  d.rms = std::sqrt(squares / (d.to - d.from));
  return d;
}

std::vector<ExperimentResult> evaluate_experiments(const input::Case& input,
                                                   const results::HistoryTable& history,
                                                   const BlankingResult* blanking) {
  std::vector<ExperimentResult> list;
  if (history.rows() < 2) return list;
  const bool round = input.analysis.space() == Space::revolution;
  for (const input::Experiment& experiment : input.report.experiments) {
    ExperimentResult result;
    result.name = experiment.name;
    result.tool = input.tools[experiment.tool].name;
    result.component = component_names[static_cast<std::size_t>(experiment.component)];
    result.over_stroke = experiment.over_stroke;
    if (experiment.per_length) {
      result.force_unit = "N/m";
      result.work_unit = "J/m";
    }
    const double cuts = experiment.cuts.value_or(double(cuts_of(blanking))),
                 length = experiment.cut_length.value_or(1.0);
    // Of the whole cut in the experiment, or of 1 m of it, over what the model has the force of.
    result.factor =
        round ? (experiment.per_length ? 1.0 / length : 1.0) : (experiment.per_length ? 1.0 : length) / cuts;
    result.measured = {experiment.x, experiment.force};
    const ToolCurve tool =
        tool_curve(history, result.tool, motion_of(result.tool, history, blanking), experiment);
    result.computed = computed_curve(tool, result.factor);
    pass_alike(result, tool);
    result.difference = compare_curves(result.measured, result.computed);
    result.note = note_of(result);
    list.push_back(std::move(result));
  }
  return list;
}

std::vector<std::pair<std::string, double>> metrics_of(const std::vector<ExperimentResult>& experiments) {
  std::vector<std::pair<std::string, double>> metrics;
  for (const ExperimentResult& result : experiments) {
    const CurveDifference& d = result.difference;
    const std::string at = "experiment." + result.name + ".";
    const char* x_unit = result.over_stroke ? "m" : "s";
    const char* where = result.over_stroke ? "stroke" : "time";
    const auto add = [&](const std::string& name, const std::string& unit, double value) {
      metrics.emplace_back(at + name + (unit.empty() ? "" : "[" + unit + "]"), value);
    };
    add("peak_measured", result.force_unit, d.peak_measured);
    add("peak_computed", result.force_unit, d.peak_computed);
    add("peak_difference", "", relative(d.peak_computed, d.peak_measured));
    add(fmt::format("{}_at_peak_measured", where), x_unit, d.at_measured);
    add(fmt::format("{}_at_peak_computed", where), x_unit, d.at_computed);
    if (result.over_stroke) {
      add("work_measured", result.work_unit, d.area_measured);
      add("work_computed", result.work_unit, d.area_computed);
      add("work_difference", "", relative(d.area_computed, d.area_measured));
    }
    add("rms", result.force_unit, d.rms);
    add("rms_share", "", d.rms / d.peak_measured);
  }
  return metrics;
}

void write_experiments(const std::filesystem::path& folder,
                       const std::vector<ExperimentResult>& experiments) {
  Json json = Json::object();
  Json& list = json["experiments"] = list_of(experiments, experiment_carrier);
  for (std::size_t k = 0; k < experiments.size(); ++k)
    for (const auto& [name, curve] : curves_of(experiments[k]))
      list[k][name] = {{"x", curve->x}, {"y", curve->y}};
  results::write_atomically(folder / results::files::experiment, json.dump(1) + "\n");
}

std::vector<ExperimentResult> read_experiments(const std::filesystem::path& folder) {
  const auto read = read_evaluation(folder / results::files::experiment, [](const Json& json) {
    const Json& list = json.at("experiments");
    auto experiments = records_of<ExperimentResult>(list, experiment_carrier);
    for (std::size_t k = 0; k < experiments.size(); ++k) {
      for (const auto& [name, curve] : curves_of(experiments[k]))
        if (list[k].contains(name) ||
            !std::string_view(name).starts_with("passed")) // runs of earlier versions
          *curve = {list[k].at(name).at("x").get<std::vector<double>>(),
                    list[k].at(name).at("y").get<std::vector<double>>()};
      experiments[k].difference = compare_curves(experiments[k].measured, experiments[k].computed);
    }
    return experiments;
  });
  return read.value_or(std::vector<ExperimentResult>{});
}

} // namespace cnem::evaluate
