// What [cutting] makes of a case.
#include "input/curve_checks.hpp"
#include "tests/unit/input/case_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::input {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

const std::string cut = R"([cutting]
feed = "0.4 mm"
width = "4 mm"
rake = "17.5 deg"
clearance = "7 deg"
edge_radius = "20 um"
speed = "800 m/min"
length = "10 mm"
friction = { law = "coulomb", coefficient = 0.17 }

[domain]
material = "A2024"

[materials.A2024]
density = "2700 kg/m3"
elastic = { young = "70 GPa", poisson = 0.33 }
plastic = { law = "perfect", yield = "440 MPa" }
)";

const std::string land =
    replaced(cut, "edge_radius = \"20 um\"\n", "chamfer = { width = \"0.1 mm\", angle = \"40 deg\" }\n");

Case read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_case_text(text, "case.toml", overrides);
}

std::string body(const std::string& resolved) { return resolved.substr(resolved.find('\n')); }

/// Points of the outline of a tool that are no higher than `height`.
std::vector<Vec2> below(const Curve& outline, double height) {
  std::vector<Vec2> points;
  for (const CurvePiece& piece : outline.pieces)
    for (int k = 0; k <= 100000; ++k)
      if (const Vec2 x = piece.point(k / 100000.0); x.y() <= height) points.push_back(x);
  return points;
}

TEST(Cutting, IsKeptInTheCase) {
  const Case c = read(cut);
  ASSERT_TRUE(c.cutting);
  EXPECT_EQ(c.cutting->tool, "cutter");
  EXPECT_DOUBLE_EQ(c.cutting->feed, 4e-4);
  EXPECT_DOUBLE_EQ(c.cutting->width, 4e-3);
  EXPECT_DOUBLE_EQ(c.cutting->rake, 17.5 * degree);
  EXPECT_DOUBLE_EQ(c.cutting->clearance, 7 * degree);
  EXPECT_DOUBLE_EQ(c.cutting->edge_radius, 2e-5);
  EXPECT_DOUBLE_EQ(c.cutting->speed, 800.0 / 60.0);
  EXPECT_DOUBLE_EQ(c.cutting->length, 0.01);
  EXPECT_FALSE(c.cutting->exit);
  EXPECT_FALSE(read_small().cutting);
}

TEST(Cutting, MakesAWholeCase) {
  const Case c = read(cut);
  EXPECT_DOUBLE_EQ(c.time.end, 0.01 / (800.0 / 60.0));
  const auto [low, high] = bounds(c.domain.outer);
  EXPECT_NEAR(high.y(), 4e-4, 1e-15) << "the uncut surface; the machined one is at 0";
  EXPECT_NEAR(low.y(), -2e-3, 1e-15);
  EXPECT_EQ(low.x(), 0.0);
  EXPECT_GT(high.x(), 0.01 + 4 * 4e-4) << "the support is beyond the shear zone";
  ASSERT_EQ(c.boundary.size(), 1U);
  EXPECT_EQ(c.boundary[0].pieces, (std::vector<std::string>{"bottom", "right"}));
  ASSERT_EQ(c.tools.size(), 1U);
  EXPECT_EQ(c.tools[0].velocity[0]->values().front(), 800.0 / 60.0);
  EXPECT_DOUBLE_EQ(c.adapt.tool_spacing.value(), std::sqrt(2e-5 * 4e-4) / 30.0 * (1.0 + 2.0 * 0.17));
  EXPECT_DOUBLE_EQ(c.adapt.surface_spacing.value(), 4e-4 / 17.0);
  EXPECT_DOUBLE_EQ(c.adapt.rest_factor, 1.5);
  EXPECT_TRUE(c.tools[0].equal_areas);
  EXPECT_DOUBLE_EQ(c.time.mass_scaling->cell, 8e-6) << "a fiftieth of the feed";
  const Case sharp = read(cut, {"cutting.edge_radius=2 um"});
  EXPECT_DOUBLE_EQ(sharp.time.mass_scaling->cell, 4.0 * sharp.adapt.tool_spacing.value())
      << "four cells at the edge";
  const Case heavy = read(cut, {"time.mass_scaling.factor=10"});
  EXPECT_EQ(heavy.time.mass_scaling->cell, 0.0);
  EXPECT_DOUBLE_EQ(c.method.pressure_exchange, 2.0);
  EXPECT_DOUBLE_EQ(c.method.stress_annealing, 1.0);
  EXPECT_TRUE(c.adapt.resample);
  EXPECT_DOUBLE_EQ(c.adapt.h_min, 2e-5) << "a twentieth of the feed";
  EXPECT_STREQ(c.adapt.indicator->name, "plastic_power");
  EXPECT_TRUE(c.contact.active);
  EXPECT_LT(c.cloud.at({5e-3, 2e-4}), 1.01 * 8e-5) << "a fifth of the feed in the layer";
  EXPECT_GT(c.cloud.at({5e-3, -1.9e-3}), 1.9e-4) << "coarse below";
  EXPECT_FALSE(c.output.windows.empty());
}

