// Delaunay tetrahedra that hold the boundary, and the recovery of boundaries they do not hold at first.
#include "voronoi/space/recovery.hpp"

#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/crossings.hpp"
#include "voronoi/space/exact.hpp"
#include "voronoi/space/filling.hpp"
#include "voronoi/space/opened.hpp"
#include "voronoi/space/surface_flips.hpp"
#include "voronoi/space/triangulate.hpp"
#include "voronoi/space/winding.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <limits>

namespace cnem::voronoi::test {
namespace {

using namespace cnem::testing;

std::array<Vec3, 4> corners(const Cloud<3>& cloud, const std::array<NodeIndex, 4>& node) {
  return {cloud.position[node[0]], cloud.position[node[1]], cloud.position[node[2]], cloud.position[node[3]]};
}

/// Positive volumes that add up to what the facets enclose, all facets there, and the same neighbours as
/// those that are found from the tetrahedra alone.
void expect_filled(const Cloud<3>& cloud, const Tetrahedra& mesh) {
  double sum = 0.0;
  for (const auto& node : mesh.node) {
    const auto x = corners(cloud, node);
    EXPECT_GT(orientation(x[0], x[1], x[2], x[3]), 0);
    sum += measure<3>(x);
  }
  const double enclosed = enclosed_measure(cloud);
  EXPECT_NEAR(sum, enclosed, 1e-12 * enclosed);
  const Tetrahedra again = connected(cloud, mesh.node);
  EXPECT_EQ(mesh.neighbour, again.neighbour);
  EXPECT_EQ(mesh.facet, again.facet);
  EXPECT_EQ(mesh.of_node, again.of_node);
}

std::string message_of(const Cloud<3>& cloud) {
  try {
    triangulate(cloud);
  } catch (const GeometryError& e) { return e.what(); }
  return "no error";
}

void expect_error(const Cloud<3>& cloud, std::initializer_list<const char*> parts) {
  const std::string message = message_of(cloud);
  for (const char* part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

SpaceCloud random_cloud(std::uint64_t seed, double most_shear) {
  Random random(seed);
  SpaceCloud how;
  how.shape = space_shapes[seed % space_shapes.size()];
  how.cells = 4 + static_cast<int>(random.uniform(0, 3));
  how.jitter = random.uniform(0, 1) < 0.2 ? 0.0 : random.uniform(0, 0.45);
  how.shear = random.uniform(0, 1) < 0.3 ? 0.0 : random.uniform(0, most_shear);
  how.shear_plane = static_cast<int>(random.uniform(0, 6));
  how.wave = random.uniform(0, 1) < 0.5 ? 0.0 : random.uniform(0, 0.1);
  how.turned = random.uniform(0, 1) < 0.5;
  how.seed = seed;
  return how;
}

TEST(recovery, fills_every_shape_and_triangulating_again_gives_the_same) {
  for (const SpaceShape shape : space_shapes)
    for (const double jitter : {0.0, 0.3}) {
      SCOPED_TRACE(std::string(name_of(shape)) + (jitter > 0.0 ? ", jittered" : ""));
      const RecoveredBoundary body = recovered({.shape = shape, .jitter = jitter});
      expect_filled(body.cloud, body.tetrahedra);
      EXPECT_EQ(triangulate(body.cloud).node, body.tetrahedra.node);
    }
}

TEST(recovery, holds_random_clouds_that_are_sheared_bent_and_turned) {
  int lost = 0, held = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const SpaceCloud how = random_cloud(seed, 1.0);
    SCOPED_TRACE(fmt::format("{} of seed {}", name_of(how.shape), seed));
    RecoveredBoundary body;
    ASSERT_NO_THROW(body = recovered(how));
    expect_filled(body.cloud, body.tetrahedra);
    EXPECT_EQ(triangulate(body.cloud).node, body.tetrahedra.node);
    lost += body.counts.lost > 0;
    held += body.counts.held > 0;
  }
  EXPECT_GT(lost, 15) << "clouds that need no recovery prove nothing";
  EXPECT_GT(held, 10);
}

TEST(recovery, keeps_nodes_pieces_and_what_a_flat_faced_body_encloses) {
  const Cloud<3> cloud = unrecovered({.shape = SpaceShape::notch, .jitter = 0.3, .shear = 1.0});
  const RecoveredBoundary body = recover_boundary(cloud);
  EXPECT_NEAR(enclosed_measure(body.cloud), enclosed_measure(cloud), 1e-12);
  ASSERT_EQ(body.now.size(), cloud.position.size());
  for (const NodeIndex i : cloud.position.indices())
    if (exists(body.now[i])) { EXPECT_EQ(body.cloud.position[body.now[i]], cloud.position[i]); }
  std::vector<double> area(cloud.piece_names.size(), 0.0);
  for (const auto& facet : cloud.facets)
    area[index_of(facet.piece)] += area_normal<3>(corners_of(facet, cloud.position)).norm();
  for (const auto& facet : body.cloud.facets)
    area[index_of(facet.piece)] -= area_normal<3>(corners_of(facet, body.cloud.position)).norm();
  for (const double difference : area) EXPECT_NEAR(difference, 0.0, 1e-12);
}

/// Across a gap of nothing all facets have nodes of the other face in their balls.
TEST(recovery, holds_faces_of_one_body_that_touch) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Cloud<3> cloud = closed_notch(1e-6, {.cells = 8, .jitter = 0.3, .seed = seed});
    ASSERT_TRUE(crossings(cloud).empty());
    RecoveredBoundary body;
    ASSERT_NO_THROW(body = recover_boundary(cloud));
    EXPECT_GT(body.counts.held, 20);
    expect_filled(body.cloud, body.tetrahedra);
    EXPECT_EQ(triangulate(body.cloud).node, body.tetrahedra.node);
  }
}

/// A notch that is closed at one of its ends: few facets touch, and flips hold them.
TEST(recovery, flips_a_few_facets_that_touch) {
  constexpr int cells = 10;
  const double h = 1.0 / cells, root = h * (cells / 2), upper = root + h;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    Cloud<3> cloud =
        recovered({.shape = SpaceShape::notch, .cells = cells, .jitter = 0.2, .seed = seed}).cloud;
    for (Vec3& x : cloud.position)
      if (x.y() > upper - 0.5 * h)
        x.y() -= (1.0 - 1e-6) * std::clamp(root - x.x(), 0.0, h) * std::clamp(1.5 - x.z() / h, 0.0, 1.0);
    flip_surface(cloud, RecoveryRules{}.flat_angle);
    const Delaunay mesh = delaunay(cloud);
    Walls walls = find_walls(cloud, mesh);
    EXPECT_TRUE(faces_touch(cloud, walls.lost));
    EXPECT_FALSE(faces_touch(cloud, {}));
    const auto at_once = filling_at_once(cloud, mesh, walls);
    ASSERT_TRUE(at_once);
    expect_filled(cloud, at_once->tetrahedra);
    const RecoveredBoundary body = recover_boundary(cloud);
    EXPECT_TRUE(body.tetrahedra.node == at_once->tetrahedra.node);
    EXPECT_TRUE(triangulate(body.cloud).node == body.tetrahedra.node);
    while (20 * walls.lost.size() <= cloud.facets.size()) walls.lost.push_back(walls.lost.front());
    EXPECT_FALSE(filling_at_once(cloud, mesh, walls)) << "so many are not tried";
  }
}

