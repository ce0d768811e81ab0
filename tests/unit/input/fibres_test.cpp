// Bundles of fibres: the interfaces and regions that they are made of.
#include "tests/unit/input/case_text.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::input {
namespace {

/// A steel block from (0, 0) to (10, 5) mm with fibres in it.
Case with_fibres(const std::string& bundle) {
  return read_case_text(
      replaced(small_case, "[cloud]", "[domain.fibres.tow]\nmaterial = \"steel\"\n" + bundle + "\n[cloud]"),
      "case.toml", {});
}

TEST(Fibres, run_from_boundary_to_boundary_at_any_angle) {
  for (const double degrees : {0.0, 25.0, 45.0, 65.0, 90.0, 135.0, -30.0}) {
    const Case read = with_fibres(fmt::format("number = 2\nwidth = \"0.5 mm\"\npitch = \"1.2 mm\"\n"
                                              "centre = \"5 2.5 mm\"\nangle = \"{} deg\"",
                                              degrees));
    ASSERT_EQ(read.domain.interfaces.size(), 4U);
    ASSERT_EQ(read.domain.regions.size(), 2U);
    const double angle = degrees * std::numbers::pi / 180.0;
    const Vec2 along(std::cos(angle), std::sin(angle)), right(along.y(), -along.x());
    const double from_centre[] = {-0.85e-3, -0.35e-3, 0.35e-3, 0.85e-3};
    const Vec2 centre = Vec2(5e-3, 2.5e-3) - Vec2(read.origin.head<2>());
    for (std::size_t i = 0; i < 4; ++i) {
      const Interface& face = read.domain.interfaces[i];
      EXPECT_EQ(face.name, fmt::format("tow{}_{}", i / 2 + 1, i % 2 ? "right" : "left"));
      EXPECT_FALSE(face.cohesive);
      ASSERT_EQ(face.path.size(), 2U);
      EXPECT_NEAR((face.path[1] - face.path[0]).normalized().dot(along), 1.0, 1e-12) << degrees;
      for (const Vec2& end : face.path) {
        EXPECT_NEAR((end - centre).dot(right), from_centre[i], 1e-12) << degrees;
        const Vec2 off = (end - centre).cwiseAbs() - Vec2(5e-3, 2.5e-3);
        EXPECT_NEAR(std::max(off.x(), off.y()), 0.0, 1e-12) << degrees;
      }
    }
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(read.domain.regions[k].name, fmt::format("tow{}", k + 1));
      EXPECT_NEAR((read.domain.regions[k].at - centre).dot(right), k == 0 ? -0.6e-3 : 0.6e-3, 1e-12);
    }
  }
}

TEST(Fibres, separate_under_the_tractions_of_their_bundle) {
  const Case read = read_case_text(
      replaced(small_case, "[cloud]",
               "[domain.fibres.tow]\nmaterial = \"steel\"\nnumber = 1\nwidth = \"1 mm\"\npitch = \"1 mm\"\n"
               "centre = \"5 2 mm\"\ncohesive = { stiffness = \"38 GPa/mm\", strength = \"18 MPa\", energy = "
               "\"28 J/m2\" }\n[cloud]"),
      "case.toml", {"analysis.thermal=false"});
  ASSERT_EQ(read.domain.interfaces.size(), 2U);
  for (const Interface& face : read.domain.interfaces) {
    ASSERT_TRUE(face.cohesive);
    EXPECT_EQ(face.cohesive->strength, 18e6);
    EXPECT_EQ(face.cohesive->shear_energy, 28.0);
  }
  const Case again = read_case_text(read.resolved, "again.toml", {});
  EXPECT_EQ(again.domain.interfaces.size(), 2U);
  EXPECT_EQ(again.domain.interfaces[1].path, read.domain.interfaces[1].path);
}

} // namespace
} // namespace cnem::input
