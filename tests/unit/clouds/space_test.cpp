// Clouds of bodies in space: they enclose what was described, the Delaunay triangulation holds their
// boundary, and their tetrahedra are of good shape.
#include "clouds/space/generate.hpp"
#include "clouds/space/surface.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "tests/unit/clouds/space_shapes.hpp"
#include "voronoi/space/recovery.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace cnem::clouds {
namespace {

using testing::bodies;
using testing::Body;

std::vector<std::array<NodeIndex, 4>> list_of(const voronoi::Tetrahedra& tetrahedra) {
  return {tetrahedra.node.begin(), tetrahedra.node.end()};
}

double filled(const Cloud<3>& cloud, const voronoi::Tetrahedra& tetrahedra) {
  double sum = 0.0, lost = 0.0; // compensated: thousands of equal tetrahedra round alike
  for (const auto& n : tetrahedra.node) {
    const double part =
        measure<3>({cloud.position[n[0]], cloud.position[n[1]], cloud.position[n[2]], cloud.position[n[3]]}) -
        lost;
    const double next = sum + part;
    lost = (next - sum) - part;
    sum = next;
  }
  return sum;
}

std::map<std::string, double> areas(const Cloud<3>& cloud) {
  std::map<std::string, double> area;
  for (const Facet<3>& facet : cloud.facets)
    area[cloud.piece_names[facet.piece]] += area_normal<3>(corners_of(facet, cloud.position)).norm();
  return area;
}

TEST(SpaceClouds, EncloseTheBodyAndTriangulateWithTheirBoundary) {
  for (const Body& body : bodies())
    for (const double fraction : {1.0, 0.7, 0.5}) {
      SCOPED_TRACE(body.name + " " + std::to_string(fraction));
      const SpaceSpacing spacing{fraction * body.spacing, {}};
      const Cloud<3> cloud = generate_cloud(body.domain, spacing).cloud;
      EXPECT_NEAR(domain_volume(body.domain), body.volume, 1e-5 * body.volume);
      const double bound = 0.65 * spacing.spacing * spacing.spacing; // chords of circles
      EXPECT_NEAR(enclosed_measure(cloud) / body.volume, 1.0, bound);
      for (const auto& [name, area] : body.areas) EXPECT_NEAR(areas(cloud)[name] / area, 1.0, bound) << name;

      const voronoi::RecoveredBoundary held = voronoi::recover_boundary(cloud);
      EXPECT_EQ(held.counts.removed + held.counts.replaced, 0);
      EXPECT_LE(held.counts.flipped, 2);
      EXPECT_EQ(held.counts.lost, 0);
      EXPECT_NEAR(filled(held.cloud, held.tetrahedra) / enclosed_measure(held.cloud), 1.0, 1e-12);
      const SpaceQuality quality = measure_quality(held.cloud, spacing, list_of(held.tetrahedra));
      EXPECT_GT(quality.nearest_min, 0.4);
      EXPECT_LT(quality.edge_max, 1.9);
      EXPECT_NEAR(quality.edge_mean, 1.08, 0.08);
      EXPECT_LT(quality.slivers, 0.013);
      EXPECT_GT(quality.facet_angle_min, 0.3);
      const double nodes = static_cast<double>(cloud.position.size());
      EXPECT_NEAR(estimate_nodes(body.domain, spacing) / nodes, 1.0, 0.25);
    }
}

TEST(SpaceClouds, VolumeConvergesQuadratically) {
  const Body ball = bodies()[5];
  std::array<double, 2> error;
  for (const std::size_t k : {0u, 1u})
    error[k] = 1.0 - enclosed_measure(surface_of(ball.domain, {0.3 / (1.0 + double(k)), {}})) / ball.volume;
  EXPECT_GT(error[0] / error[1], 3.0);
  EXPECT_LT(error[1], 0.012);
}

TEST(SpaceClouds, FollowARefinement) {
  const Body box = bodies()[0], ball = bodies()[5];
  for (const Body* body : {&box, &ball}) {
    SCOPED_TRACE(body->name);
    const Vec3 at = body == &box ? Vec3(2, 1, 1) : Vec3(3, -1, 3);
    const SpaceSpacing spacing{0.3, {{SpaceRefinement::Region::path, {at}, 0.05, 0.4}}};
    const Cloud<3> cloud = generate_cloud(body->domain, spacing).cloud;
    const voronoi::RecoveredBoundary held = voronoi::recover_boundary(cloud);
    EXPECT_EQ(held.counts.lost, 0);
    EXPECT_NEAR(filled(held.cloud, held.tetrahedra) / enclosed_measure(held.cloud), 1.0, 1e-12);
    const SpaceQuality quality = measure_quality(held.cloud, spacing, list_of(held.tetrahedra));
    EXPECT_GT(quality.nearest_min, 0.45);
    EXPECT_LT(quality.edge_max, 2.1);
    EXPECT_NEAR(quality.edge_mean, 1.1, 0.1);
    EXPECT_LT(quality.slivers, 0.01);
    EXPECT_NEAR(estimate_nodes(body->domain, spacing) / static_cast<double>(cloud.position.size()), 1.0,
                0.35);
  }
}

TEST(SpaceClouds, AreTheSameEachTime) {
  const Body body = bodies()[1];
  const Cloud<3> one = generate_cloud(body.domain, {0.15, {}}).cloud;
  const Cloud<3> other = generate_cloud(body.domain, {0.15, {}}).cloud;
  ASSERT_EQ(one.position.size(), other.position.size());
  for (const NodeIndex i : one.position.indices()) EXPECT_EQ(one.position[i], other.position[i]);
}

std::string refusal_of(const SpaceDomain& domain, const SpaceSpacing& spacing = {0.3, {}},
                       double limit = 1e5) {
  try {
    generate_cloud(domain, spacing, limit);
  } catch (const GeometryError& error) { return error.what(); }
  return "";
}

TEST(SpaceClouds, SayWhatIsWrong) {
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const DomainShape square{testing::corners({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {"a", "b", "c", "d"}), {}, {}};
  const DomainShape across{testing::corners({{-1, 0}, {1, 0}, {1, 1}}, {"a", "b", "c"}), {}, {}};
  const DomainShape pinched{testing::corners({{0, 0}, {1, -1}, {1, 1}}, {"a", "b", "c"}), {}, {}};
  const Vec3 here(0, 0, 0);
  EXPECT_PRED2(contains, refusal_of(Extrusion{square, 1, 1}), "has no volume");
  EXPECT_PRED2(contains, refusal_of(Revolution{across, here, 1}), "crosses the axis");
  EXPECT_PRED2(contains, refusal_of(Revolution{pinched, here, 1}),
               "touches the axis at the single point (0, 0)");
  EXPECT_PRED2(contains, refusal_of(Revolution{square, here, 7}), "expected an angle in (0, 2π]");
  EXPECT_PRED2(contains, refusal_of(Extrusion{square, 0, 1}, {0.01, {}}), "makes about 1.3e+06 nodes");
}

} // namespace
} // namespace cnem::clouds
