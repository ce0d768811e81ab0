// The surface keeps its resolution: of short edges no more nodes go than have to, and edges run out of thin
// metal.
#include "adapt/space/refine_surface.hpp"
#include "adapt/space/sharp_creases.hpp"
#include "tests/space_clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cnem::adapt {
namespace {

using testing::SpaceShape;

WorkingSurface loose_surface_of(const Cloud<3>& cloud) {
  return WorkingSurface(cloud, IndexedVector<NodeIndex, char>(cloud.position.size(), 0));
}

/// Matter of nodes that have a cell.
Field enough(const Field& size) {
  Field matter;
  for (const double h : size) matter.push_back(0.1 * h * h * h);
  return matter;
}

// Edges of 0.42 h become edges of 0.83 h, a few of three lengths, not all of as many as go below the limit
// for splits: that would be 4 on each edge of the cube.
TEST(RefineSurface, of_a_row_of_short_edges_every_second_node_goes) {
  const Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = 12});
  WorkingSurface surface = loose_surface_of(cloud);
  Field size(cloud.position.size(), 0.2);
  PassReport report;
  refine_surface(surface, size, enough(size), {}, report, PeriodImages(cloud, {}));
  int edges = 0;
  double longest = 0.0;
  for (WorkingSurface::Edge e = 0; e < surface.edges(); ++e) {
    if (!surface.alive(e) || !surface.crease(e) || surface.across(e) < e) continue;
    ++edges;
    longest = std::max(longest, surface.length(e));
  }
  EXPECT_GT(edges, 12 * 5.5);
  EXPECT_LT(longest, 1.3 * 0.2);
}

// A cube that is sheared by 4 has two edges of 14 degrees, 1/sin α = √17.
TEST(RefineSurface, spacing_is_wider_where_metal_runs_out) {
  constexpr double h = 0.1, widest = 4.0;
  Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = 10});
  const Field wanted(cloud.position.size(), h);
  EXPECT_EQ(spacing_at_sharp_creases(loose_surface_of(cloud), wanted), wanted);
  Cloud<3> leaning = cloud; // by γ = 1: 45 degrees
  for (Vec3& x : cloud.position) x.x() += 4.0 * x.y();
  for (Vec3& x : leaning.position) x.x() += x.y();
  const Field spacing = spacing_at_sharp_creases(loose_surface_of(cloud), wanted);
  const Field wider = spacing_at_sharp_creases(loose_surface_of(leaning), wanted);
  for (const NodeIndex i : cloud.position.indices()) {
    const Vec3& x = cloud.position[i];
    const double sharp = std::min(std::hypot(x.x(), x.y()), std::hypot(x.x() - 5.0, x.y() - 1.0));
    const double now = spacing[index_of(i)];
    EXPECT_GE(now, h);
    if (sharp < 1e-9) {
      EXPECT_DOUBLE_EQ(now, widest * h);
      EXPECT_NEAR(wider[index_of(i)], std::sqrt(2.0) * h, 1e-12);
    }
    EXPECT_LE(now, std::max(h, widest * h - 0.5 * sharp) + 1e-12);
  }
}

// An edge that is a crease all alone would allow itself to be the longer the longer it is.
TEST(RefineSurface, spacing_is_no_wider_at_a_single_sharp_edge) {
  for (const int cells : {1, 2}) {
    Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = cells});
    for (Vec3& x : cloud.position) x.x() += 4.0 * x.y();
    const Field wanted(cloud.position.size(), 0.1),
        spacing = spacing_at_sharp_creases(loose_surface_of(cloud), wanted);
    EXPECT_DOUBLE_EQ(*std::max_element(spacing.begin(), spacing.end()), cells == 1 ? 0.1 : 0.4);
  }
}

