#pragma once
// A milling cut as stability and forces see it, and how its forces answer to vibrations.
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
};

/// Force on the tool per displacement of it, N/m: columns x and y alone, because a flat end moves along its
/// edges in z.
using DirectionalFactors = Eigen::Matrix<double, 3, 2>;

/// Chip thickness of a tooth at φ in steady cutting, m, on circular paths: its share of the feed, and what it
/// stands out beyond the tooth before it. Negative where the tooth misses the cut.
double steady_thickness(const MillingCut& cut, std::size_t tooth, double phi);

/// rad, after which the factors below repeat themselves: run-out tells teeth apart where the law is not
/// linear or flanks plough.
double period_of(const MillingCut& cut);
/// Angles within the engagement, in order, at which factors of a tooth have a jump or a kink: where it begins
/// to miss the cut, and where its land begins to leave the surface.
std::vector<double> changes_within(const MillingCut& cut, std::size_t tooth);

/// Of all teeth where they cut, over the engagement, m; thinnest ≤ 0 where one misses the cut.
struct SteadyChips {
  double thinnest = infinite, thickest = 0.0;
};
SteadyChips steady_chips(const MillingCut& cut);

/// Per depth, at one angle: ∂F/∂(n·u) n, of the slope of the law at the steady thickness. N/m²
DirectionalFactors directional_factors(const MillingCut& cut, std::size_t tooth, double phi, double spindle);

/// Of one tooth whose tip is at an angle φ, over the part of [0, depth] that is in the cut; the factors times
/// u(t) − u(t − τ) are its force. spindle: rad/s.
DirectionalFactors directional_factors(const MillingCut& cut, std::size_t tooth, double tip, double depth,
                                       double spindle);

/// By how much the way of an edge leaves its circle outwards per length of it: by its feed, and by the
/// run-out.
double flank_rise(const MillingCut& cut, std::size_t tooth, double phi);

/// m, the longest contact of a land over the engagement.
double longest_contact(const MillingCut& cut);

/// Whether a part of [0, depth] of a tooth whose tip is at an angle φ lies within the engagement.
bool engages(const MillingCut& cut, std::size_t tooth, double tip, double depth);

/// Of flanks that plough: ∂F/∂u̇ of one tooth, as directional_factors(); none where it misses the cut. N s/m
DirectionalFactors damping_factors(const MillingCut& cut, std::size_t tooth, double tip, double depth,
                                   double spindle);
/// Per depth, the mean over a turn of the sum over the teeth. N s/m²
DirectionalFactors mean_damping(const MillingCut& cut, double spindle);

/// Per depth, the mean over a turn of the sum over the teeth (Altintas and Budak 1995). N/m²
DirectionalFactors mean_factors(const MillingCut& cut, double spindle);

} // namespace cnem::machining
