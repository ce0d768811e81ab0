#pragma once
// Stability lobes from the mean of the directional factors (Altintas and Budak, CIRP Annals 44, 1995), for
// any pitches (Budak 2003) and any modes: 1 = a λ(ω) S(ω), where λ is an eigenvalue of the mean factors times
// the receptance and S the mean of 1 − exp(−iωτ_j) over the teeth.
#include "machining/milling_cut.hpp"
#include "machining/mode.hpp"

#include <optional>
#include <span>

namespace cnem::machining {

struct ZeroOrderLimit {
  double depth = 0.0;     ///< m
  double frequency = 0.0; ///< rad/s of the vibration
};

/// The smallest depth at the margin of stability at this speed, rad/s; none where any depth is stable (of
/// edges whose radius changes, any up to ten diameters or the end of the edges).
std::optional<ZeroOrderLimit> zero_order_limit(const MillingCut& cut, std::span<const Mode> modes,
                                               double spindle);

/// The smallest of all speeds: 1/(2 max Re λ), of teeth at equal pitches whose flanks are free.
std::optional<ZeroOrderLimit> zero_order_minimum(const MillingCut& cut, std::span<const Mode> modes,
                                                 double spindle);

} // namespace cnem::machining