/// A cube with a needle of three sides on a facet of its top: ends of nodes 0.4 h and `thin` h across, `high`
/// h.
Cloud<3> with_needle(int cells, double thin, double high) {
  Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = cells});
  const double h = 1.0 / cells;
  IndexedVector<CloudFacetIndex, Facet<3>> facets;
  bool done = false;
  for (const Facet<3>& facet : cloud.facets) {
    const auto& n = facet.node;
    const Vec3 middle = (cloud.position[n[0]] + cloud.position[n[1]] + cloud.position[n[2]]) / 3.0;
    if (done || middle.z() < 1.0 - 1e-9 || (middle - Vec3(0.5, 0.5, 1.0)).norm() > h) {
      facets.push_back(facet);
      continue;
    }
    done = true;
    std::array<NodeIndex, 3> foot{};
    const Vec3 along = (cloud.position[n[1]] - cloud.position[n[0]]).normalized(),
               across = Vec3::UnitZ().cross(along);
    const std::array<Vec3, 3> at{middle - 0.2 * h * along, middle + 0.2 * h * along,
                                 middle + thin * h * across};
    for (std::size_t k = 0; k < 3; ++k) {
      foot[k] = cloud.position.next();
      cloud.position.push_back(at[k]);
    }
    const NodeIndex tip = cloud.position.next();
    cloud.position.push_back(middle + Vec3(high * h, 0.0, high * h));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t m = (k + 1) % 3;
      facets.push_back({{n[k], n[m], foot[m]}, facet.piece});
      facets.push_back({{n[k], foot[m], foot[k]}, facet.piece});
      facets.push_back({{foot[k], foot[m], tip}, facet.piece});
    }
  }
  cloud.facets = facets;
  return cloud;
}

// Edges of a needle of three sides are sharp, and no longer than the needle.
TEST(RefineSurface, spacing_is_no_wider_than_twice_the_length_of_sharp_edges) {
  const auto widest = [](double high) {
    const Cloud<3> cloud = with_needle(6, 0.05, high);
    const Field wanted(cloud.position.size(), 1.0 / 6);
    const Field spacing = spacing_at_sharp_creases(loose_surface_of(cloud), wanted);
    return *std::max_element(spacing.begin(), spacing.end()) / wanted[0];
  };
  EXPECT_LT(widest(0.2), 2.0);
  EXPECT_GT(widest(0.5), widest(0.2));
  EXPECT_GT(widest(2.0), std::max(3.0, widest(0.5)));
}

// What a node owes goes to those that may move, however far they are.
TEST(RefineSurface, volume_is_given_back_beyond_nodes_that_stay) {
  const Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::torus, .cells = 10, .jitter = 0.1});
  const Field size(cloud.position.size(), 0.1);
  const NodeIndex owing = cloud.facets[as<CloudFacetIndex>(0)].node[0];
  IndexedVector<NodeIndex, char> fixed(cloud.position.size(), 0);
  fixed[owing] = 1;
  for (int rings = 0; rings < 3; ++rings) {
    constexpr double volume = 1e-6;
    Cloud<3> given = cloud;
    WorkingSurface surface(cloud, fixed);
    Field debt(size.size(), 0.0);
    debt[index_of(owing)] = volume;
    give_back(surface, debt, size, SurfaceThresholds{}.give_back, true);
    given.position = surface.position();
    EXPECT_NEAR(enclosed_measure(given) - enclosed_measure(cloud), volume, 0.01 * volume) << rings;
    IndexedVector<NodeIndex, char> wider = fixed;
    for (const Facet<3>& facet : cloud.facets)
      if (fixed[facet.node[0]] || fixed[facet.node[1]] || fixed[facet.node[2]])
        for (const NodeIndex i : facet.node) wider[i] = 1;
    fixed = wider;
  }
}

TEST(RefineSurface, films_whose_sides_cross_go) {
  const Cloud<3> cloud = testing::film(0.02, {0, 1});
  WorkingSurface surface = loose_surface_of(cloud);
  Field size(cloud.position.size(), 1.5);
  PassReport report;
  refine_surface(surface, size, enough(size), {}, report, PeriodImages(cloud, {}));
  const auto node = [](std::size_t k) { return as<NodeIndex>(k); };
  EXPECT_EQ(surface.between(node(0), node(1)), WorkingSurface::no_edge);
  EXPECT_NE(surface.between(node(2), node(3)), WorkingSurface::no_edge);
  EXPECT_EQ(report.flipped, 1);
}

// Metal that was drawn out into a needle bears nothing and holds the step: its end goes.
TEST(RefineSurface, needles_lose_their_end) {
  constexpr int cells = 6;
  constexpr double h = 1.0 / cells;
  for (const double thin : {0.006, 0.3}) {
    Cloud<3> cloud = with_needle(cells, thin, 2.0);
    const double volume = enclosed_measure(cloud), needle = volume - 1.0;
    ASSERT_NEAR(needle, 0.5 * 0.4 * thin * 2.0 / 3.0 * h * h * h, 1e-12);
    WorkingSurface surface = loose_surface_of(cloud);
    const NodeIndex tip = as<NodeIndex>(cloud.position.size() - 1);
    EXPECT_EQ(surface.is_tip(tip, h), thin < 0.1);
    Field size(cloud.position.size(), h);
    PassReport report;
    const RefinedSurface refined =
        refine_surface(surface, size, enough(size), {}, report, PeriodImages(cloud, {}));
    EXPECT_EQ(exists(refined.into[tip]), thin < 0.1) << thin;
    cloud.position = surface.position();
    cloud.facets = surface.facets();
    const double lost = volume - enclosed_measure(cloud); // a plane face takes nothing
    EXPECT_GT(lost, -1e-14);
    EXPECT_LT(lost, thin < 0.1 ? 1.001 * needle : 1e-14);
  }
}

