// Broken parts of a cohesive interface: their length and how deep below the cut they lie.
#include "core/index.hpp"
#include "evaluate/debonding.hpp"

#include <gtest/gtest.h>

namespace cnem::evaluate {
namespace {

/// Two faces along x = 0 from y = −4 to 1, a node at each whole number.
TEST(Debonding, length_and_depth_are_those_of_what_is_broken) {
  Cloud<2> cloud;
  cloud.piece_names = {"j+", "j-"};
  constexpr std::size_t nodes = 6;
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t i = 0; i < nodes; ++i) cloud.position.push_back({0.0, -4.0 + static_cast<double>(i)});
  for (std::size_t i = 0; i + 1 < nodes; ++i) {
    cloud.facets.push_back({{as<NodeIndex>(i), as<NodeIndex>(i + 1)}, as<PieceIndex>(0)});
    cloud.facets.push_back({{as<NodeIndex>(nodes + i + 1), as<NodeIndex>(nodes + i)}, as<PieceIndex>(1)});
  }
  plasticity::CohesiveLaw law{
      .stiffness = 1e13, .strength = 18e6, .shear_strength = 18e6, .energy = 28.0, .shear_energy = 28.0};
  law.complete();
  const auto bonds = [&](std::vector<std::array<double, 2>> open) {
    const CohesiveFaces faces({{"j", law, {as<PieceIndex>(0), as<PieceIndex>(1)}, std::move(open)}}, cloud,
                              true);
    std::vector<Vec2> place(cloud.position.begin(), cloud.position.end());
    for (std::size_t i = 0; i < nodes; ++i) place[i].y() -= 0.25; // of the left face
    return look_at_bonds(faces, place);
  };
  EXPECT_EQ(bonds({}).length, 0.0);
  EXPECT_EQ(bonds({}).depth, 0.0);
  const Debonding deep = bonds({{2.0, 4.0}});
  EXPECT_NEAR(deep.length, 2.0, 1e-12);
  EXPECT_NEAR(deep.depth, 2.25, 1e-12);
  EXPECT_EQ(bonds({{4.0, 5.0}}).depth, 0.25) << "what is above the cut has no depth but where it is drawn in";
}

} // namespace
} // namespace cnem::evaluate
