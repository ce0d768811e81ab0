#pragma once
// What a cutting law gives at one chip thickness.
#include "core/parameter.hpp"
#include "core/vec.hpp"

namespace cnem::machining {

/// Forces on the edge per length of it along the axis of the cutter: tangential (against the motion of the
/// edge), radial (away from the workpiece, towards the axis), axial.
struct LawPoint {
  Vec3 force = Vec3::Zero(); ///< N/m
  Vec3 slope = Vec3::Zero(); ///< Pa, derivative by the chip thickness
};

/// What forces depend on: h > 0 is meant where a law is asked.
struct Cut {
  double thickness = 0.0; ///< m, of the chip
  double speed = 0.0;     ///< m/s, of the edge
};

/// Edge forces rub whatever the thickness, as long as something is cut.
inline constexpr ParameterInfo Kte_info{.name = "Kte",
                                        .unit = "N/m",
                                        .range = not_negative,
                                        .meaning = "Tangential edge force.",
                                        .example = "27.7 N/mm"};
inline constexpr ParameterInfo Kre_info{
    .name = "Kre", .unit = "N/m", .meaning = "Radial edge force.", .example = "26.6 N/mm"};
inline constexpr ParameterInfo Kae_info{
    .name = "Kae", .unit = "N/m", .meaning = "Axial edge force.", .example = "0.7 N/mm"};

} // namespace cnem::machining
