#pragma once
// What springs have in common.
#include "core/parameter.hpp"

namespace cnem::contact {

inline constexpr ParameterInfo spring_preload{.name = "preload",
                                              .unit = "N/m",
                                              .range = not_negative,
                                              .meaning = "Force at the start, at s = 0.",
                                              .example = "200 kN/m",
                                              .computed = "0"};

} // namespace cnem::contact
