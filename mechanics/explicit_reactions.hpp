#pragma once
// Reactions of supports and tools over a macro step: means over its finest steps.
#include "mechanics/model.hpp"

#include <utility>
#include <vector>

namespace cnem {

/// Made before a macro step of `count` finest steps; `duration` (s) is the sum of the times over which
/// velocities change in it.
template<int dim> class MeanReactions {
public:
  MeanReactions(Conditions<dim>& conditions, double duration, int count)
      : conditions_(conditions), duration_(duration), count_(count), mean_(conditions.supports.reactions()) {
    if (several()) conditions_.contact.begin_sub_steps();
    for (auto& reaction : mean_) reaction.setZero();
  }

  /// A finest step has been made.
  void add(double dt_mean) {
    for (std::size_t i = 0; i < mean_.size(); ++i)
      mean_[i] += dt_mean / duration_ * conditions_.supports.reactions()[i];
  }

  /// Reports the means in place of what the last finest step gave.
  void report() {
    if (several()) conditions_.contact.end_sub_steps(duration_);
    if (count_ > 1) conditions_.supports.report(std::move(mean_));
  }

private:
  bool several() const { return count_ > 1 && conditions_.contact.active(); }

  Conditions<dim>& conditions_;
  double duration_;
  int count_;
  std::vector<Vec<dim>> mean_;
};

} // namespace cnem
