#pragma once
// Adversarial random clouds: every family of domain and of node pattern that has broken a Voronoi code
// before.
#include "core/geometry/cloud.hpp"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace cnem::voronoi::test {

struct RandomCloud {
  Cloud<2> cloud;
  double area = 0.0; ///< of the domain, from its loops
  double size = 0.0; ///< diagonal of its box
  std::string name;
};

/// The cloud of the given family and seed, in Hilbert order, placed at a random angle unless the family says
/// otherwise.
RandomCloud random_cloud(int family, std::uint32_t seed);

/// Number of families.
int families();

} // namespace cnem::voronoi::test
