// Clouds from node lists.
#include "generate_shapes.hpp"

#include <gtest/gtest.h>

namespace cnem::clouds {
namespace {

GeneratedCloud from_list(const DomainShape& domain, const std::vector<Vec2>& nodes) {
  CloudOptions options;
  options.pattern = Pattern::list;
  options.nodes = nodes;
  return generate_cloud(domain, {}, options);
}

std::vector<Vec2> grid(int columns, int rows, double width, double height) {
  std::vector<Vec2> nodes;
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j) nodes.emplace_back(width * i / columns, height * j / rows);
  return nodes;
}

TEST(GenerateList, KeepsTheOrderAndFindsTheBoundary) {
  const auto nodes = grid(8, 4, 2.0, 1.0);
  const auto result = from_list({rectangle(2, 1), {}, {}}, nodes);
  EXPECT_EQ(result.cloud.position, nodes);
  EXPECT_EQ(result.cloud.facets.size(), 24U);
  EXPECT_TRUE(result.cloud.twins.empty());
  EXPECT_NEAR(triangle_area(result.cloud), 2.0, 1e-12);
  for (const char* piece : {"bottom", "top"}) EXPECT_NEAR(piece_length(result.cloud, piece), 2.0, 1e-12);
}

TEST(GenerateList, TakesBackAGeneratedCloud) {
  const DomainShape domain = plate_with_hole();
  const Cloud<2> cloud = generate_cloud(domain, {0.05, {}}, {}).cloud;
  const Cloud<2> again = from_list(domain, cloud.position).cloud;
  EXPECT_EQ(again.position, cloud.position);
  ASSERT_EQ(again.facets.size(), cloud.facets.size());
  EXPECT_EQ(polygon_area(again), polygon_area(cloud));
  EXPECT_NEAR(piece_length(again, "hole"), piece_length(cloud, "hole"), 1e-12);
}

TEST(GenerateList, DoublesTheFacesOfCracks) {
  const auto nodes = grid(8, 4, 2.0, 1.0);
  DomainShape domain{
      rectangle(2, 1), {}, {{"slit", {{0.5, 0.5}, {1.5, 0.5}}}, {"notch", {{1, 0}, {1, 0.25}}}}};
  const Cloud<2> cloud = from_list(domain, nodes).cloud;
  EXPECT_EQ(cloud.twins.size(), 3U + 1U);
  EXPECT_EQ(cloud.nodes(), 45 + 4);
  EXPECT_TRUE(std::equal(nodes.begin(), nodes.end(), cloud.position.begin()));
  EXPECT_NEAR(triangle_area(cloud), 2.0, 1e-12);
  EXPECT_NEAR(piece_length(cloud, "slit-"), 1.0, 1e-12);
  domain.cracks[0].path[0].x() = 0.6;
  EXPECT_PRED2(contains, error_of([&] { from_list(domain, nodes); }),
               "crack 'slit': no node of the list lies at (0.6, 0.5)");
}

TEST(GenerateList, ErrorsNameTheNode) {
  const DomainShape domain{rectangle(2, 1), {}, {}};
  const auto nodes = grid(8, 4, 2.0, 1.0);
  auto no_corner = nodes;
  std::erase(no_corner, Vec2(2, 1));
  EXPECT_PRED2(contains, error_of([&] { from_list(domain, no_corner); }),
               "no node of the list lies at (2, 1)");
  auto outside = nodes;
  outside.emplace_back(1.0, 1.5);
  EXPECT_PRED2(contains, error_of([&] { from_list(domain, outside); }),
               "node 45 of the list at (1, 1.5) lies outside");
  auto twice = nodes;
  twice.emplace_back(0.5, 0.5 + 1e-12);
  EXPECT_PRED2(contains, error_of([&] { from_list(domain, twice); }),
               "nodes 12 and 45 of the list coincide at (0.5, 0.5)");
  auto nan = nodes;
  nan[3].y() = std::nan("");
  EXPECT_PRED2(contains, error_of([&] { from_list(domain, nan); }), "node 3 of the list is not finite");
  EXPECT_PRED2(contains, error_of([&] { from_list(domain, {{0, 0}, {1, 0}}); }), "expected at least 3");
  // Between the chord and the arc: outside the polygon.
  const DomainShape disc{circle({0, 0}, 1, "rim"), {}, {}};
  EXPECT_PRED2(contains, error_of([&] {
                 from_list(disc, {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0.6, 0.6}});
               }),
               "node 4 of the list at (0.6, 0.6) lies outside");
  EXPECT_PRED2(contains, error_of([&] {
                 from_list(disc, {{1, 0}, {0, 1}, {0.1, 0.1}});
               }),
               "2 nodes of the list lie on");
}

} // namespace
} // namespace cnem::clouds
