#pragma once
// The edges of a milling cut as stability sees them: how the force on a tooth answers to vibrations, summed
// over its height.
#include "machining/milling_cut.hpp"

#include <array>
#include <utility>
#include <vector>

namespace cnem::machining {

/// A part of the edges between two heights, on a cone of its own about the axis: the same of every tooth.
struct EdgeSlice {
  double radius = 0.0;             ///< m, mean
  double width = 0.0;              ///< m, of the chip: along the profile
  double sine = 1.0, cosine = 0.0; ///< of the angle between the axis and the normal of the profile
  std::array<double, 2> lag{};     ///< rad at its ends, linear between
  std::array<double, 2> entry{};   ///< rad at its ends: a rounded end is less in the cut towards its tip
  std::array<double, 2> exit{};
  CuttingLaw law; ///< of its angles

  /// Force on the tool by its displacement, of the whole slice at φ, where forces per width (tangential,
  /// normal to the profile, along it) are in proportion to what of it is along the normal.
  DirectionalFactors answer(double phi, const Vec3& force) const;
};

/// From the tip up to a depth: one of a flat end, those of a face or of a corner's arc otherwise.
std::vector<EdgeSlice> edge_slices(const MillingCut& cut, double depth);

/// Of all teeth where they cut, over the engagement of edges up to a depth.
struct SteadyChips {
  double thickest = 0.0;      ///< m, of any height
  double thinnest = infinite; ///< m, where edges go the farthest out; ≤ 0 where a tooth misses the cut there
  double radius = 0.0;        ///< m, of edges there
};
SteadyChips steady_chips(const MillingCut& cut, double depth);

class EngagedEdges {
public:
  /// depth: m; spindle: rad/s.
  EngagedEdges(const MillingCut& cut, double depth, double spindle);

  /// Of one tooth whose tip is at an angle; the factors times u(t) − u(t − τ) are its force. N/m
  DirectionalFactors factors(std::size_t tooth, double tip) const;
  /// Of its flank that ploughs: ∂F/∂u̇; none where it misses the cut. N s/m
  DirectionalFactors damping(std::size_t tooth, double tip) const;
  /// Whether any of it lies within the engagement.
  bool engages(std::size_t tooth, double tip) const;
  /// Means over a turn of the sum over the teeth (Altintas and Budak 1995). N/m; N s/m
  DirectionalFactors mean_factors() const;
  DirectionalFactors mean_damping() const;
  /// rad, angles of the tip at which factors of a tooth have a jump or a kink: where an end of its edge, or
  /// what enters or leaves first or last of it, does so, begins to miss the cut, or its land to leave it.
  std::vector<double> changes(std::size_t tooth) const;
  /// rad, how near to each other changes are one.
  double rounding() const;

private:
  DirectionalFactors factors_at(const EdgeSlice& slice, std::size_t tooth, double phi) const;
  DirectionalFactors damping_at(const EdgeSlice& slice, std::size_t tooth, double phi) const;
  /// Sum of per_slice(slice, φ), of a whole slice, over what of a tooth is in the cut.
  template<class PerSlice>
  DirectionalFactors along_edge(std::size_t tooth, double tip, const PerSlice& per_slice) const;
  template<class PerSlice> DirectionalFactors mean_of_turn(const PerSlice& per_slice) const;

  MillingCut cut_;
  double spindle_;
  std::vector<EdgeSlice> slices_;
  std::vector<std::vector<double>> kinks_; ///< [slice × teeth + tooth] rad, φ within its engagement
};

} // namespace cnem::machining
