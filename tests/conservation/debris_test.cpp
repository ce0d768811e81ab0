// Broken matter that flies apart keeps its nodes.
#include "adapt/plane/debris.hpp"
#include "tests/conservation/blank.hpp"

#include <gtest/gtest.h>

namespace cnem::adapt {
namespace {

/// Nodes after passes in which a blank grows to `times` its size; all of it has lost this share of its
/// stress.
std::size_t nodes_when_grown(double times, double lost) {
  constexpr double spacing = 0.1;
  constexpr int passes = 8;
  Blank b = blank(spacing);
  const double each = std::pow(times, 1.0 / passes);
  for (int pass = 1; pass <= passes; ++pass) {
    for (Vec2& x : b.cloud.position) x *= each;
    b.weigh(spacing);
    const double grown = std::pow(each, 2 * pass);
    b.node.jacobian.assign(b.node.mass.size(), grown);
    for (double& mass : b.node.mass) mass /= grown;
    b.node.broken.assign(b.node.mass.size(), lost);
    spread_debris(b.node);
    b.node.broken.clear(); // nothing is to be cut
    PassReport report;
    b.cloud = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report).cloud;
  }
  return b.cloud.position.size();
}

TEST(Debris, keeps_its_nodes_when_it_flies_apart) {
  const std::size_t before = blank(0.1).cloud.position.size(), debris = nodes_when_grown(5.0, 1.0),
                    whole = nodes_when_grown(5.0, 0.5);
  EXPECT_LT(debris, 2.5 * static_cast<double>(before))
      << "which is what they are at twice the volume, and some";
  EXPECT_GT(whole, 10.0 * static_cast<double>(before)) << "what holds together is filled up";
}

} // namespace
} // namespace cnem::adapt
