#pragma once
// Sensitivities of a calibration, and steps by them.
#include "study/calibration_evaluator.hpp"

#include <optional>

namespace cnem::study {

/// Sensitivities of the residuals about a place that is evaluated, by central differences where both sides
/// are within the bounds and go well; not-a-number where neither side goes well. None after a signal.
std::optional<Eigen::MatrixXd> jacobian_at(const Eigen::VectorXd& place, Evaluator& evaluator);

/// From a place that went well to the least misfit near it: Levenberg's and Marquardt's steps with
/// sensitivities by differences, within the bounds, each taken where the misfit falls. 2n evaluations for
/// each, so it is for targets that are not run. None after a signal.
std::optional<Eigen::VectorXd> least_squares_from(Eigen::VectorXd place, Evaluator& evaluator);

} // namespace cnem::study