TEST(Cutting, CellsAtTheEdgeFollowRadiusAndFriction) {
  const auto spacing = [](const char* radius, const char* friction) {
    return read(cut, {fmt::format("cutting.edge_radius={}", radius), friction}).adapt.tool_spacing.value();
  };
  const char* smooth = "cutting.friction={ law = \"none\" }";
  const double of_20 = std::sqrt(2e-5 * 4e-4) / 30.0;
  EXPECT_DOUBLE_EQ(spacing("20 um", smooth), of_20);
  EXPECT_DOUBLE_EQ(spacing("20 um", "cutting.friction.coefficient=0.5"), 2.0 * of_20);
  EXPECT_DOUBLE_EQ(spacing("20 um", "cutting.friction.coefficient=0.9"), 2.0 * of_20) << "no wider than that";
  EXPECT_DOUBLE_EQ(spacing("2 um", "cutting.friction.coefficient=0.5"), 1e-6) << "half the radius";
  EXPECT_DOUBLE_EQ(spacing("1 um", "cutting.friction.coefficient=0.5"), std::sqrt(1e-6 * 4e-4) / 30.0);
}

/// The outline of a rounded tool: lowest point, angles of its faces, and where it meets the workpiece.
void expect_tool(const Case& c, std::size_t arcs) {
  const CuttingSetup& setup = *c.cutting;
  const Curve& outline = c.tools[0].outline;
  const std::vector<Vec2> low = below(outline, setup.feed);
  const auto by = [](auto component) {
    return [component](const Vec2& a, const Vec2& b) { return component(a) < component(b); };
  };
  const auto x = [](const Vec2& p) { return p.x(); };
  const auto y = [](const Vec2& p) { return p.y(); };
  EXPECT_NEAR(std::min_element(low.begin(), low.end(), by(y))->y(), 0.0, 1e-12) << "cuts at the feed";
  EXPECT_NEAR(std::max_element(low.begin(), low.end(), by(x))->x(), 0.0, 1e-3 * setup.feed) << "just touches";
  std::size_t rounded = 0;
  bool rake = false, clearance = false;
  for (const CurvePiece& piece : outline.pieces) {
    rounded += piece.is_arc();
    if (piece.is_arc()) {
      EXPECT_DOUBLE_EQ(piece.radius, setup.edge_radius);
      continue;
    }
    const Vec2 t = piece.tangent(0.0); // counter-clockwise: along the flank down, along the rake face up
    rake |= std::abs(std::atan2(-t.x(), t.y()) - setup.rake) < 1e-9;
    clearance |= std::abs(std::atan2(-t.y(), t.x()) - setup.clearance) < 1e-9;
  }
  EXPECT_EQ(rounded, arcs);
  EXPECT_TRUE(rake);
  EXPECT_TRUE(clearance);
}

TEST(Cutting, DrawsTheTool) {
  for (const char* rake : {"17.5 deg", "0 deg", "-10 deg", "40 deg", "-45 deg"})
    for (const char* clearance : {"7 deg", "0 deg", "25 deg"}) {
      SCOPED_TRACE(fmt::format("{} {}", rake, clearance));
      expect_tool(
          read(cut, {fmt::format("cutting.rake={}", rake), fmt::format("cutting.clearance={}", clearance)}),
          1);
    }
}

TEST(Cutting, DrawsAChamfer) {
  for (const char* rake : {"17.5 deg", "-10 deg", "45 deg"}) {
    SCOPED_TRACE(rake);
    const Case c = read(land, {fmt::format("cutting.rake={}", rake)});
    expect_tool(c, 2);
    EXPECT_DOUBLE_EQ(c.cutting->edge_radius, 2e-5) << "a fifth of the land";
    EXPECT_NE(c.resolved.find("edge_radius = \"2"), std::string::npos);
  }
}

TEST(Cutting, LeavesThroughAFreeEnd) {
  const Case c = read(cut, {"cutting.exit=true"});
  EXPECT_EQ(c.boundary[0].pieces, std::vector<std::string>{"bottom"});
  EXPECT_DOUBLE_EQ(bounds(c.domain.outer)[1].x(), 0.01);
  EXPECT_GT(c.time.end * c.cutting->speed, 0.01 + 4e-4) << "and is out at the end";
  EXPECT_DOUBLE_EQ(bounds(c.domain.outer)[0].y(), -2e-3);
  const Case brief = read(cut, {"cutting.exit=true", "cutting.length=1 mm"});
  EXPECT_DOUBLE_EQ(bounds(brief.domain.outer)[0].y(), -5e-4) << "no pillar";
}