TEST(recovery, nothing_crosses_a_slit) {
  const RecoveredBoundary body = recovered({.shape = SpaceShape::slit, .jitter = 0.2});
  ASSERT_FALSE(body.cloud.twins.empty());
  for (const auto& [a, b] : body.cloud.twins)
    for (const auto& node : body.tetrahedra.node) {
      const bool has_a = std::find(node.begin(), node.end(), a) != node.end();
      const bool has_b = std::find(node.begin(), node.end(), b) != node.end();
      EXPECT_FALSE(has_a && has_b);
    }
}

// Where the tip of a bent slit goes to and fro, the other diagonal may join two nodes of the tip, which both
// faces share: it would be one edge of four facets.
TEST(recovery, edges_of_both_faces_of_a_slit_stay_two) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Cloud<3> cloud = unrecovered({.shape = SpaceShape::slit, .cells = 4, .jitter = 0.3, .seed = seed});
    for (Vec3& x : cloud.position) {
      const double width = 0.35 + 0.65 * x.x();
      x = Vec3(1.4 * x.x(), x.y() * width + 0.1 * x.x() * x.x(), 0.7 * x.z() * width);
    }
    flip_surface(cloud, 0.25);
    EXPECT_NO_THROW(surface_edges(cloud)) << "seed " << seed;
  }
}

