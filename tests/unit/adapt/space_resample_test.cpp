// The pass in space keeps mass, momentum and heat to rounding and the volume of the body, nodes that nothing
// happened to, held nodes, faces and creases; and clouds that deform far beyond what one triangulation
// bears keep a surface that does not cross itself, matter where the volume is, and healthy spacings.
#include "adapt/space/resample.hpp"
#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/crossings.hpp"
#include "voronoi/space/triangulate.hpp"

#include <gtest/gtest.h>
#include <omp.h>

namespace cnem::adapt {
namespace {

using testing::Random;
using testing::SpaceCloud;
using testing::SpaceShape;

/// What comes of a cloud does not depend on the tetrahedra that it brings.
void expect_own_tetrahedra(const Cloud<3>& cloud) {
  Cloud<3> bare = cloud;
  bare.simplices.clear();
  const voronoi::Tetrahedra brought = voronoi::triangulate(cloud), anew = voronoi::triangulate(bare);
  EXPECT_EQ(brought.node, anew.node);
  EXPECT_EQ(brought.neighbour, anew.neighbour);
  EXPECT_EQ(brought.facet, anew.facet);
  EXPECT_EQ(brought.of_node, anew.of_node);
}

/// A body of matter of density 2 that deforms and is resampled.
struct FollowedBody {
  Cloud<3> cloud;
  double spacing;
  Field mass, momentum, heat, jacobian, size, broken;
  IndexedVector<NodeIndex, char> held;
  PassReport total;
  SpaceRules rules;

  explicit FollowedBody(const SpaceCloud& how, scni::CellKind cells = scni::CellKind::median)
      : FollowedBody(testing::recovered(how), 1.0 / how.cells, cells) {}
  FollowedBody(voronoi::RecoveredBoundary recovered, double h, scni::CellKind cells = scni::CellKind::median)
      : spacing(h) {
    rules.cells = cells;
    cloud = recovered.cloud;
    const SpaceStructure structure = structure_of(cloud, std::move(recovered.tetrahedra), cells);
    Random random(5);
    for (const double volume : structure.cell) {
      jacobian.push_back(random.uniform(0.99, 1.01));
      mass.push_back(2.0 * volume / jacobian.back());
      momentum.push_back(mass.back() * random.uniform(-1.0, 1.0));
      heat.push_back(mass.back() * random.uniform(300.0, 900.0));
    }
    size.assign(mass.size(), spacing);
    held.assign(mass.size(), 0);
  }

  Resampling<3> resample(PassReport& report) const {
    NodeProperties properties;
    properties.mass = mass;
    properties.jacobian = jacobian;
    properties.density.assign(mass.size(), 2.0);
    properties.size = size;
    properties.held = held;
    properties.broken = broken;
    properties.part.assign(cloud.body.begin(), cloud.body.end());
    return adapt::resample(cloud, std::move(properties), rules, report);
  }

