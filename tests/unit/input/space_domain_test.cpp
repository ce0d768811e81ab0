// Workpieces in space as cases describe them: names of pieces, which of them are plane, bounds, places.
#include "input/case_reader.hpp"
#include "input/space_domain.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cnem::input {
namespace {

Case with_domain(const std::string& domain, const std::string& cloud = "") {
  return read_case_text(fmt::format(R"(
[analysis]
kinematics = "three-dimensional"
[time]
end = "1 us"
[domain]
material = "steel"
{}
[cloud]
spacing = "0.5 mm"
{}
[materials.steel]
density = "7850 kg/m3"
elastic = {{ young = "210 GPa", poisson = 0.3 }}
[method]
lagrangian = "total"
)",
                                    domain, cloud),
                        "case.toml");
}

std::string planes(const Domain& domain) {
  std::string text;
  for (const std::string& name : domain.piece_names())
    text += (text.empty() ? "" : " ") + name + (is_plane(domain, name) ? "|" : "");
  return text;
}

const std::string rectangle = "outer.rectangle = { from = \"0 0 mm\", to = \"4 2 mm\" }\n";

TEST(SpaceDomain, NamesItsPieces) {
  EXPECT_EQ(planes(with_domain("block = { from = \"0 0 0 mm\", to = \"1 2 3 mm\", grid = false }").domain),
            "y-| x+| y+| x-| z-| z+|");
  EXPECT_EQ(
      planes(with_domain(
                 "block = { shape = \"cylinder\", radius = \"2 mm\", inner_radius = \"1 mm\", length = \"1 "
                 "mm\", part = \"quarter\", grid = false }")
                 .domain),
      "y-| side x-| inside bottom| top|");
  EXPECT_EQ(
      planes(with_domain("block = { shape = \"sphere\", radius = \"2 mm\", part = \"eighth\" }").domain),
      "z-| side y-| x-|");
  EXPECT_EQ(planes(with_domain("block = { shape = \"sphere\", radius = \"2 mm\", part = \"half\" }").domain),
            "side y-|");
  EXPECT_EQ(
      planes(with_domain(rectangle + "holes.bore.circle = { centre = \"2 1 mm\", radius = \"0.5 mm\" }\n"
                                     "extrude = { to = \"1 mm\", high = \"lid\" }")
                 .domain),
      "bottom| right| top| left| bore z-| lid|");
  EXPECT_EQ(planes(with_domain(rectangle + "revolve.angle = \"90 deg\"").domain),
            "bottom| right top| theta-| theta+|");
  EXPECT_EQ(planes(with_domain(rectangle + "revolve = {}").domain), "bottom| right top|");
}

TEST(SpaceDomain, KnowsWhereItIs) {
  const Domain turned =
      with_domain(rectangle + "revolve = { angle = \"180 deg\", origin = \"0 0 1 mm\" }").domain;
  const auto [low, high] = space_bounds(turned);
  EXPECT_LT((low - Vec3(-4e-3, 0, 1e-3)).norm(), 1e-12);
  EXPECT_LT((high - Vec3(4e-3, 4e-3, 3e-3)).norm(), 1e-12);
  EXPECT_EQ(outside_reason_in_space(turned, {-1e-3, 1e-3, 2e-3}), "");
  EXPECT_NE(outside_reason_in_space(turned, {-1e-3, -1e-3, 2e-3}), "");
  EXPECT_NE(outside_reason_in_space(turned, {3.9e-3, 3.9e-3, 2e-3}), "");
  const Domain shell =
      with_domain(
          "block = { shape = \"sphere\", radius = \"2 mm\", inner_radius = \"1 mm\", centre = \"1 0 0 mm\" }")
          .domain;
  EXPECT_EQ(outside_reason_in_space(shell, {2.5e-3, 0, 0}), "");
  EXPECT_EQ(outside_reason_in_space(shell, {1.5e-3, 0, 0}), "outside domain.block");
}

TEST(SpaceDomain, IsRefinedInSpace) {
  const Case fine =
      with_domain("block = { from = \"0 0 0 mm\", to = \"4 2 2 mm\", grid = false }",
                  "refine.a = { points = [\"4 2 1 mm\"], factor = 0.25 }\n"
                  "refine.b = { box = [\"0 0 0 mm\", \"1 1 1 mm\"], spacing = \"0.2 mm\", growth = 0.5 }");
  ASSERT_EQ(fine.cloud.space_refinements.size(), 2u);
  EXPECT_EQ(fine.cloud.space_refinements[0].points.front(), Vec3(4e-3, 2e-3, 1e-3));
  EXPECT_DOUBLE_EQ(fine.cloud.space_refinements[0].spacing, 0.125e-3);
  EXPECT_DOUBLE_EQ(fine.cloud.space_refinements[1].growth, 0.5);
}

TEST(SpaceDomain, FarAwayIsCountedFromAnOriginOfItsOwn) {
  const auto at = [](const std::string& x) {
    return with_domain(rectangle + "revolve = { angle = \"90 deg\", origin = \"" + x + " 0 0 mm\" }",
                       "refine.a = { points = [\"" + x + " 0 0 mm\"], factor = 0.5 }");
  };
  const Case near = at("0"), far = at("1e6");
  EXPECT_EQ(near.origin, Vec3(0, 0, 0));
  EXPECT_GT(far.origin.x(), 900.0);
  EXPECT_LT((far.domain.sweep->origin + far.origin - Vec3(1e3, 0, 0)).norm(), 1e-9);
  EXPECT_LT((far.cloud.space_refinements[0].points[0] + far.origin - Vec3(1e3, 0, 0)).norm(), 1e-9);
  EXPECT_EQ(far.domain.outer.pieces[0].to, near.domain.outer.pieces[0].to);
}

} // namespace
} // namespace cnem::input