/// Two prisms with 0.1 mm between them, on the long diagonal of a face that is not flat. Below it is a
/// crease, above the short diagonal looks better, but passes through the crease.
Cloud<3> prisms_on_a_crease() {
  Cloud<3> cloud;
  constexpr double raised = 0.04, gap = 1e-4;
  const std::array<Vec2, 4> base{Vec2(0, 0), Vec2(1, 0), Vec2(1.6, 0.8), Vec2(0.6, 0.8)};
  const auto add = [&](double z, double more) {
    for (std::size_t k = 0; k < 4; ++k)
      cloud.position.push_back({base[k].x(), base[k].y(), z + (k % 2 == 0 ? more : 0.0)});
  };
  add(-1.0, 0.0), add(0.0, raised), add(gap, raised), add(1.0, 0.0);
  const auto facet = [&](int a, int b, int c, int piece) {
    cloud.facets.push_back({{as<NodeIndex>(a), as<NodeIndex>(b), as<NodeIndex>(c)}, as<PieceIndex>(piece)});
  };
  for (const int first : {0, 8}) {
    const int low = first, high = first + 4;
    facet(low, low + 2, low + 1, 0), facet(low, low + 3, low + 2, first == 0 ? 0 : 1);
    facet(high, high + 1, high + 2, first == 0 ? 2 : 1), facet(high, high + 2, high + 3, 1);
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      facet(low + k, low + next, high + next, 3 + k), facet(low + k, high + next, high + k, 3 + k);
    }
  }
  cloud.facets[as<CloudFacetIndex>(12)].piece =
      cloud.facets[as<CloudFacetIndex>(13)].piece; // above: one piece
  for (int k = 0; k < 7; ++k) cloud.piece_names.push_back(std::to_string(k));
  return cloud;
}

TEST(recovery, flips_do_not_push_one_side_through_the_other) {
  const Cloud<3> cloud = prisms_on_a_crease();
  ASSERT_TRUE(crossings(cloud).empty());
  Cloud<3> flipped = cloud;
  flip_surface(flipped, RecoveryRules{}.flat_angle);
  ASSERT_FALSE(crossings(flipped).empty());
  const RecoveredBoundary body = recover_boundary(cloud);
  EXPECT_TRUE(crossings(body.cloud).empty());
  expect_filled(body.cloud, body.tetrahedra);
}

TEST(triangulation_in_space, circumspheres_are_empty) {
  const RecoveredBoundary body = recovered({.cells = 4, .jitter = 0.3});
  ASSERT_EQ(body.counts.held, 0);
  for (const auto& node : body.tetrahedra.node) {
    const auto x = corners(body.cloud, node);
    Eigen::Matrix3d rows;
    Vec3 right;
    for (Eigen::Index k = 0; k < 3; ++k) {
      rows.row(k) = 2.0 * (x[static_cast<std::size_t>(k) + 1] - x[0]).transpose();
      right[k] = (x[static_cast<std::size_t>(k) + 1] - x[0]).squaredNorm();
    }
    const Vec3 to = rows.inverse() * right;
    for (const Vec3& other : body.cloud.position)
      EXPECT_GT((other - x[0] - to).squaredNorm(), to.squaredNorm() * (1.0 - 1e-9));
  }
}

TEST(triangulation_in_space, does_not_depend_on_the_order_of_facets) {
  const RecoveredBoundary body = recovered({.shape = SpaceShape::slit, .jitter = 0.2, .shear = 0.5});
  Cloud<3> cloud = body.cloud;
  std::reverse(cloud.facets.begin(), cloud.facets.end());
  for (auto& facet : cloud.facets) std::rotate(facet.node.begin(), facet.node.begin() + 1, facet.node.end());
  EXPECT_EQ(triangulate(cloud).node, body.tetrahedra.node);
}

