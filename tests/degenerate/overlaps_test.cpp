// What new triangles take of old ones on adversarial clouds whose nodes move: matter is shared out whole and
// fills the new triangles, however flat they are.
#include "voronoi/plane/overlaps.hpp"

#include "core/error.hpp"
#include "core/fields/aligned.hpp"
#include "core/index.hpp"
#include "tests/clouds.hpp"
#include "tests/degenerate/random_clouds.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace cnem::voronoi::test {
namespace {

constexpr std::uint32_t overlapped_seeds = 30;

using Corners = std::array<NodeIndex, 3>;

double area_of(const Cloud<2>& cloud, const Corners& n) {
  return 0.5 *
         cross(cloud.position[n[1]] - cloud.position[n[0]], cloud.position[n[2]] - cloud.position[n[0]]);
}

/// The square of the longest side.
double square_of(const Cloud<2>& cloud, const Corners& n) {
  double longest = 0.0;
  for (std::size_t c = 0; c < 3; ++c)
    longest = std::max(longest, (cloud.position[n[(c + 1) % 3]] - cloud.position[n[c]]).squaredNorm());
  return longest;
}

/// Moves each node by a part of the least height of its triangles, the faces of slits as one.
void stir(Cloud<2>& cloud, const Triangulation& mesh, double share, cnem::testing::Random& random) {
  Field reach(cloud.position.size(), 1e300);
  for (const Corners& corner : mesh.node)
    for (const NodeIndex i : corner)
      reach[index_of(i)] =
          std::min(reach[index_of(i)], 2.0 * area_of(cloud, corner) / std::sqrt(square_of(cloud, corner)));
  for (std::size_t i = 0; i < reach.size(); ++i)
    cloud.position[i] += share * reach[i] * Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
  for (const auto& [a, b] : cloud.twins) cloud.position[b] = cloud.position[a];
}

class Overlapped : public ::testing::TestWithParam<int> {};

TEST_P(Overlapped, share_out_all_matter) {
  std::size_t mixed = 0;
  for (std::uint32_t seed = 0; seed < overlapped_seeds; ++seed) {
    RandomCloud made = random_cloud(GetParam(), seed);
    SCOPED_TRACE(made.name);
    Cloud<2>& cloud = made.cloud;
    cnem::testing::Random random(seed);
    Triangulation old = triangulate(cloud);
    for (int k = 0; k < 5; ++k) {
      stir(cloud, old, 0.2 * (k + 1), random);
      if (!std::all_of(old.node.begin(), old.node.end(),
                       [&](const Corners& n) { return area_of(cloud, n) > 1e-9 * square_of(cloud, n); }))
        break; // one has turned over: a run has diverged
      Triangulation now;
      try {
        now = triangulate(cloud);
      } catch (const GeometryError&) { break; }
      const auto rows = overlaps(cloud.position, old.node, now.node);
      std::vector<double> given(old.node.size(), 0.0);
      for (const SimplexIndex t : now.node.indices()) {
        double sum = 0.0;
        for (auto e = index_of(rows.begin[index_of(t)]); e < index_of(rows.begin[index_of(t) + 1]); ++e) {
          ASSERT_GT(rows.weight[e], 0.0);
          given[index_of(rows.from[e])] += rows.weight[e];
          sum += rows.weight[e] * area_of(cloud, old.node[rows.from[e]]);
        }
        const double area = area_of(cloud, now.node[t]);
        ASSERT_NEAR(sum, area, 1e-9 * area + 1e-13 * square_of(cloud, now.node[t]));
        mixed += rows.mixed(index_of(t));
      }
      for (const double sum : given) ASSERT_NEAR(sum, 1.0, 1e-13);
      old = std::move(now);
    }
  }
  EXPECT_GT(mixed, 100U);
}

INSTANTIATE_TEST_SUITE_P(Families, Overlapped, ::testing::Range(0, families()));

} // namespace
} // namespace cnem::voronoi::test
