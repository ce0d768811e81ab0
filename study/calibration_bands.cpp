// The flow stress that constants stand for, over what the targets meet.
#include "core/error.hpp"
#include "evaluate/material_point.hpp"
#include "input/case_reader.hpp"
#include "results/output_folder.hpp"
#include "study/calibration.hpp"
#include "study/calibration_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::study {
namespace {

/// Where a target takes a material.
struct Met {
  double strain = 0.0, rate = 0.0, temperature = 0.0; ///< –, 1/s, K
};

/// A test at the start of it, and at its end where it has become hot.
std::vector<Met> met_by_point(const PointTarget& point, const plasticity::Material& material) {
  evaluate::PointTest test = point.test;
  const evaluate::PointCurve curve = evaluate::point_curve(material, test);
  const bool shear = test.kind == evaluate::PointTest::Kind::shear;
  const double rate = test.rate / (shear ? std::sqrt(3.0) : 1.0), strain = curve.equivalent_strain.back();
  std::vector<Met> met{{strain, rate, test.temperature}};
  if (curve.temperature.back() > test.temperature + 1.0)
    met.push_back({strain, rate, curve.temperature.back()});
  return met;
}

/// A run by its largest strain, that strain over the time in which it came, and the temperatures of start and
/// hottest point.
std::vector<Met> met_by_run(const std::filesystem::path& folder, const input::Case& input) {
  const results::HistoryTable history = results::read_history(folder / results::files::history);
  const int strain = history.find("max.plastic_strain"), hot = history.find("max.temperature");
  if (strain < 0 || history.rows() < 2) return {};
  const std::vector<double>& time = history.column.front();
  const std::vector<double>& flow = history.column[static_cast<std::size_t>(strain)];
  const auto first = std::find_if(flow.begin(), flow.end(), [](double value) { return value > 0.0; });
  if (first == flow.end()) return {};
  const double since = time[static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, first - flow.begin() - 1))];
  const double most = *std::max_element(flow.begin(), flow.end());
  std::vector<Met> met{{most, most / (time.back() - since), input.initial.temperature}};
  if (hot >= 0) {
    const auto& temperature = history.column[static_cast<std::size_t>(hot)];
    const double hottest = *std::max_element(temperature.begin(), temperature.end());
    if (hottest > input.initial.temperature + 1.0) met.push_back({most, met.front().rate, hottest});
  }
  return met;
}

/// The shear plane of a cut in closed form.
std::vector<Met> met_by_cut(const input::Case& input) {
  const auto zone = closed_form_cut(input);
  if (!zone) return {};
  return {{zone->strain, zone->rate, zone->temperature}};
}

} // namespace

std::vector<FlowBand> flow_bands(const Calibration& calibration, const CalibrationResult& result,
                                 const std::filesystem::path& folder) {
  constexpr double step = 1e-3;
  constexpr int points = 60;
  const Eigen::VectorXd& best = result.best.place;
  const BatchOptions options{.output = folder, .version = ""};
  const Evaluator evaluator(calibration, options);
  std::vector<FlowBand> bands;
  for (const CalibrationTarget& target : calibration.targets) {
    if (!target.fitted()) continue;
    const auto read = [&](const Eigen::VectorXd& place) {
      return input::read_case_with(target.case_file.string(), calibration.changes(target, place));
    };
    const input::Case input = read(best);
    const std::string name = target.point ? target.point->material : input.domain.material;
    const plasticity::Material& material = input.material(name);
    if (!material.hardening) continue;
    std::vector<input::Case> low, high;
    std::vector<double> width;
    for (Eigen::Index k = 0; k < best.size(); ++k) {
      Eigen::VectorXd a = best, b = best;
      a[k] = std::max(0.0, best[k] - step);
      b[k] = std::min(1.0, best[k] + step);
      width.push_back(b[k] - a[k]);
      low.push_back(read(a));
      high.push_back(read(b));
    }
    for (const Met& met : target.point    ? met_by_point(*target.point, material)
                          : target.runs() ? met_by_run(evaluator.folder_of(target, best), input)
                                          : met_by_cut(input)) {
      FlowBand& band = bands.emplace_back();
      band.name = fmt::format("{} ({})", name, target.name);
      band.rate = met.rate;
      band.temperature = met.temperature;
      for (int k = 0; k <= points; ++k) {
        const double strain = met.strain * k / points;
        const auto flow = [&](const input::Case& one) {
          return evaluate::flow_stress_of(one.material(name), strain, met.rate, met.temperature);
        };
        Eigen::VectorXd slope(best.size());
        for (Eigen::Index c = 0; c < best.size(); ++c) {
          const auto at = static_cast<std::size_t>(c);
          slope[c] = (flow(high[at]) - flow(low[at])) / width[at];
        }
        band.strain.push_back(strain);
        band.stress.push_back(flow(input));
        if (result.inference.intervals())
          band.half_width.push_back(result.inference.quantile *
                                    std::sqrt(std::max(0.0, slope.dot(result.inference.covariance * slope))));
      }
    }
  }
  return bands;
}

} // namespace cnem::study
