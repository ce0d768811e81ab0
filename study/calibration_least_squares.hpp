#pragma once
// Sensitivities of a calibration, and steps by them.
#include "study/calibration_evaluator.hpp"

#include <optional>

namespace cnem::study {

/// A place with the sensitivities of the residuals about it, by central differences where both sides are
/// within the bounds and go well; not-a-number where neither side goes well.
struct Linearised {
  Eigen::VectorXd place;
  Eigen::MatrixXd jacobian;
};

/// From a place that went well to the least misfit near it: Levenberg's and Marquardt's steps with
/// sensitivities by differences, within the bounds, each taken where the misfit falls. 2n evaluations for
/// each, so it is for targets that are not run. None after a signal.
std::optional<Linearised> least_squares_from(Eigen::VectorXd place, Evaluator& evaluator);

/// The same for targets that are run: steps with the sensitivities that intervals take anyway, an evaluation
/// each; 2n more where they leave the range of their differences, three times at most.
std::optional<Linearised> few_steps_from(const Eigen::VectorXd& place, Evaluator& evaluator);

} // namespace cnem::study
