#pragma once
// The plate of paper 004, 3.3.1, whose base is fixed; E as its frequencies say (misprint).
#include "machining/structure/eigenmodes.hpp"
#include "machining/structure/part.hpp"

#include <numbers>

namespace cnem::machining {

inline PartShape plate(std::array<int, 3> divisions = {10, 5, 2}) {
  return {.size = Vec3(0.1, 0.04, 0.004),
          .divisions = divisions,
          .materials = {{2.0e11, 0.3, 7800.0}},
          .zones = {}};
}
inline const PartSupport base{.axis = 1};

inline Eigenmodes modes(const Part& part, Eigen::Index count) {
  return lowest_modes(part.stiffness(part.presence()), part.mass(part.presence()), count);
}

} // namespace cnem::machining
