// A triangulation that begins with an earlier one is the one from nothing, to the bit: on adversarial clouds
// whose nodes move, come and go.
#include "voronoi/plane/retriangulation.hpp"

#include "core/error.hpp"
#include "core/fields/aligned.hpp"
#include "core/index.hpp"
#include "tests/clouds.hpp"
#include "tests/degenerate/random_clouds.hpp"
#include "tests/index_literals.hpp"
#include "voronoi/plane/plain_boundary.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace cnem::voronoi::test {
namespace {

using namespace testing::literals;
using Numbers = cnem::testing::Random;

constexpr std::uint32_t retriangulated_seeds = 30;

Triangulation from_nothing(Cloud<2> cloud) {
  cloud.simplices.clear();
  cloud.across.clear();
  return triangulate(cloud);
}

void expect_same(const Triangulation& a, const Triangulation& b) {
  EXPECT_EQ(a.node, b.node);
  EXPECT_EQ(a.neighbour, b.neighbour);
  EXPECT_EQ(a.facet, b.facet);
  EXPECT_EQ(a.triangle_of_node, b.triangle_of_node);
}

std::size_t place_of(const std::array<SimplexIndex, 3>& list, SimplexIndex t) {
  return index_of(std::find(list.begin(), list.end(), t) - list.begin());
}

/// Other triangles on the same nodes: sides turned at random where that leaves triangles, in another order.
void scramble(Cloud<2>& cloud, Triangulation mesh, Numbers& random) {
  const auto at = [&](NodeIndex i) -> const Vec2& { return cloud.position[i]; };
  IndexedVector<SimplexIndex, char> done(mesh.node.size(), 0);
  for (const SimplexIndex t : mesh.node.indices()) {
    const auto k = static_cast<std::size_t>(random.uniform(0.0, 3.0));
    const SimplexIndex o = mesh.neighbour[t][k];
    if (!exists(o) || done[t] || done[o]) continue;
    const std::size_t m = place_of(mesh.neighbour[o], t);
    const NodeIndex p = mesh.node[t][k], a = mesh.node[t][(k + 1) % 3], b = mesh.node[t][(k + 2) % 3],
                    q = mesh.node[o][m];
    const double size = (at(b) - at(a)).squaredNorm() + (at(q) - at(p)).squaredNorm();
    if (cross(at(a) - at(p), at(q) - at(p)) < 1e-6 * size ||
        cross(at(q) - at(p), at(b) - at(p)) < 1e-6 * size)
      continue;
    mesh.node[t] = {a, q, p};
    mesh.node[o] = {b, p, q};
    done[t] = done[o] = 1;
  }
  cloud.simplices = mesh.node;
  for (std::size_t n = cloud.simplices.size(); n > 1; --n) // Fisher, Yates
    std::swap(cloud.simplices[n - 1],
              cloud.simplices[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(n)))]);
}

/// Begins with a triangulation that knows nothing of what is across some of its sides.
void begin_with(Cloud<2>& cloud, const Triangulation& mesh, Numbers& random) {
  cloud.simplices = mesh.node;
  cloud.across = mesh.neighbour;
  for (const SimplexIndex t : cloud.across.indices())
    for (SimplexIndex& o : cloud.across[t])
      if (exists(o) && random.uniform(0.0, 1.0) < 0.1) {
        cloud.across[o][place_of(cloud.across[o], t)] = SimplexIndex::none;
        o = SimplexIndex::none;
      }
}

class Retriangulated : public ::testing::TestWithParam<int> {
protected:
  template<class Check> void for_each_cloud(Check check) {
    for (std::uint32_t seed = 0; seed < retriangulated_seeds; ++seed) {
      RandomCloud random = random_cloud(GetParam(), seed);
      if (!random.cloud.twins.empty()) continue;
      SCOPED_TRACE(random.name);
      Numbers numbers(seed);
      check(random.cloud, numbers);
      if (HasFailure()) return;
    }
  }
};

TEST_P(Retriangulated, FromOtherTriangles) {
  for_each_cloud([](Cloud<2>& cloud, Numbers& random) {
    const Triangulation mesh = from_nothing(cloud);
    scramble(cloud, mesh, random);
    const auto again = retriangulate(cloud);
    ASSERT_EQ(again.has_value(), is_plain_boundary(cloud)); // faces of slits may be too near to tell
    if (again) expect_same(*again, mesh);
  });
}

