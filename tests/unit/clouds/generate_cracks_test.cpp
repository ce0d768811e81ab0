// Cracks in generated clouds and node lists.
#include "generate_shapes.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::clouds {
namespace {

DomainShape plate_with(std::vector<Crack> cracks) { return {rectangle(2, 1), {}, std::move(cracks)}; }

/// Each node of a facet starts exactly one and ends exactly one; facets come loop after loop.
int count_loops(const Cloud<2>& cloud) {
  std::vector<int> starts(cloud.position.size(), 0), ends(cloud.position.size(), 0);
  int loops = 0;
  NodeIndex first = NodeIndex::none;
  for (std::size_t f = 0; f < cloud.facets.size(); ++f) {
    const auto [a, b] = cloud.facets[f].node;
    ++starts[std::size_t(a)];
    ++ends[std::size_t(b)];
    if (!exists(first)) first = a;
    if (b == first) {
      ++loops;
      first = NodeIndex::none;
    } else
      EXPECT_EQ(cloud.facets[f + 1].node[0], b);
  }
  EXPECT_EQ(first, NodeIndex::none);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_LE(starts[i], 1);
    EXPECT_EQ(starts[i], ends[i]);
  }
  return loops;
}

void expect_sound(const Cloud<2>& cloud, double area) {
  EXPECT_NEAR(polygon_area(cloud), area, 1e-12);
  EXPECT_NEAR(triangle_area(cloud), area, 1e-12);
  for (const auto& [a, b] : cloud.twins)
    EXPECT_EQ(cloud.position[std::size_t(a)], cloud.position[std::size_t(b)]);
}

/// Smallest distance from the path of a node that is not on it.
double clearance(const Cloud<2>& cloud, const Crack& crack) {
  const Refinement path{Refinement::Region::path, crack.path, 1.0, 1.0};
  double nearest = 1e300;
  for (const Vec2& x : cloud.position)
    if (path.distance(x) > 1e-12) nearest = std::min(nearest, path.distance(x));
  return nearest;
}

TEST(GenerateCracks, EmbeddedCrackHasDoubleFacesAndSingleTips) {
  const Crack crack{"slit", {{0.7, 0.5}, {1.3, 0.6}}};
  const auto result = generate_cloud(plate_with({crack}), {0.05, {}}, {});
  const Cloud<2>& cloud = result.cloud;
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(count_loops(cloud), 2);
  expect_sound(cloud, 2.0);
  EXPECT_EQ(cloud.twins.size(), 11U); // 12 edges of 0.05
  EXPECT_EQ(nodes_at(cloud, crack.path[0]), 1);
  EXPECT_EQ(nodes_at(cloud, crack.path[1]), 1);
  EXPECT_EQ(nodes_at(cloud, {1.0, 0.55}), 2);
  EXPECT_GT(clearance(cloud, crack), 0.02);
  for (const char* face : {"slit+", "slit-"})
    EXPECT_NEAR(piece_length(cloud, face), std::hypot(0.6, 0.1), 1e-12);
  // The + face has its material on the left of the path: its triangles lie above.
  const voronoi::Triangulation mesh = voronoi::triangulate(cloud);
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < 3; ++k) {
      if (!exists(mesh.facet[t][k])) continue;
      const std::string& piece = cloud.piece_names[cloud.facets[mesh.facet[t][k]].piece];
      if (piece.substr(0, 4) != "slit") continue;
      const double side = cross(Vec2(0.6, 0.1), cloud.position[std::size_t(mesh.node[t][k])] - crack.path[0]);
      EXPECT_EQ(side > 0.0, piece == "slit+");
    }
}

TEST(GenerateCracks, EdgeCrackIsADetourOfTheOutline) {
  const Crack crack{"notch", {{1, 0}, {1, 0.4}, {1.2, 0.55}}};
  const Cloud<2> cloud = generate_cloud(plate_with({crack}), {0.05, {}}, {}).cloud;
  EXPECT_EQ(count_loops(cloud), 1);
  expect_sound(cloud, 2.0);
  EXPECT_EQ(nodes_at(cloud, {1, 0}), 2);
  EXPECT_EQ(nodes_at(cloud, {1, 0.4}), 2);
  EXPECT_EQ(nodes_at(cloud, {1.2, 0.55}), 1);
  EXPECT_EQ(cloud.twins.size(), 13U); // mouth, kink and what lies between 8 + 5 edges
  EXPECT_GT(clearance(cloud, crack), 0.02);
  EXPECT_NEAR(piece_length(cloud, "bottom"), 2.0, 1e-12);
}

TEST(GenerateCracks, CracksOfEveryKindTogether) {
  const DomainShape domain{rectangle(2, 1),
                           {circle({1, 0.5}, 0.2, "hole")},
                           {{"a", {{1.6, 0.5}, {1.2, 0.5}}},   // opens into the hole
                            {"b", {{0, 0.5}, {0.3, 0.55}}},    // inclined, open to the outline
                            {"c", {{2, 1}, {1.7, 0.8}}},       // from a corner
                            {"d", {{0.5, 0.2}, {0.8, 0.2}}}}}; // inside
  for (const Pattern pattern : {Pattern::hexagonal, Pattern::regular, Pattern::jittered}) {
    CloudOptions options;
    options.pattern = pattern;
    const Cloud<2> cloud = generate_cloud(domain, {0.03, {}}, options).cloud;
    EXPECT_EQ(count_loops(cloud), 3);
    expect_sound(cloud, polygon_area(cloud));
    EXPECT_EQ(nodes_at(cloud, {2, 1}), 2);
    EXPECT_EQ(nodes_at(cloud, {1.2, 0.5}), 2);
    for (const Crack& crack : domain.cracks) EXPECT_GT(clearance(cloud, crack), 0.01);
  }
}

