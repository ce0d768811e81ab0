// Numbers of orthogonal cuts beside computed ones: of runs, or of the shear zone in closed form.
#include "core/index.hpp"
#include "evaluate/cutting_result.hpp"
#include "evaluate/shear_zone.hpp"
#include "input/case_reader.hpp"
#include "study/calibration_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::study {
namespace {

/// What a cut comes to, per width.
struct ComputedCut {
  double Fc = 0.0, Ft = 0.0, chip_thickness = 0.0; ///< N/m, N/m, m
  double width = 0.0;                              ///< m
  std::string failure;                             ///< why there is none
  std::string note;                                ///< what makes it doubtful
};

ComputedCut by_shear_zone(const input::Case& input) {
  const auto zone = closed_form_cut(input);
  if (!zone)
    return {.failure = "the shear zone finds no angle at which its chip flows: the metal hardens too much "
                       "for it, or friction is too high",
            .note = ""};
  return {zone->Fc, zone->Ft, zone->chip_thickness, input.cutting->width, "", ""};
}

ComputedCut by_run(const std::filesystem::path& folder) {
  const auto cut = evaluate::read_cutting_numbers(folder);
  if (!cut) return {.failure = "it has left no cut", .note = ""};
  return {cut->Fc,
          cut->Ft,
          cut->chip_thickness,
          cut->width,
          "",
          cut->steady ? "" : fmt::format("the computed cut is not steady: {}", cut->steady_note)};
}

double computed(const ComputedCut& cut, const MeasuredNumber& measured) {
  const double per_width = measured.what == MeasuredNumber::What::Fc ? cut.Fc : cut.Ft;
  if (measured.what == MeasuredNumber::What::chip_thickness) return cut.chip_thickness;
  return measured.per_width ? per_width : per_width * cut.width;
}

} // namespace

const char* MeasuredNumber::name() const {
  return what == What::Fc ? "Fc" : what == What::Ft ? "Ft" : "chip_thickness";
}

std::optional<evaluate::ShearZone> closed_form_cut(const input::Case& input) {
  const input::CuttingSetup& cut = *input.cutting;
  return evaluate::shear_zone(input.material(input.domain.material),
                              {.feed = cut.feed,
                               .speed = cut.speed,
                               .rake = cut.rake,
                               .friction = cut.friction,
                               .temperature = input.initial.temperature});
}

std::string Evaluator::collect_cut(const CalibrationTarget& target, std::size_t index,
                                   const Eigen::VectorXd& place, Evaluation& evaluation) const {
  ComputedCut cut;
  if (target.runs()) {
    const std::filesystem::path folder = folder_of(target, place);
    if (std::string failure = failure_of_run(folder); !failure.empty()) return failure;
    cut = by_run(folder);
  } else {
    cut =
        by_shear_zone(input::read_case_with(target.case_file.string(), calibration_.changes(target, place)));
  }
  if (!cut.failure.empty()) return fmt::format("{}: {}", target.name, cut.failure);
  for (const MeasuredNumber& measured : target.cut->measured) {
    const double value = computed(cut, measured);
    if (!std::isfinite(value)) return fmt::format("{}: it has no {}", target.name, measured.name());
    CalibratedCurve& curve = evaluation.curves.emplace_back();
    curve.name = fmt::format("{} {}", target.name, measured.name());
    curve.target = index;
    curve.y_unit = measured.what == MeasuredNumber::What::chip_thickness ? "m"
                   : measured.per_width                                  ? "N/m"
                                                                         : "N";
    curve.measured = {{0.0}, {measured.value}};
    curve.computed = {{0.0}, {value}};
    curve.peak = std::max(std::abs(measured.value), measured.error);
    curve.relative_error = measured.error / curve.peak;
    curve.note = cut.note;
  }
  return "";
}

void weigh_cuts(const Calibration& calibration, Evaluation& evaluation) {
  double squares = 0.0, count = 0.0, weights = 0.0;
  bool known = true;
  for (const CalibratedCurve& curve : evaluation.curves) {
    const CalibrationTarget& target = calibration.targets[curve.target];
    known = known && target.cut && target.weight == 1.0 &&
            std::all_of(target.cut->measured.begin(), target.cut->measured.end(),
                        [](const MeasuredNumber& number) { return number.error_known; });
    if (!target.cut) continue;
    squares += curve.relative_error * curve.relative_error;
    count += 1.0;
  }
  if (count == 0.0) return;
  const double mean = squares / count;
  for (CalibratedCurve& curve : evaluation.curves) {
    if (calibration.targets[curve.target].cut)
      curve.weight = mean / (curve.relative_error * curve.relative_error);
    weights += curve.weight;
  }
  if (known) evaluation.known_variance = mean / weights; // of a residual √(w/Σw) (c − m)/peak
}

} // namespace cnem::study