TEST(Cutting, GivesWayToWhatTheCaseSays) {
  const Case given = read(cut, {"tools.cutter.friction.coefficient=0.3", "tools.cutter.equal_areas=false",
                                "cloud.refine.layer.spacing=50 um", "time.end=1 us",
                                "boundary.bed.pieces=bottom", "adapt.indicator.h_min=30 um",
                                "output.pictures=0.5 us", "domain.outer.rectangle.to=5 0.4 mm"});
  const Case plain = read(cut);
  EXPECT_DOUBLE_EQ(given.tools[0].friction.bound({}).coefficient, 0.3);
  EXPECT_FALSE(given.tools[0].equal_areas);
  EXPECT_EQ(given.tools[0].outline.pieces.size(), plain.tools[0].outline.pieces.size());
  EXPECT_DOUBLE_EQ(given.cloud.at({1e-3, 2e-4}), 5e-5);
  EXPECT_EQ(given.time.end, 1e-6);
  EXPECT_EQ(given.boundary[0].pieces, std::vector<std::string>{"bottom"});
  EXPECT_EQ(given.boundary[0].velocity[0]->values().front(), 0.0);
  EXPECT_DOUBLE_EQ(given.adapt.h_min, 3e-5);
  EXPECT_EQ(given.adapt.h_max, plain.adapt.h_max);
  EXPECT_EQ(given.output.pictures, std::vector<double>{5e-7});
  EXPECT_DOUBLE_EQ(bounds(given.domain.outer)[1].x(), 5e-3);
  EXPECT_DOUBLE_EQ(bounds(given.domain.outer)[0].y(), bounds(plain.domain.outer)[0].y());
  EXPECT_TRUE(given.output.windows.empty()) << "the one of the end of the cut may show nothing of it";
}

TEST(Cutting, GivesWayAsAWholeWhereKeysExcludeEachOther) {
  const Case round =
      read(cut, {"tools.cutter.circle={ centre = \"-2 2 mm\", radius = \"1 mm\" }",
                 "tools.cutter.friction.law=none", "cloud.refine.layer.points=[\"0 0.2 mm\", \"5 0.2 mm\"]"});
  EXPECT_TRUE(round.tools[0].outline.pieces[0].is_arc());
  EXPECT_FALSE(round.report.cutting);
  EXPECT_EQ(round.tools[0].friction.bound({}).coefficient, 0.0);
  EXPECT_DOUBLE_EQ(round.cloud.at({1e-3, 2e-4}), 8e-5);
  const Case still = read(cut, {"adapt.resample=false"});
  EXPECT_FALSE(still.adapt.tool_spacing);
  EXPECT_FALSE(still.adapt.surface_spacing);
  EXPECT_EQ(still.adapt.rest_factor, 0.0);
  EXPECT_EQ(still.adapt.indicator, nullptr);
}

TEST(Cutting, NamesItsToolAndReportsOfIt) {
  const Case c = read(cut, {"cutting.tool=insert"});
  ASSERT_TRUE(c.report.cutting);
  EXPECT_DOUBLE_EQ(c.report.cutting->feed, c.cutting->feed);
  EXPECT_DOUBLE_EQ(c.report.cutting->width, c.cutting->width);
  EXPECT_EQ(c.tools[0].name, "insert");
  EXPECT_EQ(c.cutting->tool, "insert");
}

TEST(Cutting, ResolvedCaseKeepsItAndReadsBack) {
  for (const std::string& text : {cut, land}) {
    const Case first = read(text, {"tools.cutter.friction.law=none", "adapt.growth=0.2"});
    const Case second = read_case_text(first.resolved, "case.resolved.toml");
    EXPECT_EQ(body(first.resolved), body(second.resolved));
    expect_parts(first.resolved, {"[cutting]\n", "feed = \"0.0004 m\"", "[tools.cutter]", "[boundary.bed]"});
    ASSERT_TRUE(second.cutting);
    EXPECT_EQ(second.cutting->rake, first.cutting->rake);
    EXPECT_EQ(second.tools[0].outline.pieces[1].to, first.tools[0].outline.pieces[1].to);
    EXPECT_EQ(second.time.end, first.time.end);
  }
}

TEST(Cutting, SaysWhereAMistakeInItsKeysComesFrom) {
  expect_parts(refusal_of(cut + "[boundary.foot]\npieces = \"bottom\"\nvelocity = \"1 0 m/s\"\n"),
               {"from [cutting]"});
  expect_parts(refusal_of("cutting = 3\n" + small_case),
               {"case.toml:1:11: key 'cutting': found 3, expected a table"});
}

} // namespace
} // namespace cnem::input
