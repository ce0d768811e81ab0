#pragma once
// A milling cut as stability and forces see it.
#include "machining/cutter.hpp"
#include "machining/cutting_law.hpp"
#include "machining/flank.hpp"

#include <Eigen/Core>
#include <vector>

namespace cnem::machining {

struct MillingCut {
  Cutter cutter;
  Engagement engagement;
  CuttingLaw law;
  Flank flank{};     ///< none: flanks are free
  double feed = 0.0; ///< m per tooth, the mean of a turn
  /// m of steady_thickness() within which forces rise from none to what the law has there, as stability sees
  /// them: where an edge comes to the cut moves with vibrations. 0: forces answer by the slope of the law.
  double onset = 0.0;

  /// Whether forces answer to vibrations alike at any thickness of the chip.
  bool linear() const { return law.linear() && onset == 0.0; }
};

/// With what edge forces (those of a chip without thickness) change: onset is 1e-4 of the feed.
MillingCut with_edge_forces(MillingCut cut);

/// Force on the tool per displacement of it, N/m. Edges at one radius move along themselves in z: nothing.
using DirectionalFactors = Eigen::Matrix3d;

/// Chip thickness of a tooth at φ in steady cutting, m, on circular paths: its share of the feed, and what it
/// stands out beyond the tooth before it. Negative where the tooth misses the cut.
double steady_thickness(const MillingCut& cut, std::size_t tooth, double phi);

/// rad, after which directional factors repeat themselves: run-out tells teeth apart where the law is not
/// linear or flanks plough.
double period_of(const MillingCut& cut);
/// Angles within the engagement, in order, at which factors of a tooth at a radius, m, have a kink: where it
/// begins to miss the cut, and where its land begins to leave the surface.
std::vector<double> changes_within(const MillingCut& cut, std::size_t tooth, double radius);

/// By how much the way of an edge leaves its circle, of a radius, m, outwards per length of it: by its feed,
/// and by the run-out.
double flank_rise(const MillingCut& cut, std::size_t tooth, double phi, double radius);

/// rad, between two angles, where sin φ is the largest.
double foremost_of(double entry, double exit);

/// m, the longest contact of a land over the engagement.
double longest_contact(const MillingCut& cut);

} // namespace cnem::machining