TEST(triangulation_in_space, a_turned_cloud_has_the_same_tetrahedra) {
  const SpaceCloud how{.shape = SpaceShape::l, .jitter = 0.3};
  SpaceCloud turned = how;
  turned.turned = true;
  EXPECT_EQ(recovered(how).tetrahedra.node, recovered(turned).tetrahedra.node);
}

TEST(triangulation_in_space, winding_numbers_tell_inside_from_outside) {
  const Cloud<3> shell = unrecovered({.shape = SpaceShape::shell, .cells = 8});
  const Winding winding(shell);
  EXPECT_EQ(winding({0.0, 0.0, 0.0}), 0);
  EXPECT_EQ(winding({0.3, 0.1, 0.0}), 1);
  EXPECT_EQ(winding({0.0, 0.0, -0.35}), 1);
  EXPECT_EQ(winding({0.5, 0.5, 0.5}), 0);
  const Cloud<3> cube = unrecovered({.cells = 4});
  EXPECT_EQ(Winding(cube)({0.5, 0.5, 1.0}), 0) << "on a facet";
  EXPECT_EQ(Winding(cube)({0.5, 0.5, 0.0}), 0) << "on a facet";
  EXPECT_EQ(Winding(cube)({0.25, 0.25, 0.5}), 1) << "below an edge and a node";
}

TEST(triangulation_in_space, says_that_lost_facets_want_recovery) {
  const SpaceCloud how{.shape = SpaceShape::notch, .cells = 6, .shear = 1.54, .shear_plane = 3};
  expect_error(unrecovered(how), {"facets are no faces of Delaunay tetrahedra", "node", "recovered first"});
  const RecoveredBoundary body = recovered(how);
  expect_filled(body.cloud, body.tetrahedra);
}

TEST(triangulation_in_space, of_a_turned_lattice_hardly_a_tetrahedron_is_flat) {
  std::size_t flat = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    const RecoveredBoundary body = recovered({.shape = space_shapes[seed - 1], .turned = true, .seed = seed});
    expect_filled(body.cloud, body.tetrahedra);
    for (const auto& node : body.tetrahedra.node) flat += is_flat(corners(body.cloud, node));
    all += body.tetrahedra.node.size();
  }
  EXPECT_LT(flat, all / 500);
}

TEST(triangulation_in_space, refuses_bad_clouds_by_their_nodes) {
  const Cloud<3> good = recovered({.cells = 3}).cloud;
  Cloud<3> cloud = good;
  cloud.facets.pop_back();
  expect_error(cloud, {"open surface", "node ", " m"});

  cloud = good;
  cloud.facets.clear();
  expect_error(cloud, {"no boundary facets"});

  cloud = good;
  for (auto& facet : cloud.facets) std::swap(facet.node[0], facet.node[1]);
  expect_error(cloud, {"inside out", "node ", " m"});

  cloud = good;
  std::swap(cloud.facets.front().node[0], cloud.facets.front().node[1]);
  expect_error(cloud, {"in the same direction", "node "});

  cloud = good;
  cloud.position.push_back({2.0, 2.0, 2.0});
  expect_error(cloud,
               {fmt::format("node {} at (2, 2, 2) m lies outside", cloud.position.size() - 1).c_str()});

  cloud = good;
  cloud.position.push_back(cloud.position[std::size_t{5}]);
  expect_error(cloud, {"coincides with node 5"});

  cloud = good;
  cloud.position[std::size_t{3}].y() = std::numeric_limits<double>::quiet_NaN();
  expect_error(cloud, {"node 3", "not finite"});

  cloud = good;
  cloud.facets.front().node[2] = as<NodeIndex>(cloud.position.size());
  expect_error(cloud, {"facet 0 names node"});

  cloud = good; // a corner pushed through the opposite side
  cloud.position[std::size_t{0}] = Vec3(1.6, 1.4, 1.5);
  expect_error(cloud, {"crosses itself", "facet ", " m"});
}

} // namespace
} // namespace cnem::voronoi::test
