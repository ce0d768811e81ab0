// Clouds from geometry: counts, conformity to the boundary, quality, repeatability.
#include "generate_shapes.hpp"
#include "voronoi/plane/delaunay_flips.hpp"

#include <gtest/gtest.h>

namespace cnem::clouds {
namespace {

CloudOptions with(Pattern pattern) {
  CloudOptions options;
  options.pattern = pattern;
  return options;
}

TEST(GenerateCloud, RegularRectangleIsTheExactGrid) {
  const auto result = generate_cloud({rectangle(2, 1), {}, {}}, {0.125, {}}, with(Pattern::regular));
  EXPECT_EQ(result.cloud.nodes(), 17 * 9);
  EXPECT_EQ(result.cloud.facets.size(), 2U * (16 + 8));
  EXPECT_TRUE(result.warnings.empty());
  for (int i = 0; i <= 16; ++i)
    for (int j = 0; j <= 8; ++j) EXPECT_EQ(nodes_at(result.cloud, {i / 8.0, j / 8.0}), 1) << i << ' ' << j;
}

TEST(GenerateCloud, SidesThatAreNoMultiplesAreFitted) {
  const auto result = generate_cloud({rectangle(1.03, 0.48), {}, {}}, {0.1, {}}, with(Pattern::regular));
  EXPECT_EQ(result.cloud.nodes(), 11 * 6);
  EXPECT_EQ(nodes_at(result.cloud, {0.103, 0.096}), 1);
}

// The blank of the shearing cases, 20 mm by 10 mm at 0.2 mm: equilateral inside, the same on the left and
// right.
TEST(GenerateCloud, ShearingBlank) {
  const SpacingField spacing{2e-4, {}};
  const auto result = generate_cloud({rectangle(0.02, 0.01), {}, {}}, spacing, with(Pattern::hexagonal));
  const Cloud<2>& cloud = result.cloud;
  EXPECT_NEAR(cloud.nodes(), 6000, 150); // 2/√3 (L/h)(H/h)
  for (const Vec2& corner : {Vec2(0, 0), Vec2(0.02, 0), Vec2(0.02, 0.01), Vec2(0, 0.01)})
    EXPECT_EQ(std::ranges::count(cloud.position, corner), 1);
  const CloudQuality quality = measure_quality(cloud, spacing);
  EXPECT_GT(quality.nearest_min, 0.7);
  EXPECT_LT(quality.edge_max, 1.35);
  EXPECT_NEAR(quality.edge_mean, 1.0, 0.01);
  EXPECT_LT(quality.hole_max, 0.7);
  EXPECT_LT(quality.grading_max, 1.25);
  for (const bool upright : {false, true}) {
    double asymmetry = 0.0;
    for (const Vec2& x : cloud.position) {
      const Vec2 image = upright ? Vec2(x.x(), 0.01 - x.y()) : Vec2(0.02 - x.x(), x.y());
      double nearest = 1.0;
      for (const Vec2& y : cloud.position) nearest = std::min(nearest, (image - y).squaredNorm());
      asymmetry = std::max(asymmetry, std::sqrt(nearest));
    }
    EXPECT_LT(asymmetry, 1e-9);
  }
}

// 1 m at 0.075 m is 15.4 rows high: 16 are made, not 15, so that the nodes of both sides are staggered alike.
TEST(GenerateCloud, HexagonalRowsEndInStepWithBothSides) {
  const SpacingField spacing{0.075, {}};
  const auto cloud = generate_cloud({rectangle(3, 1), {}, {}}, spacing, with(Pattern::hexagonal)).cloud;
  EXPECT_EQ(nodes_at(cloud, {1.5 + 0.0375, 15.0 / 16}), 1);
  EXPECT_EQ(nodes_at(cloud, {1.5 + 0.0375, 1.0 / 16}), 1);
}

TEST(GenerateCloud, BoundaryPiecesKeepTheirNamesAndLengths) {
  const auto cloud = generate_cloud(filleted_square(0.3), {0.05, {}}, with(Pattern::hexagonal)).cloud;
  EXPECT_EQ(cloud.piece_names, (std::vector<std::string>{"side0", "side1", "fillet", "side3", "side4"}));
  EXPECT_NEAR(piece_length(cloud, "side0"), 1.0, 1e-12);
  EXPECT_NEAR(piece_length(cloud, "side1"), 0.7, 1e-12);
  const double quarter = 0.3 * std::numbers::pi / 2;
  EXPECT_LT(piece_length(cloud, "fillet"), quarter);
  EXPECT_NEAR(piece_length(cloud, "fillet"), quarter, 2e-3 * quarter);
  for (const Facet<2>& f : cloud.facets)
    if (cloud.piece_names[f.piece] == "fillet") {
      for (const NodeIndex i : f.node)
        EXPECT_NEAR((cloud.position[std::size_t(i)] - Vec2(0.7, 0.7)).norm(), 0.3, 1e-14);
    }
}

TEST(GenerateCloud, ChordsTurnByAtMostTwentyDegreesUnlessShort) {
  const auto chords = [](double radius) {
    const auto cloud = generate_cloud(filleted_square(radius), {0.1, {}}, with(Pattern::hexagonal)).cloud;
    return std::ranges::count_if(cloud.facets,
                                 [&](const Facet<2>& f) { return cloud.piece_names[f.piece] == "fillet"; });
  };
  EXPECT_EQ(chords(0.2), 5);  // 20° chords are 0.7 h
  EXPECT_EQ(chords(0.1), 3);  // they were 0.35 h: 0.6 h takes over
  EXPECT_EQ(chords(0.02), 2); // never more than 45°
}

TEST(GenerateCloud, EitherSenseOfTravelIsAccepted) {
  const DomainShape shape = plate_with_hole();
  const DomainShape other{shape.outer.reversed(), {shape.holes[0].reversed()}, {}};
  for (const DomainShape& domain : {shape, other})
    EXPECT_NEAR(polygon_area(generate_cloud(domain, {0.05, {}}, {}).cloud), 2.0 - 0.04 * std::numbers::pi,
                2e-3);
}

struct Shape {
  const char* name;
  DomainShape domain;
};
std::vector<Shape> shapes() {
  return {{"L", l_shape()},
          {"star", star()},
          {"annulus", annulus()},
          {"plate with hole", plate_with_hole()},
          {"fillet", filleted_square(0.25)},
          {"disc", {circle({3, -2}, 1, "rim"), {}, {}}}};
}

TEST(GenerateCloud, UniformCloudsOfAllShapesAreEven) {
  for (const Shape& shape : shapes())
    for (const double h : {0.041, 0.06, 0.083})
      for (const Pattern pattern : {Pattern::hexagonal, Pattern::regular, Pattern::jittered}) {
        SCOPED_TRACE(std::string(shape.name) + " h " + std::to_string(h) + " pattern " +
                     std::to_string(static_cast<int>(pattern)));
        const SpacingField spacing{h, {}};
        const auto result = generate_cloud(shape.domain, spacing, with(pattern));
        EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
        const double area = polygon_area(result.cloud);
        EXPECT_NEAR(triangle_area(result.cloud), area, 1e-12 * area);
        const CloudQuality quality = measure_quality(result.cloud, spacing);
        const bool jittered = pattern == Pattern::jittered;
        EXPECT_GT(quality.nearest_min, jittered ? 0.4 : 0.6);
        EXPECT_LT(quality.hole_max, jittered ? 1.0 : 0.9);
        EXPECT_LT(quality.grading_max, jittered ? 1.6 : 1.5);
        EXPECT_GT(quality.angle_min, (jittered ? 12 : 24) * std::numbers::pi / 180);
        EXPECT_NEAR(quality.edge_mean, pattern == Pattern::regular ? 1.12 : 1.0, 0.06);
      }
}

TEST(GenerateCloud, GradedCloudsFollowTheSpacing) {
  const std::vector<std::vector<Refinement>> fields = {
      {near_points({{0.6, 0.4}}, 0.004)},
      {near_points({{0.2, 0.1}, {0.4, 0.5}, {0.7, 0.6}}, 0.01, 0.2)},
      {in_box({0.2, 0.2}, {0.6, 0.7}, 0.02), near_points({{0.9, 0.1}}, 0.01, 0.4)},
  };
  for (const Shape& shape : shapes())
    for (const auto& refinements : fields)
      for (const Pattern pattern : {Pattern::hexagonal, Pattern::jittered}) {
        SCOPED_TRACE(shape.name);
        const SpacingField spacing{0.1, refinements};
        const auto result = generate_cloud(shape.domain, spacing, with(pattern));
        const double area = polygon_area(result.cloud);
        EXPECT_NEAR(triangle_area(result.cloud), area, 1e-12 * area);
        const CloudQuality quality = measure_quality(result.cloud, spacing);
        const bool jittered = pattern == Pattern::jittered;
        EXPECT_GT(quality.nearest_min, jittered ? 0.35 : 0.55);
        EXPECT_LT(quality.hole_max, jittered ? 1.15 : 1.0);
        EXPECT_LT(quality.grading_max, jittered ? 2.1 : 1.85);
        EXPECT_NEAR(quality.edge_mean, 1.03, 0.06);
      }
}

TEST(GenerateCloud, BoundarySharesOutTheSpacing) {
  const SpacingField spacing{0.1, {near_points({{0.5, 0}}, 0.005, 0.25)}};
  const auto cloud = generate_cloud({rectangle(2, 1), {}, {}}, spacing, {}).cloud;
  for (const Facet<2>& f : cloud.facets) {
    const Vec2 &a = cloud.position[std::size_t(f.node[0])], &b = cloud.position[std::size_t(f.node[1])];
    EXPECT_NEAR((b - a).norm() / spacing.at(0.5 * (a + b)), 1.0, 0.06);
  }
}

TEST(GenerateCloud, RepeatsItselfAndSeedsDiffer) {
  CloudOptions options = with(Pattern::jittered);
  for (const SpacingField& spacing :
       {SpacingField{0.06, {}}, SpacingField{0.1, {near_points({{0.5, 0.5}}, 0.01)}}}) {
    options.seed = 7;
    const auto first = generate_cloud(l_shape(), spacing, options).cloud;
    const auto again = generate_cloud(l_shape(), spacing, options).cloud;
    EXPECT_EQ(first.position, again.position);
    options.seed = 8;
    EXPECT_NE(first.position, generate_cloud(l_shape(), spacing, options).cloud.position);
    options.jitter = 0.0;
    EXPECT_EQ(generate_cloud(l_shape(), spacing, options).cloud.position,
              generate_cloud(l_shape(), spacing, with(Pattern::hexagonal)).cloud.position);
    options.jitter = 0.2;
  }
}

TEST(GenerateCloud, NodesComeInSpaceFillingOrder) {
  const auto cloud = generate_cloud({rectangle(1, 1), {}, {}}, {0.02, {}}, {}).cloud;
  double sum = 0.0;
  for (std::size_t k = 1; k < cloud.position.size(); ++k)
    sum += (cloud.position[k] - cloud.position[k - 1]).norm();
  EXPECT_LT(sum / cloud.nodes(), 1.6 * 0.02);
}

TEST(GenerateCloud, EstimateIsCloseForUniformAndGradedSpacing) {
  for (const Shape& shape : shapes())
    for (const SpacingField& spacing :
         {SpacingField{0.04, {}}, SpacingField{0.08, {near_points({{0.2, 0.1}, {0.9, 0.4}}, 0.01)}},
          SpacingField{0.1, {in_box({0.3, 0.3}, {0.6, 0.6}, 0.012)}}})
      for (const Pattern pattern : {Pattern::hexagonal, Pattern::regular}) {
        if (pattern == Pattern::regular && !spacing.uniform()) continue;
        const double nodes = generate_cloud(shape.domain, spacing, with(pattern)).cloud.nodes();
        EXPECT_NEAR(estimate_nodes(shape.domain, spacing, with(pattern)) / nodes, 1.0, 0.1) << shape.name;
      }
}

TEST(GenerateCloud, TooManyNodesAreRefusedWithAnEstimate) {
  const DomainShape domain{rectangle(2, 1), {}, {}};
  EXPECT_PRED2(contains, error_of([&] { generate_cloud(domain, {1e-5, {}}, {}); }), "about 2.3e+10 nodes");
  const std::string error = error_of([&] {
    generate_cloud(domain, {0.1, {near_points({{0.5, 0.1}, {0.6, 0.9}}, 1e-8)}}, {});
  });
  EXPECT_PRED2(contains, error, "finest 1e-08 m");
  EXPECT_PRED2(contains, error, "expected at most 5e+06");
}

TEST(GenerateCloud, WarnsOfFeaturesTheSpacingDoesNotResolve) {
  const DomainShape neck{polygon({{0, 0},
                                  {1, 0},
                                  {1, 0.48},
                                  {1.5, 0.48},
                                  {1.5, 0},
                                  {2.5, 0},
                                  {2.5, 1},
                                  {1.5, 1},
                                  {1.5, 0.52},
                                  {1, 0.52},
                                  {1, 1},
                                  {0, 1}}),
                         {},
                         {}};
  const auto narrow = generate_cloud(neck, {0.05, {}}, {});
  ASSERT_EQ(narrow.warnings.size(), 1U);
  EXPECT_PRED2(contains, narrow.warnings[0], "only 0.04 m wide");
  EXPECT_TRUE(generate_cloud(neck, {0.012, {}}, {}).warnings.empty());

  const DomainShape pinhole{rectangle(2, 1), {circle({1, 0.5}, 0.01, "pin")}, {}};
  const auto coarse = generate_cloud(pinhole, {0.05, {}}, {});
  ASSERT_EQ(coarse.warnings.size(), 1U);
  EXPECT_PRED2(contains, coarse.warnings[0], "boundary piece 'pin'");
  EXPECT_TRUE(generate_cloud(pinhole, {0.05, {near_points({{1, 0.5}}, 0.003)}}, {}).warnings.empty());
}

TEST(GenerateCloud, ImpossibleGeometryIsExplained) {
  const auto error = [](const Curve& outer, const std::vector<Curve>& holes = {}) {
    return error_of([&] { generate_cloud({outer, holes, {}}, {0.05, {}}, {}); });
  };
  EXPECT_PRED2(contains, error({}), "the outline has no pieces");
  Curve open = rectangle(1, 1);
  open.pieces[1].to = Vec2(1, 0.9);
  EXPECT_PRED2(contains, error(open), "the outline is open: piece 2 ('right') ends at (1, 0.9)");
  Curve nan = rectangle(1, 1);
  nan.pieces[0].from.x() = std::nan("");
  EXPECT_PRED2(contains, error(nan), "is not finite");
  Curve point = rectangle(1, 1);
  point.pieces.insert(point.pieces.begin() + 1, point.pieces[0]);
  point.pieces[1].from = point.pieces[1].to;
  EXPECT_PRED2(contains, error(point), "has no length");
  Curve off = filleted_square(0.3).outer;
  off.pieces[2].centre = Vec2(0.6, 0.7);
  EXPECT_PRED2(contains, error(off), "expected its radius, 0.3 m");
  EXPECT_PRED2(contains, error(polygon({{0, 0}, {1, 0}, {0.5, 0}})), "encloses no area");
  EXPECT_PRED2(contains, error(polygon({{0, 0}, {2, 0}, {0, 1}, {1, 1.47}})), "cross");
  EXPECT_PRED2(contains, error(rectangle(1, 1), {circle({0.9, 0.5}, 0.2, "eye")}),
               "hole 1 ('eye') is not inside the outline: its point (1.1, 0.5)");
  EXPECT_PRED2(contains, error(rectangle(1, 1), {circle({0.1, 0.52}, 0.2, "eye")}), "cross");
  EXPECT_PRED2(contains,
               error(rectangle(1, 1), {circle({0.5, 0.5}, 0.2, "a"), circle({0.6, 0.52}, 0.21, "b")}),
               "cross");
}

TEST(GenerateCloud, OptionsOutOfRangeAreExplained) {
  const DomainShape domain{rectangle(1, 1), {}, {}};
  const auto error = [&](const SpacingField& spacing, const CloudOptions& options = {}) {
    return error_of([&] { generate_cloud(domain, spacing, options); });
  };
  EXPECT_PRED2(contains, error({0.0, {}}), "expected a positive length");
  EXPECT_PRED2(contains, error({0.1, {near_points({{0, 0}}, -1)}}), "refinement 1: the spacing is -1 m");
  EXPECT_PRED2(contains, error({0.1, {near_points({{0, 0}}, 0.01, 2.0)}}),
               "growth is 2; expected a number in (0, 1]");
  EXPECT_PRED2(contains, error({0.1, {near_points({}, 0.01)}}), "expected at least one");
  EXPECT_PRED2(contains, error({0.1, {{Refinement::Region::box, {{0, 0}}, 0.01, 0.3}}}),
               "two opposite corners");
  CloudOptions options = with(Pattern::jittered);
  options.jitter = 0.6;
  EXPECT_PRED2(contains, error({0.1, {}}, options), "jitter is 0.6");
  EXPECT_PRED2(contains, error({0.1, {near_points({{0, 0}}, 0.01)}}, with(Pattern::regular)),
               "no refinements");
}

TEST(SpacingField, GrowsFromItsRegions) {
  const SpacingField spacing{
      1.0, {near_points({{0, 0}, {1, 0}, {1, 1}}, 0.1, 0.5), in_box({5, 6}, {4, 5}, 0.2, 0.25)}};
  EXPECT_DOUBLE_EQ(spacing.at({0.5, 0}), 0.1);
  EXPECT_DOUBLE_EQ(spacing.at({1.4, 0.5}), 0.3);
  EXPECT_DOUBLE_EQ(spacing.at({-0.3, -0.4}), 0.35);
  EXPECT_DOUBLE_EQ(spacing.at({4.5, 5.5}), 0.2);
  EXPECT_DOUBLE_EQ(spacing.at({4.5, 6.4}), 0.3);
  EXPECT_DOUBLE_EQ(spacing.at({20, 0}), 1.0);
  EXPECT_FALSE(spacing.uniform());
  EXPECT_TRUE((SpacingField{0.1, {near_points({{0, 0}}, 0.2)}}.uniform()));
}

// Moved nodes with flips give the triangles of a new triangulation.
TEST(RestoreDelaunay, AgreesWithANewTriangulation) {
  Cloud<2> cloud = generate_cloud(plate_with_hole(), {0.05, {}}, with(Pattern::jittered)).cloud;
  voronoi::Triangulation mesh = voronoi::triangulate(cloud);
  std::vector<bool> boundary(cloud.position.size(), false);
  for (const Facet<2>& f : cloud.facets) boundary[std::size_t(f.node[0])] = true;
  for (std::size_t i = 0; i < cloud.position.size(); ++i)
    if (!boundary[i])
      cloud.position[i] += 0.006 * Vec2(std::sin(7.0 * double(i)), std::cos(11.0 * double(i)));
  const auto sorted = [](const voronoi::Triangulation& m) {
    auto triangles = m.node;
    for (auto& n : triangles) std::rotate(n.begin(), std::min_element(n.begin(), n.end()), n.end());
    std::ranges::sort(triangles);
    return triangles;
  };
  const voronoi::Triangulation expected = voronoi::triangulate(cloud);
  EXPECT_NE(sorted(mesh), sorted(expected));
  voronoi::restore_delaunay(mesh, cloud.position);
  EXPECT_EQ(sorted(mesh), sorted(expected));
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < 3; ++k) {
      const SimplexIndex o = mesh.neighbour[t][k];
      const CloudFacetIndex f = mesh.facet[t][k];
      ASSERT_EQ(!exists(o), exists(f));
      if (exists(f)) {
        EXPECT_EQ(cloud.facets[f].node[0], mesh.node[t][(k + 1) % 3]);
        EXPECT_EQ(cloud.facets[f].node[1], mesh.node[t][(k + 2) % 3]);
      } else
        EXPECT_TRUE(std::ranges::count(mesh.neighbour[o], t) == 1);
    }
}

TEST(GenerateCloud, arcs_of_few_chords_are_told) {
  const DomainShape disc{circle({0, 0}, 1.0, "rim"), {}, {}};
  const auto coarse = generate_cloud(disc, {0.8, {}}, {}).warnings;
  ASSERT_EQ(coarse.size(), 1U);
  EXPECT_PRED2(contains, coarse[0], "3.3% less than the domain: its arcs are few chords");
  EXPECT_TRUE(generate_cloud(disc, {0.2, {}}, {}).warnings.empty()) << "0.6% less";
  const DomainShape plate{rectangle(2, 2), {circle({1, 1}, 0.7, "hole")}, {}};
  EXPECT_TRUE(std::ranges::any_of(generate_cloud(plate, {0.4, {}}, {}).warnings, [](const std::string& text) {
    return contains(text, "% more than the domain");
  }));
}

} // namespace
} // namespace cnem::clouds