// A node that stands on a facet of others has none of the metal behind it, however wide its surroundings are.
TEST(RefineSurface, nodes_without_matter_go_from_smooth_faces) {
  constexpr int cells = 6;
  constexpr double h = 1.0 / cells;
  const Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = cells});
  Field size(cloud.position.size(), h);
  for (const Vec3& place : {Vec3(0.5, 0.5, 1.0), Vec3(0.5, 1.0, 1.0), Vec3(1.0, 1.0, 1.0)}) {
    WorkingSurface surface = loose_surface_of(cloud);
    Field matter = enough(size);
    NodeIndex light = NodeIndex::none;
    for (const NodeIndex i : cloud.position.indices())
      if ((cloud.position[i] - place).norm() < 1e-9) light = i;
    ASSERT_TRUE(exists(light));
    matter[index_of(light)] = 1e-4 * h * h * h;
    PassReport report;
    Field spacing = size;
    const RefinedSurface refined =
        refine_surface(surface, spacing, matter, {}, report, PeriodImages(cloud, {}));
    const bool in_face = place.y() < 1.0; // edges and corners stay, whatever they have
    EXPECT_EQ(exists(refined.into[light]), in_face);
    EXPECT_EQ(report.removed_boundary, in_face ? 1 : 0);
  }
}

// The flat top of one tetrahedron holds the step as a cell that is as thin: it goes, a high one stays.
TEST(RefineSurface, flat_tops_without_matter_go) {
  constexpr int cells = 6;
  constexpr double h = 1.0 / cells;
  for (const double high : {0.05, 0.2}) {
    Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = cells});
    const NodeIndex top = cloud.position.next();
    const auto below = std::find_if(cloud.facets.begin(), cloud.facets.end(), [&](const Facet<3>& facet) {
      const auto x = corners_of<3>(facet, cloud.position);
      return ((x[0] + x[1] + x[2]) / 3.0 - Vec3(0.5, 0.5, 1.0)).cwiseAbs().maxCoeff() < 0.5 * h;
    });
    ASSERT_NE(below, cloud.facets.end());
    const Facet<3> facet = *below;
    const auto x = corners_of<3>(facet, cloud.position);
    cloud.position.push_back((x[0] + x[1] + x[2]) / 3.0 + high * h * Vec3::UnitZ());
    below->node[2] = top;
    for (const std::size_t k : {1, 2})
      cloud.facets.push_back({{facet.node[k], facet.node[(k + 1) % 3], top}, facet.piece});
    ASSERT_NEAR(enclosed_measure(cloud), 1.0 + high / 6.0 * h * h * h, 1e-12);
    WorkingSurface surface = loose_surface_of(cloud);
    Field size(cloud.position.size(), h), matter = enough(size);
    matter[index_of(top)] = high / 24.0 * h * h * h;
    PassReport report;
    const RefinedSurface refined = refine_surface(surface, size, matter, {}, report, PeriodImages(cloud, {}));
    EXPECT_EQ(exists(refined.into[top]), high < 0.1) << high;
  }
}

// Corners and edges of a body of one piece, sheared or not, are no tips, and straight edges lose no more
// nodes than they are short.
TEST(RefineSurface, edges_and_corners_are_no_tips) {
  Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = 6});
  for (Facet<3>& facet : cloud.facets) facet.piece = cloud.facets[CloudFacetIndex{}].piece;
  for (const double shear : {0.0, 4.0}) {
    Cloud<3> leaning = cloud;
    for (Vec3& x : leaning.position) x.x() += shear * x.y();
    const WorkingSurface surface = loose_surface_of(leaning);
    for (const NodeIndex i : cloud.position.indices()) { EXPECT_FALSE(surface.is_tip(i, 1.0 / 6.0)); }
  }
}

} // namespace
} // namespace cnem::adapt