TEST(GenerateCracks, ThroughCracksJoinLoopsOrSplitTheDomain) {
  DomainShape domain{rectangle(2, 1), {circle({1, 0.5}, 0.2, "hole")}, {{"a", {{1.2, 0.5}, {2, 0.5}}}}};
  const Cloud<2> joined = generate_cloud(domain, {0.04, {}}, {}).cloud;
  EXPECT_EQ(count_loops(joined), 1);
  expect_sound(joined, polygon_area(joined));
  const Cloud<2> split = generate_cloud(plate_with({{"a", {{1.2, 0}, {1.1, 1}}}}), {0.04, {}}, {}).cloud;
  EXPECT_EQ(count_loops(split), 2);
  expect_sound(split, 2.0);
}

TEST(GenerateCracks, TipsCanBeGraded) {
  const SpacingField spacing{0.1, {near_points({{0.7, 0.5}}, 0.005), near_points({{1.3, 0.6}}, 0.005)}};
  const Cloud<2> cloud = generate_cloud(plate_with({{"slit", {{0.7, 0.5}, {1.3, 0.6}}}}), spacing, {}).cloud;
  expect_sound(cloud, 2.0);
  const CloudQuality quality = measure_quality(cloud, spacing);
  EXPECT_GT(quality.nearest_min, 0.6);
  EXPECT_LT(quality.hole_max, 1.0);
  EXPECT_LT(quality.grading_max, 1.8);
}

// A fibre that rises at 5 degrees meets the free surface at that angle, fine cells at its mouth or not.
TEST(GenerateCracks, EndOnTheBoundaryAtASmallAngle) {
  const Vec2 mouth{1.0, 1.0};
  for (const double degrees : {5.0, 8.0, 13.0, 172.0})
    for (const SpacingField& spacing :
         {SpacingField{0.05, {}}, SpacingField{0.05, {near_points({mouth}, 0.01)}}}) {
      SCOPED_TRACE(degrees);
      const double angle = degrees * std::numbers::pi / 180.0;
      const Vec2 tip = mouth - 0.6 * Vec2(std::cos(angle), std::sin(angle));
      expect_sound(generate_cloud(plate_with({{"slit", {mouth, tip}}}), spacing, {}).cloud, 2.0);
    }
}

TEST(GenerateCracks, KeepAwayFromHolesBesideTheirMouth) {
  DomainShape plate = plate_with({{"slit", {{0.8, 0}, {0.8, 0.4}}}});
  const auto refused = [&](double gap) {
    plate.holes = {circle({0.89 + gap, 0.15}, 0.09, "hole")};
    return error_of([&] { generate_cloud(plate, {0.05, {}}, {}); });
  };
  EXPECT_PRED2(contains, refused(0.008), "crack 'slit' comes within");
  EXPECT_EQ(refused(0.03), "no error");
}

TEST(GenerateCracks, BadCracksAreExplained) {
  const auto error = [](std::vector<Crack> cracks) {
    return error_of([&] { generate_cloud(plate_with(std::move(cracks)), {0.05, {}}, {}); });
  };
  const Crack slit{"slit", {{0.7, 0.5}, {1.3, 0.6}}};
  EXPECT_PRED2(contains, error({slit, {"other", {{0.9, 0.3}, {1.1, 0.8}}}}),
               "cracks 'slit' and 'other' cross");
  EXPECT_PRED2(contains, error({slit, {"other", {{1.3, 0.6}, {1.5, 0.8}}}}), "touch");
  EXPECT_PRED2(contains, error({{"long", {{0.7, 0.5}, {1.3, 1.6}}}}),
               "crack 'long' crosses the boundary 'top'");
  EXPECT_PRED2(contains, error({{"away", {{2.7, 0.5}, {3.3, 0.6}}}}), "crack 'away' leaves the domain");
  EXPECT_PRED2(contains, error({{"near", {{0.7, 0.01}, {0.9, 0.5}}}}),
               "comes within 0.01 m of the boundary 'bottom'");
  EXPECT_PRED2(contains, error({{"flat", {{0.7, 0}, {1.4, 0.05}}}}),
               "at 4.09 degrees; expected 5 degrees or more");
  EXPECT_PRED2(contains, error({{"low", {{1, 0}, {1, 0.03}, {1.4, 0.002}}}}), "of the boundary 'bottom'");
  EXPECT_PRED2(contains, error({{"back", {{1, 0}, {1, 0.3}, {1.4, 0.01}}}}), "of the boundary 'bottom'");
  EXPECT_PRED2(contains, error({{"knot", {{0.5, 0.5}, {1, 0.5}, {1, 0.7}, {0.7, 0.3}}}}),
               "touches itself at");
  EXPECT_PRED2(contains, error({{"fold", {{0.5, 0.5}, {1, 0.5}, {0.5, 0.51}}}}), "sharp turns");
  EXPECT_PRED2(contains, error({{"point", {{0.5, 0.5}}}}), "expected at least two");
  EXPECT_PRED2(contains, error({{"still", {{0.5, 0.5}, {0.5, 0.5}}}}), "coincide");
}

} // namespace
} // namespace cnem::clouds
