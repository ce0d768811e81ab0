#pragma once
// The page of a calibration.
#include "study/calibration.hpp"

#include <string>
#include <vector>

namespace cnem::study {

/// report.html: constants with their intervals, what the curves do not tell, misfit of each curve before and
/// after, curves, sensitivities, correlations, flow stress with its band.
std::string calibration_report(const Calibration& calibration, const CalibrationResult& result,
                               const std::vector<FlowBand>& bands, const std::string& version);

} // namespace cnem::study
