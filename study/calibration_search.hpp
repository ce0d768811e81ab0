#pragma once
// The search for the least misfit by NLopt's BOBYQA, which is played again from the start with what is known:
// what it asks for first that is not known is what has to be evaluated next.
#include "study/calibration_evaluator.hpp"

namespace cnem::study {

/// Where start k of a calibration begins: the first at the given values, others at Halton's points.
Eigen::VectorXd start_place(const Calibration& calibration, int k);

/// A search as far as it is known.
struct SearchReplay {
  std::vector<Eigen::VectorXd> wanted; ///< to be evaluated before it can go on; empty: it has ended
  SearchEnd end;                       ///< so far
};

/// M. J. D. Powell, The BOBYQA algorithm for bound constrained optimization without derivatives, 2009. Its
/// first 2n + 1 places do not depend on values and are wanted together.
SearchReplay replay_search(const Calibration& calibration, const Eigen::VectorXd& start,
                           const Evaluator& evaluator);

} // namespace cnem::study
