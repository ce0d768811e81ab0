// Thousands of random changes leave a surface closed, without branches and of the same genus, change the
// volume by what they say, and leave plane faces and straight creases where they are.
#include "adapt/space/working_surface.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/crossings.hpp"

#include <gtest/gtest.h>
#include <map>

namespace cnem::adapt {
namespace {

using testing::Random;
using testing::SpaceShape;
using Edge = WorkingSurface::Edge;

WorkingSurface surface_of(const Cloud<3>& cloud) {
  return WorkingSurface(cloud, IndexedVector<NodeIndex, char>(cloud.position.size(), 0));
}

Cloud<3> cloud_of(const WorkingSurface& surface, const Cloud<3>& like) {
  Cloud<3> cloud = like;
  cloud.position = surface.position();
  cloud.facets = surface.facets();
  return cloud;
}

int euler_characteristic(const Cloud<3>& cloud) {
  IndexedVector<NodeIndex, char> used(cloud.position.size(), 0);
  for (const auto& facet : cloud.facets)
    for (const NodeIndex i : facet.node) used[i] = 1;
  const auto facets = static_cast<int>(cloud.facets.size());
  return static_cast<int>(std::count(used.begin(), used.end(), 1)) - 3 * facets / 2 + facets;
}

struct Made {
  std::map<Refusal, int> refused;
  int split = 0, collapsed = 0, flipped = 0;
  double volume = 0.0;
};

/// Changes anything anywhere.
Made change_at_random(WorkingSurface& surface, std::uint64_t seed, int times, double spacing) {
  Random random(seed);
  Made made;
  for (int n = 0; n < times; ++n) {
    Edge e = WorkingSurface::no_edge;
    do e = static_cast<Edge>(random.uniform(0, static_cast<double>(surface.edges())));
    while (!surface.alive(e));
    const double what = random.uniform(0, 1);
    SurfaceChange change;
    if (what < 0.1) {
      change = surface.split(e);
      made.split += change.done();
    } else if (what < 0.5) {
      change = surface.flip(e, spacing);
      made.flipped += change.done();
    } else {
      change = surface.collapse(e, spacing);
      made.collapsed += change.done();
    }
    made.volume += change.volume;
    if (!change.done()) ++made.refused[change.refusal];
  }
  return made;
}

struct Body {
  SpaceShape shape;
  int characteristic;
};

TEST(WorkingSurface, keeps_its_genus_and_books_the_volume_under_random_changes) {
  for (const auto& [shape, characteristic] :
       {Body{SpaceShape::cube, 2}, Body{SpaceShape::torus, 0}, Body{SpaceShape::two_holes, -2},
        Body{SpaceShape::shell, 4}, Body{SpaceShape::slit, 2}}) {
    const Cloud<3> cloud = testing::unrecovered({.shape = shape, .cells = 6, .jitter = 0.2, .seed = 3});
    WorkingSurface surface = surface_of(cloud);
    ASSERT_EQ(euler_characteristic(cloud), characteristic) << name_of(shape);
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      const double before = enclosed_measure(cloud_of(surface, cloud));
      const Made made = change_at_random(surface, seed, 5000, 1.0 / 6);
      const Cloud<3> changed = cloud_of(surface, cloud);
      voronoi::surface_edges(changed); // throws unless it is closed and without branches
      EXPECT_EQ(euler_characteristic(changed), characteristic) << name_of(shape);
      EXPECT_NEAR(enclosed_measure(changed) - before, made.volume, 1e-13) << name_of(shape);
      EXPECT_TRUE(voronoi::crossings(changed).empty()) << name_of(shape);
      EXPECT_GT(std::min({made.split, made.collapsed, made.flipped}), 150) << name_of(shape);
      for (const Refusal reason : {Refusal::link, Refusal::normals, Refusal::corner, Refusal::crease})
        EXPECT_GT(made.refused.at(reason), 0) << name_of(shape) << ": " << static_cast<int>(reason);
    }
  }
}

TEST(WorkingSurface, tells_facets_that_are_not_where_they_were) {
  const Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::torus, .cells = 6, .jitter = 0.2});
  WorkingSurface surface = surface_of(cloud);
  EXPECT_TRUE(surface.changed_facets(cloud).empty());
  change_at_random(surface, 5, 30, 1.0 / 6);
  const auto changed = surface.changed_facets(cloud);
  const auto places = [](const Facet<3>& facet, const IndexedVector<NodeIndex, Vec3>& position) {
    std::array<std::array<double, 3>, 3> x{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c) x[k][c] = position[facet.node[k]][static_cast<Eigen::Index>(c)];
    std::rotate(x.begin(), std::min_element(x.begin(), x.end()), x.end());
    return x;
  };
  std::set<std::array<std::array<double, 3>, 3>> before;
  for (const Facet<3>& facet : cloud.facets) before.insert(places(facet, cloud.position));
  std::vector<CloudFacetIndex> expected;
  const auto now = surface.facets();
  for (const CloudFacetIndex f : now.indices())
    if (!before.contains(places(now[f], surface.position()))) expected.push_back(f);
  EXPECT_EQ(changed, expected);
  EXPECT_GT(changed.size(), 20U);
  EXPECT_LT(changed.size(), now.size() / 2);
}

