// Cells in space: they close and fill the body wherever the dual points are, and are the Voronoi cells where
// nothing hides these.
#include "core/error.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/voronoi_cells.hpp"
#include "voronoi/space/walk.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace cnem::testing {
namespace {

using namespace voronoi;

struct Body {
  Cloud<3> cloud;
  Tetrahedra mesh;
  Circumspheres spheres;
  VoronoiCells cells;

  explicit Body(const SpaceCloud& how) {
    RecoveredBoundary made = recovered(how);
    cloud = std::move(made.cloud);
    mesh = std::move(made.tetrahedra);
    spheres = circumspheres(cloud, mesh);
    cells = voronoi_cells(cloud, mesh, spheres);
  }
};

std::vector<SpaceCloud> bodies() {
  std::vector<SpaceCloud> list;
  for (const SpaceShape shape : space_shapes)
    for (const double jitter : {0.0, 0.4}) list.push_back({.shape = shape, .cells = 4, .jitter = jitter});
  list.push_back({.shape = SpaceShape::cube, .cells = 4, .turned = true});
  list.push_back({.shape = SpaceShape::cube, .cells = 5, .jitter = 0.3, .shear = 2.0});
  list.push_back({.shape = SpaceShape::shell, .cells = 4, .jitter = 0.3, .shear = 0.5});
  return list;
}

template<class Check> void on_all_bodies(Check&& check) {
  for (const SpaceCloud& how : bodies()) {
    SCOPED_TRACE(std::string(name_of(how.shape)) + " jitter " + std::to_string(how.jitter) + " shear " +
                 std::to_string(how.shear));
    check(Body(how));
  }
}

Field quarters(const Body& body) {
  Field volume(body.cloud.position.size(), 0.0);
  for (const SimplexIndex t : body.mesh.node.indices())
    for (const NodeIndex i : body.mesh.node[t])
      volume[index_of(i)] += 0.25 * measure<3>(corners_of(body.cloud, body.mesh, t));
  return volume;
}

TEST(SpaceCells, close_and_fill_the_body_and_none_is_small) {
  on_all_bodies([](const Body& body) {
    EXPECT_TRUE(is_closed<3>(body.cloud, cell_complex(body.cloud, body.mesh, body.cells)));
    const Field& volume = body.cells.volume;
    const double sum = std::accumulate(volume.begin(), volume.end(), 0.0);
    EXPECT_NEAR(sum / enclosed_measure(body.cloud), 1.0, 1e-12);
    const Field median = quarters(body);
    for (std::size_t i = 0; i < volume.size(); ++i) EXPECT_GE(volume[i], 0.15 * median[i]);
  });
}

/// Circumcentres of tetrahedra that are anything but Delaunay: cells close as well.
TEST(SpaceCells, close_on_any_tetrahedra) {
  Body body({.shape = SpaceShape::cube, .cells = 4, .jitter = 0.2});
  const auto turn = [](Vec3& x) {
    const double a = 2.0 * x.z();
    x = Vec3(std::cos(a) * x.x() - std::sin(a) * x.y(), std::sin(a) * x.x() + std::cos(a) * x.y(), x.z());
    x.x() += 1.5 * x.y();
  };
  for (Vec3& x : body.cloud.position) turn(x);
  const auto cells = voronoi_cells(body.cloud, body.mesh, circumspheres(body.cloud, body.mesh));
  EXPECT_TRUE(is_closed<3>(body.cloud, cell_complex(body.cloud, body.mesh, cells)));
  for (const double v : cells.volume) EXPECT_GT(v, 0.0);
}

/// But for the layer on the boundary, where the points of facets are their centroids.
TEST(SpaceCells, inside_a_lattice_are_its_boxes) {
  const int n = 4;
  const Body body({.shape = SpaceShape::cube, .cells = n});
  const double h = 1.0 / n;
  std::vector<char> inside(body.cloud.position.size(), 1);
  for (const Facet<3>& f : body.cloud.facets)
    for (const NodeIndex i : f.node) inside[index_of(i)] = 0;
  EXPECT_EQ(std::count(inside.begin(), inside.end(), 1), (n - 1) * (n - 1) * (n - 1));
  for (const NodeIndex i : body.cloud.position.indices())
    if (inside[index_of(i)]) { EXPECT_NEAR(body.cells.volume[index_of(i)], h * h * h, 1e-15); }
  for (const EdgeIndex e : body.cells.rings.end.indices()) {
    const auto& [i, j] = body.cells.rings.end[e];
    if (!inside[index_of(i)] && !inside[index_of(j)]) continue;
    const Vec3 d = body.cloud.position[j] - body.cloud.position[i];
    const bool along_axis = d.lpNorm<1>() < 1.01 * h;
    const Vec3 normal = facet_normal(body.cloud, body.cells, e);
    if (!along_axis) { EXPECT_LT(normal.norm(), 1e-15); }
    if (along_axis) { EXPECT_GT(normal.dot(d), 0.999 * h * h * h); }
  }
}

/// What a point of a cell is nearest to is its node, where no wall hides anything.
TEST(SpaceCells, facets_of_a_convex_body_stand_halfway_between_their_nodes) {
  const Body body({.shape = SpaceShape::cube, .cells = 5, .jitter = 0.3});
  std::vector<Vec3> polygon;
  std::size_t inner = 0;
  for (const EdgeIndex e : body.cells.rings.end.indices()) {
    const auto ring = body.cells.rings.of(e);
    const bool plain = std::all_of(ring.begin(), ring.end(), [&](DualPointIndex p) {
      const auto t = as<SimplexIndex>(index_of(p));
      return index_of(p) < body.mesh.node.size() && body.cells.points.place[p] == body.spheres.centre[t];
    });
    if (!plain) continue;
    ++inner;
    const auto& [i, j] = body.cells.rings.end[e];
    const Vec3 &a = body.cloud.position[i], &b = body.cloud.position[j];
    facet_polygon(body.cloud, body.cells, e, polygon);
    for (const Vec3& x : polygon) EXPECT_NEAR((x - a).norm(), (x - b).norm(), 1e-10);
    const Vec3 normal = facet_normal(body.cloud, body.cells, e);
    EXPECT_LT(normal.cross(b - a).norm(), 1e-12);
    EXPECT_GE(normal.dot(b - a), -1e-14);
  }
  EXPECT_GT(inner, body.cells.rings.end.size() / 4);
}

TEST(SpaceCells, dual_points_lie_where_it_is_recorded) {
  std::size_t hidden = 0;
  on_all_bodies([&](const Body& body) {
    for (const SimplexIndex t : body.mesh.node.indices()) {
      const Vec3& x = body.cells.points.place[dual_point_of(t)];
      const auto corner = corners_of(body.cloud, body.mesh, body.cells.points.holder[t]);
      const auto normal = face_normals(corner);
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_LE(normal[k].normalized().dot(x - corner[(k + 1) % 4]), 1e-10);
      const SpaceWalkEnd way = walk(body.cloud, body.mesh, t, body.spheres.centre[t]);
      if (!exists(way.facet) || x != way.place) continue; // none hides the circumcentre, or drawn in
      ++hidden;
      const auto on = corners_of<3>(body.cloud.facets[way.facet], body.cloud.position);
      EXPECT_LT(std::abs(area_normal<3>(on).normalized().dot(x - on[0])), 1e-12);
    }
  });
  EXPECT_GT(hidden, 0U);
}

TEST(SpaceCells, rings_go_round_their_edges) {
  on_all_bodies([](const Body& body) {
    const auto& rings = body.cells.rings;
    std::size_t passed = 0, open = 0;
    for (const EdgeIndex e : rings.end.indices()) {
      const auto ring = rings.of(e);
      const auto& [i, j] = rings.end[e];
      EXPECT_LT(i, j);
      EXPECT_GE(ring.size(), 3U);
      const bool is_open = index_of(ring.front()) >= body.mesh.node.size();
      EXPECT_EQ(is_open, index_of(ring.back()) >= body.mesh.node.size());
      open += is_open ? 1 : 0;
      for (std::size_t k = 0; k < ring.size(); ++k) {
        if (index_of(ring[k]) >= body.mesh.node.size()) continue;
        ++passed;
        const auto& node = body.mesh.node[index_of(ring[k])];
        EXPECT_NE(std::find(node.begin(), node.end(), i), node.end());
        EXPECT_NE(std::find(node.begin(), node.end(), j), node.end());
        const DualPointIndex next = ring[(k + 1) % ring.size()];
        if (index_of(next) >= body.mesh.node.size()) continue;
        const auto& beside = body.mesh.neighbour[index_of(ring[k])];
        EXPECT_NE(std::find(beside.begin(), beside.end(), as<SimplexIndex>(index_of(next))), beside.end());
      }
    }
    EXPECT_EQ(passed, 6 * body.mesh.node.size());
    EXPECT_EQ(2 * open, 3 * body.cloud.facets.size()); // edges of a closed surface
  });
}

TEST(SpaceCells, of_nodes_across_a_slit_are_no_neighbours) {
  const Body body({.shape = SpaceShape::slit, .cells = 6, .jitter = 0.3});
  ASSERT_FALSE(body.cloud.twins.empty());
  const auto cells = neighbours(body.cloud.position.size(), body.cells.rings);
  std::size_t pairs = 0;
  for (const auto& [a, b] : body.cloud.twins) {
    const auto of_a = cells.of(a);
    EXPECT_EQ(std::find(of_a.begin(), of_a.end(), b), of_a.end());
    ++pairs;
  }
  EXPECT_GT(pairs, 4U);
}

TEST(SpaceCells, refuse_nodes_without_volume) {
  Body body({.shape = SpaceShape::cube, .cells = 2});
  for (Vec3& x : body.cloud.position) x.z() = 0.0;
  EXPECT_THROW(voronoi_cells(body.cloud, body.mesh, circumspheres(body.cloud, body.mesh)), GeometryError);
}

} // namespace
} // namespace cnem::testing
