#pragma once
// A rectangle to resample: 1 m by 0.6 m, a density of 1.
#include "adapt/resample.hpp"
#include "tests/clouds.hpp"

namespace cnem::adapt {

struct Blank {
  Cloud<2> cloud;
  NodeProperties node;

  /// Gives each node of the cloud the mass of its cell, nothing held.
  void weigh(double spacing, Space space = Space::plane) {
    const Structure structure = build_structure(cloud, space);
    node.mass.clear();
    for (const NodeIndex i : cloud.position.indices()) node.mass.push_back(structure.volume(i));
    const std::size_t n = node.mass.size();
    node.jacobian.assign(n, 1.0);
    node.density.assign(n, 1.0);
    node.size.assign(n, spacing);
    node.held.assign(n, 0);
  }
};

/// Equal cells, but for `jitter`.
inline Blank blank(double spacing, double jitter = 0.2) {
  Blank b;
  testing::add_loop(b.cloud, testing::rectangle(1.0, 0.6), spacing);
  testing::fill(b.cloud, testing::Lattice::hexagonal, spacing, jitter, 0.5 * spacing, 1);
  b.weigh(spacing);
  return b;
}

} // namespace cnem::adapt
