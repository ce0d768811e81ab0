// Sibson and Laplace functions in space.
#include "tests/space_clouds.hpp"
#include "voronoi/space/edge_rings.hpp"
#include "voronoi/space/natural_neighbours.hpp"
#include "voronoi/space/triangulate.hpp"

#include <gtest/gtest.h>
#include <map>

namespace cnem::testing {
namespace {

using namespace voronoi;

constexpr std::array all_functions{Functions::sibson, Functions::laplace, Functions::linear};

struct Evaluated {
  Cloud<3> cloud;
  Tetrahedra mesh;
  Circumspheres spheres;
  FunctionMesh records;
  NaturalNeighbours3 functions;

  explicit Evaluated(RecoveredBoundary made)
      : cloud(std::move(made.cloud)), mesh(std::move(made.tetrahedra)), spheres(circumspheres(cloud, mesh)),
        records(cloud, mesh, spheres), functions(cloud, mesh, records) {}
  explicit Evaluated(const SpaceCloud& how) : Evaluated(recovered(how)) {}

  Vec3 at(SimplexIndex t, const std::array<double, 4>& weight) const {
    Vec3 x = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) x += weight[k] * cloud.position[mesh.node[t][k]];
    return x;
  }
  /// [node] φ, of those that are not zero.
  std::map<NodeIndex, double> values(Functions which, const Vec3& x, SimplexIndex hint) {
    functions.evaluate(which, x, hint);
    std::map<NodeIndex, double> value;
    for (std::size_t k = 0; k < functions.nodes().size(); ++k)
      if (functions.values()[k] != 0.0) value[functions.nodes()[k]] += functions.values()[k];
    return value;
  }
};

/// Inside, on a face, on an edge, at a node, and next to them.
constexpr std::array<std::array<double, 4>, 8> places{{{0.25, 0.25, 0.25, 0.25},
                                                       {0.1, 0.2, 0.3, 0.4},
                                                       {0.3, 0.3, 0.4, 0.0},
                                                       {0.5, 0.5, 0.0, 0.0},
                                                       {0.0, 0.3, 0.0, 0.7},
                                                       {0.0, 0.0, 1.0, 0.0},
                                                       {1 - 3e-9, 1e-9, 1e-9, 1e-9},
                                                       {0.4, 0.6 - 2e-12, 1e-12, 1e-12}}};

TEST(SpaceFunctions, sum_to_one_reproduce_positions_and_are_not_negative) {
  for (const SpaceShape shape : space_shapes)
    for (const double jitter : {0.0, 0.35})
      for (const bool turned : {false, true}) {
        SCOPED_TRACE(std::string(name_of(shape)) + " jitter " + std::to_string(jitter));
        Evaluated e({.shape = shape, .cells = 4, .jitter = jitter, .turned = turned});
        for (const Functions which : all_functions)
          for (std::size_t k = 0; k < e.mesh.node.size(); k += 3)
            for (const auto& weight : places) {
              const auto t = as<SimplexIndex>(k);
              const Vec3 x = e.at(t, weight);
              double sum = 0.0;
              Vec3 place = -x;
              for (const auto& [node, value] : e.values(which, x, t)) {
                EXPECT_GE(value, -1e-9);
                sum += value;
                place += value * e.cloud.position[node];
              }
              ASSERT_NEAR(sum, 1.0, 1e-13);
              ASSERT_LT(place.norm(), 1e-13);
            }
      }
}

TEST(SpaceFunctions, are_found_without_falling_back_on_convex_bodies) {
  for (const double jitter : {0.0, 0.2, 0.45}) {
    Evaluated e({.shape = SpaceShape::cube, .cells = 5, .jitter = jitter, .turned = true});
    for (const SimplexIndex t : e.mesh.node.indices())
      e.functions.evaluate(Functions::sibson, e.at(t, places[1]), t);
    EXPECT_EQ(e.functions.fallbacks().to_laplace, 0);
    EXPECT_EQ(e.functions.fallbacks().to_linear, 0);
  }
}

TEST(SpaceFunctions, are_one_at_their_node_and_zero_at_others) {
  Evaluated e({.shape = SpaceShape::l, .cells = 4, .jitter = 0.3});
  for (const Functions which : all_functions)
    for (const NodeIndex i : e.cloud.position.indices()) {
      const auto value = e.values(which, e.cloud.position[i], e.mesh.of_node[i]);
      for (const auto& [node, v] : value) EXPECT_NEAR(v, node == i ? 1.0 : 0.0, 1e-13);
      EXPECT_EQ(value.count(i), 1U);
    }
}

TEST(SpaceFunctions, are_linear_on_boundary_facets) {
  for (const bool turned : {false, true}) {
    Evaluated e({.shape = SpaceShape::one_hole, .cells = 6, .jitter = 0.3, .turned = turned});
    for (const Functions which : {Functions::sibson, Functions::laplace})
      for (const SimplexIndex t : e.mesh.node.indices())
        for (std::size_t k = 0; k < 4; ++k) {
          if (!exists(e.mesh.facet[t][k])) continue;
          std::array<double, 4> weight{0.2, 0.2, 0.2, 0.2};
          weight[k] = 0.0;
          weight[(k + 1) % 4] = 0.6;
          const auto value = e.values(which, e.at(t, weight), t);
          for (const auto& [node, v] : value) {
            const auto& own = e.mesh.node[t];
            const auto at = std::find(own.begin(), own.end(), node);
            if (at == own.end()) {
              EXPECT_NEAR(v, 0.0, 1e-9);
            } else {
              EXPECT_NEAR(v, weight[index_of(at - own.begin())], 1e-9);
            }
          }
        }
  }
}

/// At the centre of a box of the lattice all corners are alike; on the middle of an edge of it also the next
/// ones count, by symmetry.
TEST(SpaceFunctions, of_a_lattice_have_its_symmetry) {
  const int n = 4;
  Evaluated e({.shape = SpaceShape::cube, .cells = n});
  const double h = 1.0 / n;
  const Vec3 centre(1.5 * h, 1.5 * h, 1.5 * h), middle(1.5 * h, 2 * h, 2 * h);
  for (const Functions which : {Functions::sibson, Functions::laplace}) {
    for (const SimplexIndex t : e.mesh.node.indices()) { // from everywhere
      const auto value = e.values(which, centre, t);
      double corners = 0.0;
      for (const auto& [node, v] : value)
        if ((e.cloud.position[node] - centre).norm() < 0.9 * h) {
          EXPECT_NEAR(v, 0.125, 1e-13);
          corners += v;
        }
      EXPECT_NEAR(corners, 1.0, 1e-12);
    }
    std::vector<double> ends;
    for (const auto& [node, v] : e.values(which, middle, e.mesh.of_node[0]))
      if ((e.cloud.position[node] - middle).norm() < 0.51 * h) ends.push_back(v);
    ASSERT_EQ(ends.size(), 2U);
    EXPECT_NEAR(ends[0], ends[1], 1e-13);
    EXPECT_GT(ends[0], 0.3);
  }
}

/// What Sibson's functions are by definition: the shares of nodes in what is nearer to x than to any node.
TEST(SpaceFunctions, sibson_are_shares_of_stolen_volume) {
  Evaluated e({.shape = SpaceShape::cube, .cells = 5, .jitter = 0.3, .seed = 3});
  Random random(7);
  for (int point = 0; point < 3; ++point) {
    const Vec3 x(random.uniform(0.4, 0.6), random.uniform(0.4, 0.6), random.uniform(0.4, 0.6));
    const auto value = e.values(Functions::sibson, x, e.mesh.of_node[0]);
    std::map<NodeIndex, int> hits;
    int stolen = 0;
    for (int sample = 0; sample < 60000; ++sample) {
      const Vec3 y = x + 0.3 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      double least = (y - x).squaredNorm();
      NodeIndex nearest = NodeIndex::none;
      double before = 1e9;
      for (const NodeIndex i : e.cloud.position.indices()) {
        const double distance = (y - e.cloud.position[i]).squaredNorm();
        if (distance < before) {
          before = distance;
          nearest = i;
        }
        if (distance < least) break;
      }
      if (before < least) continue;
      ++stolen;
      ++hits[nearest];
    }
    ASSERT_GT(stolen, 500);
    for (const auto& [node, count] : hits) {
      const double share = count / double(stolen), deviation = std::sqrt(share / stolen);
      EXPECT_NEAR(value.count(node) != 0 ? value.at(node) : 0.0, share, 4.5 * deviation + 1e-3);
    }
  }
}

/// Laplace's functions by their definition, the areas of the facets of the cell of x over the distances: of x
/// as one more node.
TEST(SpaceFunctions, laplace_are_areas_of_facets_over_distances) {
  Evaluated e({.shape = SpaceShape::cube, .cells = 4, .jitter = 0.3, .seed = 5});
  const Vec3 x(0.43, 0.52, 0.56);
  const auto value = e.values(Functions::laplace, x, e.mesh.of_node[0]);
  Cloud<3> with = e.cloud;
  with.position.push_back(x);
  const Tetrahedra mesh = triangulate(with);
  const NodeIndex self = as<NodeIndex>(with.nodes() - 1);
  const Circumspheres spheres = circumspheres(with, mesh);
  const EdgeRings rings = edge_rings(mesh);
  std::map<NodeIndex, double> weight;
  double sum = 0.0;
  for (const EdgeIndex edge : rings.end.indices()) {
    const auto& [i, j] = rings.end[edge];
    if (j != self) continue;
    const auto ring = rings.of(edge);
    Vec3 area = Vec3::Zero();
    for (std::size_t k = 0; k < ring.size(); ++k)
      area += 0.5 * (spheres.centre[index_of(ring[k])] - x)
                        .cross(spheres.centre[index_of(ring[(k + 1) % ring.size()])] - x);
    weight[i] = area.norm() / (with.position[i] - x).norm();
    sum += weight[i];
  }
  ASSERT_GT(weight.size(), 6U);
  EXPECT_EQ(value.size(), weight.size());
  for (const auto& [node, w] : weight) EXPECT_NEAR(value.at(node), w / sum, 1e-12);
}

/// Nodes of the other face of a slit have no part, wherever x is beside it.
TEST(SpaceFunctions, see_nothing_across_a_slit) {
  const int n = 8;
  for (const double jitter : {0.0, 0.3}) {
    Evaluated e({.shape = SpaceShape::slit, .cells = n, .jitter = jitter});
    const double h = 1.0 / n, plane = 0.5;
    std::size_t beside = 0;
    for (const SimplexIndex t : e.mesh.node.indices()) {
      const Vec3 x = e.at(t, places[1]);
      const auto below = [&](NodeIndex i) {
        for (std::size_t k = 0; k < 4; ++k)
          if (e.mesh.node[t][k] == i) return true;
        return false;
      };
      // far from the end of the slit, at x = 1/2, nothing goes round it
      if (x.x() > 0.5 - 2.5 * h || std::abs(x.y() - plane) > 1.5 * h) continue;
      ++beside;
      for (const Functions which : all_functions)
        for (const auto& [node, v] : e.values(which, x, t)) {
          const double side = e.cloud.position[node].y() - plane;
          if (std::abs(side) > 1e-9)
            EXPECT_GT(side * (x.y() - plane), 0.0);
          else if (!below(node)) // a node on the slit: of this face, so that its tetrahedra are on this side
            for (const NodeIndex other : e.mesh.node[e.mesh.of_node[node]]) {
              EXPECT_GE((e.cloud.position[other].y() - plane) * (x.y() - plane), -1e-12);
            }
        }
    }
    EXPECT_GT(beside, 100U);
  }
}

TEST(SpaceFunctions, outside_of_the_body_are_the_linear_ones_of_where_it_is_left) {
  Evaluated e({.shape = SpaceShape::cube, .cells = 3, .jitter = 0.2});
  const Vec3 x(0.4, 0.5, 1.05);
  const auto value = e.values(Functions::sibson, x, e.mesh.of_node[0]);
  EXPECT_LE(value.size(), 4U);
  Vec3 place = Vec3::Zero();
  for (const auto& [node, v] : value) place += v * e.cloud.position[node];
  EXPECT_LT((place - x).norm(), 1e-14);
}

} // namespace
} // namespace cnem::testing
