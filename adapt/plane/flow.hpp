#pragma once
// Which matter flows, and which has ceased to.
#include "adapt/plane/structure.hpp"
#include "core/fields/archive.hpp"
#include "core/fields/state.hpp"
#include "core/operators/resampling.hpp"

namespace cnem::adapt {

/// A node flows where its plastic power p = σ̄ dε̄p/dt is a twentieth of what it is on average where the work
/// is done, ∫p² dV/∫p dV, at least. Time is counted in the strain that flowing matter takes meanwhile, of the
/// rate ∫p (dε̄p/dt) dV/∫p dV, so that neither speed nor size nor metal need be known: it stands still while
/// nothing flows.
class Flow {
public:
  Flow() = default;
  explicit Flow(std::size_t nodes) : rest_(nodes, 1.0) {}

  /// How the points flow at a time (s) that is not before the last one.
  void look(const PointState<2>& point, const Structure& structure, double time);

  /// Whether a node has not flowed since flowing matter took a strain of 0.5, or never has.
  bool rests(std::size_t node) const { return rest_[node] >= 1.0; }

  /// Takes over to a changed cloud what is known of nodes.
  void resample(const Resampling<2>& change) { carry_label(change.labels, rest_); }
  void archive(Archive& archive, std::size_t nodes);

private:
  Field rest_;        ///< [node] – of the way to rest
  double seen_ = 0.0; ///< s, when it was looked at last
};

} // namespace cnem::adapt
