// Surfaces of STL files: what is read, how they are divided, what is refused.
#include "clouds/space/faceted.hpp"
#include "clouds/space/generate.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "tests/unit/clouds/space_shapes.hpp"
#include "voronoi/space/recovery.hpp"

#include <gtest/gtest.h>

namespace cnem::clouds {
namespace {

FacetSoup soup_of(const Cloud<3>& surface) {
  FacetSoup soup;
  soup.solids = {""};
  for (const Facet<3>& facet : surface.facets)
    soup.triangles.push_back({corners_of(facet, surface.position), 0});
  return soup;
}

Faceted faceted(const std::string& body, double spacing) {
  for (const testing::Body& candidate : testing::bodies())
    if (candidate.name == body) return {soup_of(surface_of(candidate.domain, {spacing, {}})), 0.6981317, {}};
  return {};
}

TEST(Stl, IsDividedAtCreasesAndNamed) {
  Faceted box = faceted("box", 5.0);
  box.names = {{{1, 0.5, 1}, "lid"}, {{0, 0.5, 0.5}, "left"}};
  const Cloud<3> surface = divided_surface(box);
  std::map<std::string, double> area;
  for (const Facet<3>& facet : surface.facets)
    area[surface.piece_names[facet.piece]] += area_normal<3>(corners_of(facet, surface.position)).norm();
  EXPECT_EQ(area.size(), 6u);
  EXPECT_NEAR(area["lid"], 2.0, 1e-12);
  EXPECT_NEAR(area["left"], 1.0, 1e-12);
  EXPECT_NEAR(area["surface-2"], 2.0, 1e-12); // by size: the lid was the first or a later one of four
}

TEST(Stl, IsRemeshedToTheSpacing) {
  for (const char* name : {"box", "plate with a hole", "ball"}) {
    SCOPED_TRACE(name);
    const Faceted shape = faceted(name, 0.1);
    const SpaceSpacing spacing{0.2, {}};
    const Cloud<3> cloud = generate_cloud(shape, spacing).cloud;
    const voronoi::RecoveredBoundary held = voronoi::recover_boundary(cloud);
    EXPECT_NEAR(enclosed_measure(held.cloud) / domain_volume(shape), 1.0, 0.02);
    const SpaceQuality quality = measure_quality(
        held.cloud, spacing, std::vector(held.tetrahedra.node.begin(), held.tetrahedra.node.end()));
    EXPECT_GT(quality.nearest_min, 0.3);
    EXPECT_NEAR(quality.edge_mean, 1.08, 0.1);
  }
}

std::string refusal_of_surface(const Faceted& shape) {
  try {
    divided_surface(shape);
  } catch (const GeometryError& error) { return error.what(); }
  return "";
}

TEST(Stl, SaysWhatIsWrongWithASurface) {
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  Faceted open = faceted("box", 5.0);
  open.soup.triangles.pop_back();
  EXPECT_PRED2(contains, refusal_of_surface(open), "open");
  Faceted inside_out = faceted("box", 5.0);
  for (auto& triangle : inside_out.soup.triangles) std::swap(triangle.corner[0], triangle.corner[1]);
  EXPECT_PRED2(contains, refusal_of_surface(inside_out), "inside out");
  Faceted crossing = faceted("box", 5.0);
  for (const auto& triangle : faceted("box", 5.0).soup.triangles) {
    crossing.soup.triangles.push_back(triangle);
    for (Vec3& x : crossing.soup.triangles.back().corner) x += Vec3(0.5, 0.25, 0.3);
  }
  EXPECT_PRED2(contains, refusal_of_surface(crossing), "the surface crosses itself: facet");
  Faceted flat = faceted("box", 5.0);
  flat.soup.triangles.push_back({{Vec3(5, 0, 0), Vec3(6, 0, 0), Vec3(7, 0, 0)}, 0});
  EXPECT_PRED2(contains, refusal_of_surface(flat), "has no area");
  EXPECT_PRED2(contains, refusal_of_surface({}), "no facets");
}

} // namespace
} // namespace cnem::clouds
