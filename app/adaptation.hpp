#pragma once
// Estimate, mark, resample, transfer: what happens to the cloud at a new reference.
#include "adapt/resample.hpp"
#include "io/case.hpp"
#include "mechanics/explicit_solver.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

class Adaptation {
public:
  /// The spacing that the cloud has is the one that is wanted.
  Adaptation(const io::Case& input, const ExplicitSolver<2>& solver);

  bool active() const { return input_->adapt.resample; }

  /// Resamples the present cloud and makes it the reference. Returns how nodes went over. Throws
  /// GeometryError with the solver left as it was.
  Resampling<2> renew(ExplicitSolver<2>& solver);

  const Field& size() const { return size_; }   ///< [node] m, wanted spacing
  const Field& birth() const { return birth_; } ///< [node] s, when it was inserted
  /// Sums over the run, for status.json.
  std::vector<std::pair<std::string, double>> metrics() const;
  void archive(Archive& archive);

private:
  adapt::NodeProperties properties(const ExplicitSolver<2>& solver) const;

  const io::Case* input_;
  Field size_, birth_;
  std::vector<std::int32_t> corner_; ///< [node] 1: stays
  adapt::PassReport total_;
  std::int64_t passes_ = 0;
};

} // namespace cnem::app