TEST(WorkingSurface, leaves_faces_creases_and_corners_of_a_cube_to_the_bit) {
  const Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = 6, .jitter = 0.3});
  WorkingSurface surface = surface_of(cloud);
  change_at_random(surface, 7, 10000, 1.0 / 6);
  const Cloud<3> changed = cloud_of(surface, cloud);
  int corners = 0;
  for (const NodeIndex i : changed.position.indices()) corners += surface.on_surface(i) && surface.corner(i);
  EXPECT_EQ(corners, 8);
  for (const auto& facet : changed.facets) {
    const std::string& plane = changed.piece_names[facet.piece]; // "x+6", "y-0", …
    for (const NodeIndex i : facet.node)
      EXPECT_EQ(changed.position[i][plane[0] - 'x'], plane[1] == '+' ? 1.0 : 0.0);
  }
  EXPECT_NEAR(enclosed_measure(changed), 1.0, 1e-14);
}

/// A slab with a narrow chamfer at one of its vertical edges, all of one piece but, if asked, its upper side.
/// At the upper side the chamfer is the edge from node 7 to node 8.
Cloud<3> chamfered_slab(double chamfer, bool lid) {
  Cloud<3> cloud;
  const std::array<Vec2, 5> outline{Vec2(0, 0), {1, 0}, {1, 1 - chamfer}, {1 - chamfer, 1}, {0, 1}};
  for (const double z : {0.0, 0.4})
    for (const Vec2& x : outline) cloud.position.emplace_back(x.x(), x.y(), z);
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c, PieceIndex piece) {
    const auto node = [](std::size_t k) { return as<NodeIndex>(k); };
    cloud.facets.push_back({{node(a), node(b), node(c)}, piece});
  };
  cloud.piece_names = {"side", "lid"};
  for (std::size_t k = 1; k < 4; ++k) {
    add(0, k + 1, k, as<PieceIndex>(0));
    add(5, 5 + k, 6 + k, as<PieceIndex>(lid ? 1 : 0));
  }
  for (std::size_t k = 0; k < 5; ++k) {
    const std::size_t next = (k + 1) % 5;
    add(k, next, 5 + next, as<PieceIndex>(0));
    add(k, 5 + next, 5 + k, as<PieceIndex>(0));
  }
  return cloud;
}