TEST_P(Retriangulated, WhenNodesHaveMoved) {
  for_each_cloud([](Cloud<2>& cloud, Numbers& random) {
    begin_with(cloud, from_nothing(cloud), random);
    for (int k = 0; k < 5; ++k) {
      Field reach(cloud.position.size(), 1e300);
      for (const auto& corner : cloud.simplices)
        for (std::size_t c = 0; c < 3; ++c)
          for (const std::size_t e : {(c + 1) % 3, (c + 2) % 3}) {
            double& r = reach[index_of(corner[c])];
            r = std::min(r, (cloud.position[corner[e]] - cloud.position[corner[c]]).norm());
          }
      for (std::size_t i = 0; i < reach.size(); ++i)
        cloud.position[i] += 0.1 * (k + 1) * reach[i] * Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
      Triangulation mesh;
      try {
        mesh = from_nothing(cloud);
      } catch (const GeometryError&) {
        EXPECT_FALSE(retriangulate(cloud));
        return;
      }
      if (const auto again = retriangulate(cloud)) expect_same(*again, mesh);
      expect_same(triangulate(cloud), mesh);
      begin_with(cloud, mesh, random);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Families, Retriangulated, ::testing::Range(0, families()));

Cloud<2> ring_of(double opening) {
  // a strip that is bent to a ring: its ends pass into each other when `opening` is negative
  Cloud<2> cloud;
  constexpr int along = 40, across = 4;
  cloud.piece_names = {"boundary"};
  const auto number = [](int a, int r) { return as<NodeIndex>(a * (across + 1) + r); };
  for (int a = 0; a <= along; ++a)
    for (int r = 0; r <= across; ++r) {
      const double angle = (6.283185307179586 - opening) * a / along, radius = 1.0 + 0.1 * r;
      cloud.position.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  std::vector<NodeIndex> loop;
  for (int r = 0; r < across; ++r) loop.push_back(number(0, r));
  for (int a = 0; a < along; ++a) loop.push_back(number(a, across));
  for (int r = across; r > 0; --r) loop.push_back(number(along, r));
  for (int a = along; a > 0; --a) loop.push_back(number(a, 0));
  for (std::size_t k = 0; k < loop.size(); ++k)
    cloud.facets.push_back({{loop[k], loop[(k + 1) % loop.size()]}, {}});
  for (int a = 0; a < along; ++a)
    for (int r = 0; r < across; ++r) {
      cloud.simplices.push_back({number(a, r), number(a, r + 1), number(a + 1, r + 1)});
      cloud.simplices.push_back({number(a, r), number(a + 1, r + 1), number(a + 1, r)});
    }
  return cloud;
}

TEST(Retriangulation, BodyThatOverlapsItselfIsLeftToTheOther) {
  const Cloud<2> open = ring_of(0.2);
  const auto mesh = retriangulate(open);
  ASSERT_TRUE(mesh);
  expect_same(*mesh, from_nothing(open));
  EXPECT_FALSE(retriangulate(ring_of(-0.2))); // no triangle has turned over
  EXPECT_THROW(triangulate(ring_of(-0.2)), GeometryError);
}

TEST(Retriangulation, PartInsideOfAnotherIsLeftToTheOther) {
  for (const double shift : {3.0, 0.5}) { // of two squares one beside the other, one in the other
    Cloud<2> cloud;
    testing::add_loop(cloud, testing::rectangle(1.2, 1.2), 5.0);
    testing::add_loop(cloud, testing::rectangle(0.2, 0.2), 5.0);
    for (std::size_t i = 4; i < 8; ++i) cloud.position[i] += Vec2(shift, 0.5);
    for (const std::int32_t first : {0, 4})
      for (const std::int32_t k : {1, 2})
        cloud.simplices.push_back(
            {as<NodeIndex>(first), as<NodeIndex>(first + k), as<NodeIndex>(first + k + 1)});
    EXPECT_EQ(retriangulate(cloud).has_value(), shift == 3.0);
  }
}

TEST(Retriangulation, ListsThatDoNotFitAreNoBeginning) {
  const Cloud<2> cloud = ring_of(0.2);
  const Triangulation mesh = from_nothing(cloud);
  const auto expect_none = [&](const auto& change) {
    Cloud<2> changed = cloud;
    change(changed.simplices);
    EXPECT_FALSE(retriangulate(changed));
    expect_same(triangulate(changed), mesh);
  };
  expect_none([](auto& list) { list.pop_back(); });
  expect_none([](auto& list) { list.push_back(list[0]); });
  expect_none([](auto& list) { list[3] = list[4]; });
  expect_none([](auto& list) { std::swap(list[7][0], list[7][1]); });
  expect_none([](auto& list) { list[7][0] = as<NodeIndex>(10000); });
  expect_none([](auto& list) { list[7][0] = NodeIndex::none; });
}

} // namespace
} // namespace cnem::voronoi::test
