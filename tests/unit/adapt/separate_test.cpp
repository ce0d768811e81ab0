// Bodies in space that part along the least surface through broken matter.
#include "adapt/space/separate.hpp"
#include "clouds/tetrahedral_block.hpp"
#include "core/geometry/facets.hpp"
#include "core/operators/resampling.hpp"
#include "voronoi/space/recovery.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <numeric>
#include <set>

namespace cnem::adapt {
namespace {

/// Nodes are broken where `broken` is 1 or more.
struct PartingBody {
  clouds::TetrahedralBlock block;
  SpaceStructure structure;
  WorkingBody body;

  PartingBody(
      const Vec3& size, const std::array<int, 3>& count, const std::function<double(const Vec3&)>& broken,
      const std::function<Vec3(const Vec3&)>& place = [](const Vec3& x) { return x; })
      : block(clouds::tetrahedral_block(size, count, place)),
        structure(structure_of(block.cloud, voronoi::connected(block.cloud, block.tetrahedra))),
        body(block.cloud, properties(broken)) {}

  NodeProperties properties(const std::function<double(const Vec3&)>& broken) const {
    const std::size_t n = block.cloud.position.size();
    NodeProperties p{structure.cell,
                     Field(n, 1.0),
                     Field(n, 1.0),
                     Field(n, 0.1),
                     IndexedVector<NodeIndex, char>(n, 0),
                     {}};
    for (const Vec3& x : block.cloud.position) p.broken.push_back(broken(x));
    return p;
  }
};

/// Connected components of a surface, each edge of which has to have two facets that run either way.
int closed_components(const Cloud<3>& cloud) {
  std::map<std::pair<NodeIndex, NodeIndex>, int> edges;
  std::vector<std::size_t> parent(cloud.position.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](NodeIndex i) {
    std::size_t r = index_of(i);
    while (parent[r] != r) r = parent[r];
    return r;
  };
  std::set<NodeIndex> nodes;
  for (const Facet<3>& facet : cloud.facets)
    for (std::size_t k = 0; k < 3; ++k) {
      ++edges[{facet.node[k], facet.node[(k + 1) % 3]}];
      parent[root(facet.node[k])] = root(facet.node[(k + 1) % 3]);
      nodes.insert(facet.node[k]);
    }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
  std::set<std::size_t> roots;
  for (const NodeIndex i : nodes) roots.insert(root(i));
  return static_cast<int>(roots.size());
}

constexpr PieceIndex faces{9};

TEST(Separate, bar_with_a_broken_layer_parts_at_its_most_strained_surface) {
  // broken in the middle third, most at x = 0.6
  PartingBody bar({1, 0.4, 0.4}, {10, 4, 4}, [](const Vec3& x) {
    return std::abs(x.x() - 0.5) < 0.15 ? 1.0 + 5.0 * (std::abs(x.x() - 0.6) < 1e-9) : 0.5;
  });
  PassReport report;
  const Field mass = bar.body.node().mass;
  separate(bar.body, bar.structure, {.piece = faces}, report);
  const Cloud<3>& cloud = bar.body.cloud();
  EXPECT_EQ(report.cuts, 1);
  EXPECT_EQ(report.opened, 2 * 4 * 4);
  EXPECT_EQ(bar.body.size(), 11U * 25U + 25U);
  EXPECT_EQ(closed_components(cloud), 2);
  double total = 0.0, area = 0.0;
  for (const double m : bar.body.node().mass) total += m;
  EXPECT_NEAR(total, 0.16, 1e-15);
  double before = 0.0; // the cut
  for (const NodeIndex i : bar.body.nodes())
    before += cloud.position[i].x() < 0.6 ? bar.body.node().mass[index_of(i)] : 0.0;
  EXPECT_NEAR(before, 0.6 * 0.16, 1e-14) << "doubles share matter by the volumes on their sides";
  for (const Facet<3>& facet : cloud.facets)
    if (facet.piece == faces) {
      for (const NodeIndex i : facet.node) {
        EXPECT_NEAR(std::abs(cloud.position[i].x() - 0.6), 0.5e-3 * 0.1, 1e-12);
        const double y = cloud.position[i].y();
        EXPECT_TRUE(y >= 0.0 && y <= 0.4) << "doubles stay on the faces they were on";
      }
      area += area_normal<3>(corners_of<3>(facet, cloud.position)).norm();
    }
  EXPECT_NEAR(area, 2 * 0.16, 1e-12);
  EXPECT_NO_THROW(voronoi::recover_boundary(cloud));
}

TEST(Separate, round_slug_leaves_a_sheet) {
  const auto band = [](const Vec3& x) { return std::abs(std::hypot(x.x(), x.y()) - 0.5) < 0.13 ? 1.5 : 0.0; };
  PartingBody sheet({1, 1, 0.3}, {12, 12, 4}, band);
  PassReport report;
  separate(sheet.body, sheet.structure, {.piece = faces}, report);
  EXPECT_EQ(report.cuts, 1);
  EXPECT_EQ(closed_components(sheet.body.cloud()), 2);
  const double sum = std::accumulate(sheet.body.node().mass.begin(), sheet.body.node().mass.end(), 0.0);
  EXPECT_NEAR(sum, 0.3, 1e-13);
  for (const NodeIndex i : sheet.block.cloud.position.indices()) // no vertex is doubled away from the band
    if (band(sheet.block.cloud.position[i]) == 0.0) {
      EXPECT_EQ(sheet.body.at(i), sheet.block.cloud.position[i]);
    }
}

// Each square of the top is plane, as the halves of a facet are that a pass has split, but not the top. The
// cut has a step, at which one double has three squares.
TEST(Separate, faces_stand_apart_where_they_meet_a_rough_surface) {
  const auto step = [](const Vec3& x) {
    const long i = std::lround(10.0 * x.x()), j = std::lround(10.0 * x.y());
    return (i == 5 && j <= 5) || (i == 6 && j >= 5) ? 1.5 : 0.0;
  };
  PartingBody sheet({1, 1, 0.3}, {10, 10, 3}, step, [](const Vec3& x) {
    const long i = std::lround(10.0 * x.x()), j = std::lround(10.0 * x.y());
    const double rough = 0.02 * static_cast<double>(i % 2) + 0.03 * static_cast<double>(j % 2);
    return Vec3(x.x(), x.y(), x.z() * (1.0 + rough));
  });
  PassReport report;
  const Cloud<3>& cloud = sheet.body.cloud();
  const std::size_t before = cloud.position.size();
  separate(sheet.body, sheet.structure, {.piece = faces}, report);
  EXPECT_EQ(report.cuts, 1);
  ASSERT_GT(cloud.position.size(), before);
  for (std::size_t i = before; i < cloud.position.size(); ++i) {
    double nearest = 1.0;
    for (const NodeIndex k : cloud.position.indices())
      if (index_of(k) != i)
        nearest = std::min(nearest, (cloud.position[k] - cloud.position[as<NodeIndex>(i)]).norm());
    EXPECT_GT(nearest, 0.8e-4) << "gaps are 1e-4 wide, both sides have gone";
  }
  for (const Facet<3>& facet :
       sheet.block.cloud.facets) { // a cut is smoothed along the surface, not out of it
    const auto x = corners_of<3>(facet, sheet.block.cloud.position);
    for (const NodeIndex i : facet.node)
      EXPECT_LT(std::abs(area_normal<3>(x).normalized().dot(cloud.position[i] - x[0])), 0.011 * 0.1);
  }
  EXPECT_NO_THROW(voronoi::recover_boundary(cloud));
}

TEST(Separate, nothing_parts_where_a_ligament_is_whole_or_the_part_would_be_a_chip) {
  PartingBody ligament({1, 0.4, 0.4}, {10, 4, 4}, [](const Vec3& x) {
    return std::abs(x.x() - 0.5) < 0.15 && x.y() < 0.35 ? 2.0 : 0.0;
  });
  PassReport report;
  separate(ligament.body, ligament.structure, {.piece = faces}, report);
  EXPECT_EQ(report.cuts, 0);
  EXPECT_EQ(ligament.body.size(), 11U * 25U);
  // 25 nodes beyond the broken layer at the end
  PartingBody chip({1, 0.4, 0.4}, {10, 4, 4},
                   [](const Vec3& x) { return x.x() > 0.85 && x.x() < 0.95 ? 2.0 : 0.0; });
  EXPECT_TRUE(parts_between(chip.block.cloud, chip.structure.mesh, chip.body.node().broken, 51).empty());
  EXPECT_FALSE(parts_between(chip.block.cloud, chip.structure.mesh, chip.body.node().broken, 50).empty());
}

TEST(Separate, two_bands_leave_three_parts) {
  PartingBody bar({2, 0.3, 0.3}, {20, 3, 3}, [](const Vec3& x) {
    return std::abs(x.x() - 0.5) < 0.06 || std::abs(x.x() - 1.5) < 0.06 ? 1.2 : 0.0;
  });
  PassReport report;
  separate(bar.body, bar.structure, {.piece = faces}, report);
  EXPECT_EQ(report.cuts, 2);
  EXPECT_EQ(closed_components(bar.body.cloud()), 3);
}

TEST(Separate, a_cut_across_the_edges_of_tetrahedra_is_smooth) {
  PartingBody bar({1, 0.5, 0.5}, {20, 10, 10},
                  [](const Vec3& x) { return std::abs(x.x() - 0.35 - 0.6 * x.y()) < 0.1 ? 1.0 : 0.0; });
  PassReport report;
  const double volume = enclosed_measure(bar.block.cloud);
  separate(bar.body, bar.structure, {.piece = faces}, report);
  ASSERT_EQ(report.cuts, 1);
  const Cloud<3>& cloud = bar.body.cloud();
  double area = 0.0, tilt = 0.0; // ∫ (n · n of the plane)² over one of the two faces
  const Vec3 plane = Vec3(1, -0.6, 0).normalized();
  for (const Facet<3>& facet : cloud.facets) {
    if (facet.piece != faces) continue;
    const Vec3 n = area_normal<3>(corners_of<3>(facet, cloud.position));
    area += n.norm();
    tilt += n.dot(plane) * n.dot(plane) / n.norm();
  }
  EXPECT_GT(tilt, 0.9 * area) << "faces of tetrahedra as they were: 0.86";
  EXPECT_NEAR(enclosed_measure(cloud), volume, 1e-3 * volume);
  for (const Facet<3>& facet : cloud.facets) // nodes of the cut stay on the planes of the bar
    if (facet.piece != faces) {
      const Vec3 n = area_normal<3>(corners_of<3>(facet, cloud.position)).normalized();
      EXPECT_NEAR(n.cwiseAbs().maxCoeff(), 1.0, 1e-14);
    }
}

TEST(Separate, random_broken_matter_leaves_closed_surfaces) {
  int cuts = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    unsigned state = 747796405U * (seed + 1);
    const auto random = [&] {
      state = state * 1664525U + 1013904223U;
      return (state >> 8) / 16777216.0;
    };
    PartingBody bar({1, 0.5, 0.5}, {10, 5, 5}, [&](const Vec3& x) {
      return std::abs(x.x() - 0.5 - 0.1 * std::sin(9.0 * x.y())) < 0.18
                 ? (random() < 0.93 ? 1.0 + random() : 0.0)
                 : 0.0;
    });
    PassReport report;
    const double volume = enclosed_measure(bar.block.cloud);
    separate(bar.body, bar.structure, {.piece = faces}, report);
    EXPECT_EQ(closed_components(bar.body.cloud()), 1 + report.cuts);
    EXPECT_NEAR(enclosed_measure(bar.body.cloud()), volume, 1e-3 * volume);
    for (const double m : bar.body.node().mass) EXPECT_GT(m, 0.0);
    cuts += report.cuts;
  }
  EXPECT_GT(cuts, 10);
}

} // namespace
} // namespace cnem::adapt