// Where folds met at two corners, a fortieth of the spacing apart, both stayed and the step fell to a sixth.
TEST(WorkingSurface, joins_corners_of_folds_that_have_come_together) {
  const auto refusal = [](double chamfer, bool lid) {
    WorkingSurface surface = surface_of(chamfered_slab(chamfer, lid));
    const auto a = as<NodeIndex>(7), b = as<NodeIndex>(8);
    EXPECT_TRUE(surface.corner(a) && surface.corner(b));
    const double before = enclosed_measure(cloud_of(surface, chamfered_slab(chamfer, lid)));
    const SurfaceChange change = surface.collapse(surface.between(a, b), 0.1);
    const Cloud<3> changed = cloud_of(surface, chamfered_slab(chamfer, lid));
    voronoi::surface_edges(changed);
    EXPECT_NEAR(enclosed_measure(changed) - before, change.volume, 1e-15);
    EXPECT_EQ(surface.on_surface(a), !change.done());
    return change.refusal;
  };
  EXPECT_EQ(refusal(0.0001, false), Refusal::none);
  EXPECT_EQ(refusal(0.008, false), Refusal::corner) << "0.11 spacings apart";
  EXPECT_EQ(refusal(0.0001, true), Refusal::corner) << "a piece ends there";

  WorkingSurface surface = surface_of(chamfered_slab(0.2, false));
  const auto corner = as<NodeIndex>(5), other = as<NodeIndex>(6);
  const Edge e = surface.between(corner, other);
  const NodeIndex beside = surface.split(e, surface.at(corner) + Vec3(0.005, 0, 0)).made;
  EXPECT_EQ(surface.collapse(surface.between(corner, beside), 0.1).refusal, Refusal::corner)
      << "a node of its own crease is no fold that it has met";
}

TEST(WorkingSurface, joins_creases_of_folds_that_have_come_together) {
  for (const auto& [chamfer, refusal] : {std::pair{0.0002, Refusal::none}, {0.008, Refusal::crease}}) {
    WorkingSurface surface = surface_of(chamfered_slab(chamfer, false));
    const auto node = [](std::size_t k) { return as<NodeIndex>(k); };
    const NodeIndex a = surface.split(surface.between(node(2), node(7))).made,
                    b = surface.split(surface.between(node(3), node(8))).made;
    ASSERT_TRUE(surface.flip(surface.between(node(2), node(8)), 0.1).done()); // now a and b are neighbours
    ASSERT_TRUE(surface.on_crease(a) && surface.on_crease(b) && !surface.crease(surface.between(a, b)));
    EXPECT_EQ(surface.collapse(surface.between(a, b), 0.1).refusal, refusal) << chamfer;
  }
}

TEST(WorkingSurface, leaves_held_nodes_and_closed_slits_alone) {
  const Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::slit, .cells = 6, .jitter = 0.2});
  IndexedVector<NodeIndex, char> held(cloud.position.size(), 0);
  for (std::size_t i = 0; i < held.size(); i += 5) held[i] = 1;
  WorkingSurface surface(cloud, held);
  change_at_random(surface, 11, 5000, 1.0 / 6);
  const auto behind = voronoi::facets_behind(cloud);
  for (const CloudFacetIndex f : behind.indices())
    if (exists(behind[f]))
      for (const NodeIndex i : cloud.facets[f].node) held[i] = 1;
  for (const NodeIndex i : held.indices()) {
    if (!held[i]) continue;
    EXPECT_EQ(surface.at(i), cloud.position[i]);
  }
  const Cloud<3> changed = cloud_of(surface, cloud);
  const auto pairs = voronoi::facets_behind(changed);
  const auto count = [](const auto& list) {
    return std::count_if(list.begin(), list.end(), [](auto f) { return exists(f); });
  };
  EXPECT_GT(count(behind), 20);
  EXPECT_EQ(count(pairs), count(behind));
}

// Held nodes keep the surface between them; on a plane either diagonal is as good.
TEST(WorkingSurface, turns_no_edge_between_held_nodes_off_a_plane) {
  const auto flips = [](SpaceShape shape, char hold) {
    const Cloud<3> cloud = testing::unrecovered({.shape = shape, .cells = 6, .jitter = 0.2});
    WorkingSurface surface(cloud, IndexedVector<NodeIndex, char>(cloud.position.size(), hold));
    int done = 0;
    for (Edge e = 0; e < surface.edges(); ++e) done += surface.flip(e, 1.0 / 6).done();
    return done;
  };
  EXPECT_GT(flips(SpaceShape::shell, 0), 10);
  EXPECT_EQ(flips(SpaceShape::shell, 1), 0);
  EXPECT_GT(flips(SpaceShape::cube, 1), 10);
}

