#pragma once
// The domains that the contract suite runs on: those of tests/clouds.hpp in the plane; in space meshed blocks
// and what is bent out of them, and clouds of tests/space_clouds.hpp.
#include "clouds/tetrahedral_block.hpp"
#include "core/geometry/facets.hpp"
#include "tests/clouds.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/linear_simplices.hpp"

#include <Eigen/Geometry>

namespace cnem::testing {

template<int dim> struct Domain {
  std::string name;
  Cloud<dim> cloud;
  double spacing;
  bool ties;                               ///< the simplices are not unique: cocircular nodes
  std::vector<voronoi::Simplex<3>> mesh{}; ///< in space
  bool triangulates = false;               ///< the mesh is what triangulate() makes of the cloud
  bool flat = false;                       ///< some of it are flat to rounding: nothing for finite elements
};

/// Random, the same for equal positions, so that a mesh stays closed: up to ±1 for each component.
inline Vec<3> scatter(const Vec<3>& x) {
  Random random(static_cast<std::uint64_t>(std::llround(1e6 * (x.x() + 37.0 * x.y() + 1009.0 * x.z()))));
  const double a = random.uniform(-1, 1), b = random.uniform(-1, 1), c = random.uniform(-1, 1);
  return {a, b, c};
}

/// Convex and non-convex bodies of unit size: one box, a regular block, one whose inner nodes are moved, one
/// whose spacing grows eightfold, a quarter and the whole of a cylinder, half a pipe, a twisted bar.
inline std::vector<Domain<3>> solid_domains() {
  using V = Vec<3>;
  constexpr double pi = std::numbers::pi;
  std::vector<Domain<3>> list;
  const auto add = [&](const std::string& name, const std::array<int, 3>& count, double spacing,
                       const std::function<V(const V&)>& place) {
    auto block = clouds::tetrahedral_block({1, 1, 1}, count, place);
    list.push_back({name, std::move(block.cloud), spacing, false, std::move(block.tetrahedra)});
  };
  const auto disc = [](double x, double y, double z) -> V {
    const Vec2 d = clouds::disc_of_square({x, y});
    return {d.x(), d.y(), z};
  };
  add("box", {1, 1, 1}, 1.0, [](const V& x) { return x; });
  add("block", {3, 4, 5}, 0.2, [](const V& x) { return x; });
  add("block_jittered", {6, 5, 4}, 0.2, [](const V& x) -> V {
    // nodes on a side stay on it
    return x + 0.04 * scatter(x).cwiseProduct(V(x.array().min(1.0 - x.array()).sign()));
  });
  add("block_graded", {6, 4, 4}, 0.05, [](const V& x) -> V {
    return {std::expm1(std::log(8.0) * x.x()) / 7.0, x.y(), x.z() * x.z() * (1.5 - 0.5 * x.z())};
  });
  add("quarter_cylinder", {4, 4, 3}, 0.2, [&](const V& x) { return disc(x.x(), x.y(), x.z()); });
  add("cylinder", {6, 6, 2}, 0.2, [&](const V& x) { return disc(2 * x.x() - 1, 2 * x.y() - 1, x.z()); });
  add("half_pipe", {8, 3, 2}, 0.2, [](const V& x) -> V {
    const double r = 1.0 - 0.5 * x.y();
    return {r * std::cos(pi * (1 - x.x())), r * std::sin(pi * (1 - x.x())), -x.z()};
  });
  add("bar_twisted", {3, 3, 8}, 0.15, [](const V& x) -> V {
    const Vec2 a = 0.5 * (x.head<2>() - Vec2(0.5, 0.5));
    const double c = std::cos(1.5 * x.z()), s = std::sin(1.5 * x.z());
    return {c * a.x() - s * a.y(), s * a.x() + c * a.y(), 2.0 * x.z()};
  });
  return list;
}

/// Clouds whose Delaunay triangulation holds the boundary: lattices that are turned or not, shaken and
/// sheared bodies of all shapes.
inline const std::vector<Domain<3>>& recovered_domains() {
  static const std::vector<Domain<3>> list = [] {
    std::vector<Domain<3>> made;
    const auto add = [&](const std::string& name, const SpaceCloud& how) {
      auto body = recovered(how);
      made.push_back({name, std::move(body.cloud), 0.5 / how.cells, how.jitter == 0.0, body.tetrahedra.node,
                      true, how.jitter == 0.0 && how.turned});
    };
    add("lattice", {.shape = SpaceShape::cube, .cells = 3});
    add("lattice_turned", {.shape = SpaceShape::cube, .cells = 3, .turned = true});
    add("cube_shaken", {.shape = SpaceShape::cube, .cells = 4, .jitter = 0.45});
    add("cube_sheared", {.shape = SpaceShape::cube, .cells = 4, .jitter = 0.3, .shear = 2.0});
    for (const SpaceShape shape : space_shapes)
      if (shape != SpaceShape::cube)
        add(name_of(shape), {.shape = shape, .cells = 4, .jitter = 0.3, .turned = true});
    return made;
  }();
  return list;
}

template<int dim> std::vector<Domain<dim>> all_domains() {
  if constexpr (dim == 3) {
    std::vector<Domain<3>> list = solid_domains();
    list.insert(list.end(), recovered_domains().begin(), recovered_domains().end());
    return list;
  } else {
    std::vector<Domain<2>> list;
    for (NamedCloud& domain : domains())
      list.push_back({std::move(domain.name), std::move(domain.cloud), domain.spacing, domain.ties});
    return list;
  }
}

} // namespace cnem::testing
