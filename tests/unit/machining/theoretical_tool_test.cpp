#include "machining/structure/theoretical_tool.hpp"

#include "tests/unit/machining/benchmarks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace cnem::machining {

TEST(TheoreticalTool, TakesWhatARigidCutterHasPassed) {
  const PartSupport held{.axis = 1};
  // A side cut 5 mm along x, 0.5 mm deep, through the upper cells of a block of 20 × 2 × 4 mm.
  const Part part(
      {.size = Vec3(20e-3, 2e-3, 4e-3), .divisions = {10, 2, 2}, .materials = {{1.0, 0.3, 1.0}}, .zones = {}},
      PartElement::hexahedron_8, {&held, 1});
  MillingCut cut = milling_cut(3, 600e6, 0.0, Engagement::Side::down, 0.5 / 12.0);
  const ProcessSettings settings{.spindle = 800.0,
                                 .axial_depth = 2e-3,
                                 .length = 5e-3,
                                 .start = ProcessSettings::Start::hole,
                                 .pitch = 1e-4,
                                 .layers = 2,
                                 .steps = 360};
  MillingProcess rigid(cut, {}, settings);
  const std::int64_t end_step = rigid.motion().passes().back().end;
  // The machined side, at the height of the tip: y = 1.5, z = 2 mm in the part.
  const Vec3 origin(0.0, 1.5e-3 + cut.cutter.radius(), 2e-3);
  const TheoreticalTool tool(part, std::move(rigid), [&](const Vec3& x) { return Vec3(x - origin); },
                             {.interval = 200, .most = 0.9});
  double before = 2.0;
  for (const double share : {0.0, 0.3, 0.6, 1.0}) {
    double sum = 0.0;
    for (const double presence : tool.presence(std::llround(share * static_cast<double>(end_step))))
      sum += presence;
    EXPECT_LT(sum, before * static_cast<double>(part.cells()));
    before = sum / static_cast<double>(part.cells());
  }
  for (std::size_t c = 0; c < part.cells(); ++c) {
    const bool outer = part.low(c).y() > 0.5e-3 && part.low(c).z() > 1e-3;
    const double end = tool.presence(end_step)[c];
    // Half of the outer upper cells is gone where the axis has been, nothing beyond where the disc reaches.
    const double reach = 5e-3 + 3.12e-3 - part.low(c).x(); // of the disc into the cell
    if (!outer || reach < 0.0)
      EXPECT_EQ(end, 1.0) << c;
    else if (reach < 0.2e-3) // by a sliver that may fall between dexels
      EXPECT_NEAR(end, 1.0, 1e-3) << c;
    else if (part.high(c).x() < 4.1e-3)
      EXPECT_NEAR(end, 1.0 - 0.9 * 0.5, 1e-12) << c;
    else // under the disc at the end
      EXPECT_TRUE(end >= 1.0 - 0.9 * 0.5 && end < 1.0) << c;
  }
}

namespace {

/// Corner k lies beyond along x, y, z where bits 1, 2, 4 of k are set.
TriangleSurface box_surface(const Vec3& low, const Vec3& high) {
  TriangleSurface surface;
  for (unsigned k = 0; k < 8; ++k)
    surface.points.emplace_back((k & 1U ? high : low).x(), (k & 2U ? high : low).y(),
                                (k & 4U ? high : low).z());
  constexpr std::array<std::array<std::int32_t, 4>, 6> faces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : faces) {
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a, c, d});
  }
  return surface;
}

} // namespace

TEST(TheoreticalTool, TakesNothingBesideTheSurfaceOfItsWorkpiece) {
  const PartSupport held{.axis = 1};
  const Part part(
      {.size = Vec3(20e-3, 2e-3, 4e-3), .divisions = {10, 2, 2}, .materials = {{1.0, 0.3, 1.0}}, .zones = {}},
      PartElement::hexahedron_8, {&held, 1});
  MillingCut cut = milling_cut(3, 600e6, 0.0, Engagement::Side::up, 0.5 / 12.0);
  cut.feed = 2e-4;
  // Teeth reach y = 0.75 mm of what begins at 0.5 mm in a box from 0.
  const Vec2 from(-10e-3, 0.75e-3 - cut.cutter.radius()), to(32e-3, from.y());
  ProcessSettings settings{.spindle = 800.0,
                           .axial_depth = 2e-3,
                           .start = ProcessSettings::Start::outside,
                           .pitch = 1e-4,
                           .layers = 2,
                           .steps = 360,
                           .passes = {ToolPath({CurvePiece{.from = from, .to = to, .name = ""}})},
                           .blank = Blank{.low = Vec2::Zero(),
                                          .high = Vec2(20e-3, 2e-3),
                                          .height = 2e-3,
                                          .surface = box_surface({0.0, 0.5e-3, 0.0}, {20e-3, 2e-3, 2e-3})}};
  MillingProcess rigid(cut, {}, settings);
  const std::int64_t end_step = rigid.motion().passes().back().end;
  const TheoreticalTool tool(part, std::move(rigid),
                             [](const Vec3& x) { return Vec3(x - 2e-3 * Vec3::UnitZ()); },
                             {.interval = 5000, .most = 0.9});
  for (std::size_t c = 0; c < part.cells(); ++c) {
    const bool outer = part.low(c).y() < 0.5e-3 && part.low(c).z() > 1e-3;
    EXPECT_EQ(tool.presence(0)[c], 1.0) << c;
    // Points at 9/16 and 11/16 mm of eight across the cell.
    EXPECT_NEAR(tool.presence(end_step)[c], outer ? 1.0 - 0.9 * 0.25 : 1.0, 1e-12) << c;
  }
}

TEST(TheoreticalTool, TakesLayersThatAreNotEquallyThick) {
  const PartSupport held{.axis = 1};
  const Part part(
      {.size = Vec3(4e-3, 2e-3, 2e-3), .divisions = {2, 1, 4}, .materials = {{1.0, 0.3, 1.0}}, .zones = {}},
      PartElement::hexahedron_8, {&held, 1});
  MillingCut cut = milling_cut(3, 600e6, 0.0, Engagement::Side::down, 1.0 / 12.0);
  cut.feed = 2e-4;
  const auto past = [](double y, double tip) {
    return ToolPath({CurvePiece{.from = Vec2(-8e-3, y), .to = Vec2(12e-3, y), .name = ""}}, tip);
  };
  // Half of the width over 0.5 mm; then, in the air, the tip at 0: layers from 0 to 0.5 and to 2 mm.
  MillingProcess rigid(cut, {},
                       {.spindle = 800.0,
                        .axial_depth = 2e-3,
                        .start = ProcessSettings::Start::outside,
                        .pitch = 1e-4,
                        .layers = 1,
                        .steps = 90,
                        .passes = {past(7e-3, 0.5e-3), past(9e-3, 0.0)},
                        .blank = Blank{.low = Vec2::Zero(), .high = Vec2(4e-3, 2e-3), .height = 2e-3}});
  ASSERT_EQ(rigid.slices().size(), 2u);
  const std::int64_t end_step = rigid.motion().passes().back().end;
  const TheoreticalTool tool(part, std::move(rigid), [](const Vec3& x) { return x; },
                             {.interval = 1000, .most = 0.9});
  for (std::size_t c = 0; c < part.cells(); ++c)
    EXPECT_NEAR(tool.presence(end_step)[c], part.low(c).z() > 0.4e-3 ? 1.0 - 0.9 * 0.5 : 1.0, 1e-12) << c;
}

} // namespace cnem::machining