// A node that splits an edge between held nodes may go into another of them, which turns the edge.
TEST(WorkingSurface, keeps_its_shape_between_held_nodes_that_hold_new_ones) {
  const Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::shell, .cells = 6, .jitter = 0.2});
  const IndexedVector<NodeIndex, char> all(cloud.position.size(), 1);
  for (const bool hold : {false, true}) {
    WorkingSurface surface(cloud, all);
    if (hold) surface.hold_between(all);
    const Made made = change_at_random(surface, 7, 5000, 1.0 / 6);
    EXPECT_GT(made.split, 100);
    const double change = enclosed_measure(cloud_of(surface, cloud)) - enclosed_measure(cloud);
    if (hold)
      EXPECT_NEAR(change, 0.0, 1e-9);
    else
      EXPECT_GT(std::abs(change), 1e-6);
  }
}

// Metal between facets that lie back to back turns inside out before a pass comes, and then they cross.
TEST(WorkingSurface, takes_away_films_whose_sides_cross) {
  const auto flip = [](double thick, const Vec2& at_d, Flip kind) {
    const Cloud<3> cloud = testing::film(thick, at_d);
    WorkingSurface surface = surface_of(cloud);
    const Edge e = surface.between(as<NodeIndex>(0), as<NodeIndex>(1));
    const SurfaceChange change = surface.flip(e, 1.0, kind);
    const Cloud<3> changed = cloud_of(surface, cloud);
    voronoi::surface_edges(changed);
    EXPECT_NEAR(enclosed_measure(changed) - enclosed_measure(cloud), change.volume, 1e-15);
    if (change.done()) {
      EXPECT_NEAR(change.volume, -thick / 3.0, 1e-15);
      EXPECT_TRUE(voronoi::crossings(changed).empty());
    }
    return change.refusal;
  };
  const Vec2 beside(0, 1);
  EXPECT_TRUE(voronoi::crossings(testing::film(0.02, beside)).empty());
  EXPECT_FALSE(voronoi::crossings(testing::film(-0.02, beside)).empty());
  EXPECT_EQ(flip(0.02, beside, Flip::of_film), Refusal::none);
  EXPECT_EQ(flip(0.02, beside, Flip::in_shape), Refusal::crease);
  EXPECT_EQ(flip(0.2, beside, Flip::of_film), Refusal::volume);
  EXPECT_EQ(flip(-0.02, beside, Flip::of_film), Refusal::crease) << "it has turned inside out";
  EXPECT_EQ(flip(0.02, {0.5, 0.3}, Flip::of_film), Refusal::crease) << "no side passes above another one";
}

TEST(WorkingSurface, gives_back_volume_where_nodes_may_move) {
  const Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::torus, .cells = 10, .jitter = 0.1});
  WorkingSurface surface = surface_of(cloud);
  const double before = enclosed_measure(cloud);
  int moved = 0;
  for (const NodeIndex i : cloud.position.indices()) moved += surface.swell(i, 1e-9, 0.01);
  EXPECT_GT(moved, 100);
  EXPECT_NEAR(enclosed_measure(cloud_of(surface, cloud)) - before, 1e-9 * moved, 1e-13);
}

// Symmetry planes meet in a line, and what is between them and a bent face moves with the face.
TEST(WorkingSurface, corners_beside_a_bent_face_slide_along_the_line_of_two_planes) {
  Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = 6, .jitter = 0.2});
  for (Vec3& x : cloud.position) x.x() *= 1.2 - 0.1 * (x.y() * x.y() + x.z() * x.z());
  WorkingSurface surface = surface_of(cloud);
  const double before = enclosed_measure(cloud);
  int corners = 0, moved = 0;
  for (const NodeIndex i : cloud.position.indices()) {
    if (!surface.on_surface(i) || !surface.corner(i)) continue;
    ++corners;
    if (!surface.swell(i, 1e-5, 0.05)) {
      EXPECT_EQ(surface.at(i), cloud.position[i]);
      continue;
    }
    ++moved;
    EXPECT_GT(surface.at(i).x(), cloud.position[i].x() + 1e-4);
    EXPECT_EQ(surface.at(i).y(), cloud.position[i].y());
    EXPECT_EQ(surface.at(i).z(), cloud.position[i].z());
  }
  EXPECT_EQ(corners, 8);
  EXPECT_EQ(moved, 4);
  EXPECT_NEAR(enclosed_measure(cloud_of(surface, cloud)) - before, 4e-5, 1e-12);
}

} // namespace
} // namespace cnem::adapt