  void follow(const Resampling<3>& change) {
    carry_mean(change.parcels, mass, jacobian);
    for (Field* carried : {&mass, &momentum, &heat}) carry_sum(change.parcels, *carried);
    carry_label(change.labels, size);
    IndexedVector<NodeIndex, char> now(change.old_of.size(), 0);
    for (const NodeIndex p : now.indices())
      if (exists(change.old_of[p])) now[p] = held[change.old_of[p]];
    held = now;
    cloud = change.cloud;
    expect_own_tetrahedra(cloud);
    cloud.simplices.clear(); // nodes will move
  }
  void deform(const std::function<Vec3(const Vec3&)>& motion) {
    for (Vec3& x : cloud.position) x = motion(x);
  }
};

double sum(const Field& field) {
  double total = 0.0;
  for (const double value : field) total += value;
  return total;
}

/// One pass, and what must hold after each.
PassReport pass(FollowedBody& body) {
  const double mass = sum(body.mass), momentum = sum(body.momentum), heat = sum(body.heat);
  const double volume = enclosed_measure(body.cloud);
  PassReport report;
  const Resampling<3> change = body.resample(report);
  body.follow(change);
  EXPECT_NEAR(sum(body.mass), mass, 1e-13 * mass);
  EXPECT_NEAR(sum(body.momentum), momentum, 1e-13 * mass);
  EXPECT_NEAR(sum(body.heat), heat, 1e-13 * heat);
  EXPECT_NEAR(enclosed_measure(body.cloud) - volume, report.volume_change, 1e-14);
  EXPECT_EQ(report.crossings, 0);
  EXPECT_TRUE(voronoi::crossings(body.cloud).empty());
  const SpaceStructure structure =
      structure_of(body.cloud, voronoi::triangulate(body.cloud), body.rules.cells);
  Cloud<3> anew = body.cloud;
  anew.simplices.clear();
  anew.across.clear();
  EXPECT_EQ(voronoi::triangulate(anew).node, structure.mesh.node);
  for (std::size_t i = 0; i < body.mass.size(); ++i) {
    const double ratio = 2.0 * structure.cell[i] / (body.mass[i] * body.jacobian[i]);
    EXPECT_GT(ratio, 0.79) << i;
    EXPECT_LT(ratio, 1.26) << i;
  }
  body.total += report;
  return report;
}

struct Edges {
  double shortest, longest; ///< over the spacing, the longest over that of its place
};
/// wider: spacing at a place over that of the body.
Edges edges_of(
    const FollowedBody& body,
    const std::function<double(const Vec3&)>& wider = [](const Vec3&) { return 1.0; }) {
  Edges edges{1e9, 0.0};
  const SpaceStructure structure = structure_of(body.cloud, voronoi::triangulate(body.cloud));
  for (const NodeIndex i : body.cloud.position.indices())
    for (const NodeIndex k : structure.neighbours(i)) {
      const Vec3 &a = body.cloud.position[i], &b = body.cloud.position[k];
      const double length = (b - a).norm() / body.spacing;
      edges.shortest = std::min(edges.shortest, length);
      edges.longest = std::max(edges.longest, length / wider(0.5 * (a + b)));
    }
  return edges;
}

TEST(SpaceResample, leaves_a_body_alone_that_needs_nothing) {
  FollowedBody body({.shape = SpaceShape::l, .cells = 6, .jitter = 0.2});
  pass(body);
  PassReport report;
  const Resampling<3> change = body.resample(report);
  EXPECT_FALSE(report.changed());
  EXPECT_EQ(change.cloud.position, body.cloud.position);
  EXPECT_FALSE(change.cloud.simplices.empty());
  for (std::size_t p = 0; p < change.old_of.size(); ++p) {
    EXPECT_FALSE(change.mixed(p));
    EXPECT_EQ(change.old_of[p], as<NodeIndex>(p));
  }
}

TEST(SpaceResample, comes_with_no_nodes_between_debris) {
  FollowedBody body({.shape = SpaceShape::cube, .cells = 4, .jitter = 0.2});
  for (double& h : body.size) h *= 0.5; // of edges, which all are too long then
  body.broken.assign(body.mass.size(), 1.0);
  for (double& m : body.mass) m /= 4.1;
  for (double& J : body.jacobian) J *= 4.1;
  PassReport report;
  body.resample(report);
  EXPECT_EQ(report.inserted + report.inserted_boundary, 0);
  for (double& b : body.broken) b = 0.99;
  body.resample(report);
  EXPECT_GT(report.inserted, 50);
  EXPECT_GT(report.inserted_boundary, 100);
}

TEST(SpaceResample, keeps_nodes_that_nothing_happened_to_and_held_ones) {
  FollowedBody body({.shape = SpaceShape::cube, .cells = 8, .jitter = 0.2});
  for (std::size_t i = 0; i < body.held.size(); i += 7) body.held[i] = 1;
  body.deform([](const Vec3& x) { return Vec3(x.x() + 0.6 * x.y() * x.y(), x.y(), x.z()); });
  PassReport report;
  const Resampling<3> change = body.resample(report);
  ASSERT_EQ(change.labels.size(), change.cloud.position.size());
  int alone = 0;
  for (std::size_t p = 0; p < change.old_of.size(); ++p) {
    if (!exists(change.old_of[p])) continue;
    const auto e = index_of(change.labels.begin[p]); // labels stay with nodes
    EXPECT_EQ(change.labels.begin[p + 1] - change.labels.begin[p], 1);
    EXPECT_EQ(change.labels.from[e], change.old_of[p]);
    EXPECT_EQ(change.labels.weight[e], 1.0);
    alone +=
        !change.mixed(p) && change.cloud.position[as<NodeIndex>(p)] == body.cloud.position[change.old_of[p]];
  }
  EXPECT_GT(alone, 200);
  EXPECT_GT(report.inserted_boundary, 0);
  for (const NodeIndex i : body.held.indices()) {
    if (!body.held[i]) continue;
    ASSERT_TRUE(exists(change.new_of[i]));
    EXPECT_EQ(change.cloud.position[change.new_of[i]], body.cloud.position[i]);
  }
}

TEST(SpaceResample, makes_the_same_bits_with_any_number_of_threads) {
  FollowedBody body({.shape = SpaceShape::torus, .cells = 12, .jitter = 0.2});
  body.deform([](const Vec3& x) { return Vec3(x.x() + 0.5 * x.y(), x.y(), x.z()); });
  const int threads = omp_get_max_threads();
  std::vector<Resampling<3>> results;
  for (const int n : {1, 3}) {
    omp_set_num_threads(n);
    PassReport report;
    results.push_back(body.resample(report));
    EXPECT_TRUE(report.changed());
  }
  omp_set_num_threads(threads);
  EXPECT_EQ(results[0].cloud.position, results[1].cloud.position);
  EXPECT_EQ(results[0].parcels.from, results[1].parcels.from);
  EXPECT_EQ(results[0].parcels.weight, results[1].parcels.weight);
  EXPECT_EQ(results[0].labels.weight, results[1].labels.weight);
}

TEST(SpaceResample, shears_a_block_to_four) {
  FollowedBody body({.shape = SpaceShape::cube, .cells = 7, .jitter = 0.2});
  const std::size_t before = body.mass.size();
  for (int step = 0; step < 16; ++step) {
    body.deform([](const Vec3& x) { return Vec3(x.x() + 0.25 * x.y(), x.y(), x.z()); });
    EXPECT_NEAR(pass(body).volume_change, 0.0, 1e-13);
  }
  // two edges have become 14 degrees sharp, where the spacing is four times as wide
  const Edges edges = edges_of(body, [&](const Vec3& x) {
    const double off = std::min(std::hypot(x.x(), x.y()), std::hypot(x.x() - 5.0, x.y() - 1.0));
    return std::max(1.0, 4.0 - 0.5 * off / body.spacing);
  });
  EXPECT_GT(edges.shortest, 0.25);
  EXPECT_LT(edges.longest, 2.2);
  EXPECT_GT(body.mass.size(), before);
  EXPECT_LT(body.mass.size(), 2 * before);
  EXPECT_GT(body.total.flipped, 100);
  EXPECT_GT(body.total.removed, 10);
  EXPECT_GT(body.total.inserted, 10);
  EXPECT_GT(body.total.removed_boundary, 10);
  EXPECT_EQ(body.total.undone, 0);
}

TEST(SpaceResample, upsets_a_block_to_a_third_of_its_height) {
  FollowedBody body({.shape = SpaceShape::cube, .cells = 7, .jitter = 0.2});
  const std::size_t before = body.mass.size();
  const double q = std::pow(0.3, 1.0 / 12);
  for (int step = 0; step < 12; ++step) {
    body.deform([q](const Vec3& x) { return Vec3(x.x() / std::sqrt(q), x.y() / std::sqrt(q), x.z() * q); });
    EXPECT_NEAR(pass(body).volume_change, 0.0, 1e-13);
  }
  const Edges edges = edges_of(body);
  EXPECT_GT(edges.shortest, 0.2);
  EXPECT_LT(edges.longest, 2.2);
  EXPECT_LT(body.mass.size(), 2 * before);
}

TEST(SpaceResample, keeps_the_volume_of_bodies_with_bent_surfaces) {
  for (const SpaceShape shape : {SpaceShape::torus, SpaceShape::shell, SpaceShape::thin_wall}) {
    FollowedBody body({.shape = shape, .cells = 10, .jitter = 0.2});
    const double volume = enclosed_measure(body.cloud);
    for (int step = 0; step < 6; ++step) {
      body.deform([](const Vec3& x) { return Vec3(x.x() + 0.25 * x.y(), x.y(), x.z()); });
      pass(body);
    }
    EXPECT_NEAR(enclosed_measure(body.cloud), volume, 1e-6 * volume) << name_of(shape);
  }
}

TEST(SpaceResample, fills_voronoi_cells_where_the_method_has_these) {
  FollowedBody body({.shape = SpaceShape::cube, .cells = 6, .jitter = 0.2}, scni::CellKind::voronoi);
  for (int step = 0; step < 4; ++step) {
    body.deform([](const Vec3& x) { return Vec3(x.x() + 0.4 * x.y(), x.y(), x.z()); });
    pass(body);
  }
  EXPECT_GT(body.total.balanced, 10);
}

TEST(SpaceResample, refuses_a_surface_that_crosses_itself_and_counts_where) {
  FollowedBody body({.shape = SpaceShape::thin_wall, .cells = 6});
  const auto middle = std::find_if(body.cloud.position.begin(), body.cloud.position.end(),
                                   [](const Vec3& x) { return (x - Vec3(0.5, 0.5, 0.0)).norm() < 1e-9; });
  ASSERT_NE(middle, body.cloud.position.end());
  middle->z() = 1.5 * body.spacing; // through the other side
  PassReport report;
  EXPECT_THROW(body.resample(report), GeometryError);
  EXPECT_GT(report.crossings, 0);
}

// A node on top falls over the ring around it, one on an edge over that: what is left of a ridge under a
// tool.
TEST(SpaceResample, takes_folds_out_and_keeps_planes_and_volume) {
  FollowedBody body({.shape = SpaceShape::cube, .cells = 6});
  const double volume = enclosed_measure(body.cloud), h = body.spacing;
  const auto node_at = [&](const Vec3& x) -> Vec3& {
    return *std::min_element(
        body.cloud.position.begin(), body.cloud.position.end(),
        [&](const Vec3& a, const Vec3& b) { return (a - x).squaredNorm() < (b - x).squaredNorm(); });
  };
  node_at({0.5, 0.5, 1.0}) += h * Vec3(1.2, 0.1, -0.3);
  node_at({0.0, 0.5, 1.0}) += h * Vec3(0.0, 1.15, -0.1);
  PassReport report;
  body.follow(body.resample(report));
  EXPECT_GT(report.crossings, 0);
  EXPECT_GT(report.folded, 0);
  EXPECT_TRUE(voronoi::crossings(body.cloud).empty());
  EXPECT_NEAR(enclosed_measure(body.cloud), volume, 0.01 * volume);
  double on_plane = 0.0;
  for (const Facet<3>& facet : body.cloud.facets) {
    const auto x = corners_of<3>(facet, body.cloud.position);
    if (x[0].x() == 0.0 && x[1].x() == 0.0 && x[2].x() == 0.0) on_plane += area_normal<3>(x).norm();
  }
  EXPECT_NEAR(on_plane, 1.0, 0.02);
}

// What two bodies have in common where they press on each other is no fold: nothing is smoothed, nothing goes
// from one to the other, and each keeps its volume as it is upset.
TEST(SpaceResample, bodies_that_press_on_each_other_keep_their_volume) {
  constexpr int cells = 6;
  FollowedBody body(voronoi::recover_boundary(testing::pressed_cubes(cells, 0.02, true)), 1.0 / cells);
  const auto of_first = [&] {
    double mass = 0.0;
    for (const NodeIndex i : body.cloud.position.indices())
      if (body.cloud.body[i] == 0) mass += body.mass[index_of(i)];
    return mass;
  };
  const double volume = enclosed_measure(body.cloud);
  const double mass = of_first();
  for (int step = 0; step < 8; ++step) {
    body.deform([](const Vec3& x) {
      constexpr double press = 0.94;
      const double wide = 1.0 / std::sqrt(press);
      return Vec3(wide * x.x(), wide * x.y(), press * x.z());
    });
    pass(body);
    ASSERT_FALSE(body.cloud.body.empty());
    EXPECT_NEAR(of_first(), mass, 1e-13);
  }
  EXPECT_GT(body.total.inserted + body.total.inserted_boundary, 20);
  EXPECT_EQ(body.total.folded, 0);
  EXPECT_EQ(body.total.crossings, 0);
  EXPECT_NEAR(enclosed_measure(body.cloud), volume, 1e-10);
}

} // namespace
} // namespace cnem::adapt
