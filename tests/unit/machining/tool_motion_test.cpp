// Paths of lines and arcs, several passes, speeds and feeds that change, blanks.
#include "machining/tool_motion.hpp"

#include "core/error.hpp"
#include "machining/milling_process.hpp"
#include "tests/unit/machining/benchmarks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cnem::machining {
namespace {

using enum Engagement::Side;

CurvePiece line(const Vec2& from, const Vec2& to) { return {.from = from, .to = to, .name = ""}; }

TEST(ToolPath, GoesAlongLinesAndArcs) {
  const double r = 2e-3, quarter = 0.25 * full_turn * r;
  CurvePiece arc{
      .from = Vec2(3e-3, 0.0), .to = Vec2(5e-3, 2e-3), .centre = Vec2(3e-3, 2e-3), .radius = r, .name = ""};
  const ToolPath path({line(Vec2::Zero(), arc.from), arc});
  EXPECT_NEAR(path.length(), 3e-3 + quarter, 1e-15);
  EXPECT_NEAR((path.at(1e-3).at - Vec2(1e-3, 0.0)).norm(), 0.0, 1e-15);
  const auto [at, along] = path.at(3e-3 + 0.5 * quarter);
  EXPECT_NEAR((at - (arc.centre + r * Vec2(std::sqrt(0.5), -std::sqrt(0.5)))).norm(), 0.0, 1e-15);
  EXPECT_NEAR((along - Vec2(std::sqrt(0.5), std::sqrt(0.5))).norm(), 0.0, 1e-12);
  EXPECT_NEAR((path.at(1.0).at - arc.to).norm(), 0.0, 1e-15) << "it ends there";
}

TEST(ToolMotion, TimeIsThatOfARampOfTheSpeed) {
  // Ω = Ω₀ + a t: φ = Ω₀ t + a t²/2.
  const double slow = 100.0, fast = 300.0, end = 0.5, a = (fast - slow) / end;
  const DriveTables drive{TimeTable({0.0, end}, {slow, fast}), TimeTable(1e-4)};
  constexpr int steps = 72;
  const ToolMotion motion(fast, 1e-4 * 3 * fast / full_turn, steps,
                          {ToolPath({line(Vec2::Zero(), Vec2(2e-3, 0.0))})}, 2.0, drive, 3);
  for (const std::int64_t step : {1, 40, 200, 400}) {
    const double angle = static_cast<double>(step) * full_turn / steps;
    EXPECT_NEAR(motion.time(step), (std::sqrt(slow * slow + 2.0 * a * angle) - slow) / a, 1e-14);
    EXPECT_NEAR(motion.axis(0, static_cast<double>(step)).x(), 3e-4 * static_cast<double>(step) / steps,
                1e-16)
        << "the feed of a tooth is what it is";
  }
  EXPECT_EQ(motion.fed(), 480.0) << "2 mm of 0.3 mm a turn";
  EXPECT_FALSE(motion.at_end(480 + 2 * steps - 1)) << "and two turns without feed";
  EXPECT_TRUE(motion.at_end(480 + 2 * steps));
  EXPECT_FALSE(motion.steady());
  const ToolMotion straight(fast, 1e-4 * 3 * fast / full_turn, steps, -1e-3, 2e-3, 2.0, drive, 3);
  EXPECT_EQ(straight.time(400), motion.time(400));
  EXPECT_EQ(straight.fed(), motion.fed());
  EXPECT_NEAR(straight.axis(0, 480.0).x(), 1e-3, 1e-16);
}

TEST(ToolMotion, ForcesFollowTheFeedAndVibrationsTheSpeed) {
  // A feed that doubles half-way, and a mode that the teeth meet at the second of two speeds.
  MillingCut cut = milling_cut(2, 767e6, 0.0, down, 0.25);
  cut.feed = 2e-4;
  Mode mode{.of = Mode::Of::tool,
            .frequency = 2.0 * 900.0 / full_turn,
            .damping = 0.05,
            .stiffness = 5e7,
            .direction = Vec3::UnitY()};
  const double turn = full_turn / 900.0;
  MillingProcess process(cut, {mode},
                         {.spindle = 900.0,
                          .axial_depth = 1e-3,
                          .length = 12e-3,
                          .pitch = 1e-4,
                          .layers = 1,
                          .steps = 180,
                          .drive = DriveTables{TimeTable({0.0, 40 * turn, 41 * turn}, {500.0, 500.0, 900.0}),
                                               TimeTable({0.0, 20 * turn, 21 * turn}, {1e-4, 1e-4, 2e-4})}});
  double thin = 0.0, thick = 0.0, slow = 0.0, fast = 0.0;
  while (!process.at_end()) {
    const ProcessStep step = process.advance();
    const double t = step.time / turn;
    if (t > 10.0 && t < 20.0) thin = std::max(thin, step.removed);
    if (t > 25.0 && t < 40.0)
      thick = std::max(thick, step.removed), slow = std::max(slow, step.displacement.norm());
    if (t > 50.0) fast = std::max(fast, step.displacement.norm());
  }
  EXPECT_NEAR(thick / thin, 2.0, 0.03);
  EXPECT_GT(fast, 2.0 * slow) << "resonance";
  EXPECT_LT(process.ledger().share(), 1e-3);
}

/// m³ that stay on 20 mm of a surface of 1 mm: f²/8R high, a third of that in the mean.
constexpr double scallops = 2e-4 * 2e-4 / (24.0 * 6e-3) * 20e-6;

/// A block of 20 × 10 mm beside y = 0, cut by a cutter whose teeth reach y = 1 mm.
MillingCut side_cut() {
  MillingCut cut = milling_cut(3, 767e6, 168.8e6, up, 1.0 / 12.0);
  cut.feed = 2e-4;
  return cut;
}
ToolPath along(double y, double from = -10e-3, double to = 32e-3) {
  return ToolPath({line(Vec2(from, y), Vec2(to, y))});
}
ProcessSettings through(std::vector<ToolPath> passes) {
  return {.spindle = 800.0,
          .axial_depth = 1e-3,
          .start = ProcessSettings::Start::outside,
          .pitch = 1e-4,
          .layers = 2,
          .steps = 360,
          .passes = std::move(passes),
          .blank = Blank{.low = Vec2(0.0, 0.0), .high = Vec2(20e-3, 10e-3), .height = 1e-3}};
}

TEST(Passes, APassTakesWhatLiesInItsWay) {
  MillingProcess process(side_cut(), {}, through({along(1e-3 - 6e-3)}));
  EXPECT_NEAR(process.block(), 20e-3 * 10e-3 * 1e-3, 1e-15);
  double removed = 0.0, first = 0.0, last = 0.0;
  while (!process.at_end()) {
    const double x = process.axis().x();
    const ProcessStep step = process.advance();
    removed += step.removed;
    if (step.removed > 0.0 && first == 0.0) first = x;
    if (step.removed > 0.0) last = x;
  }
  EXPECT_NEAR(removed, process.block() - process.volume(), 1e-16);
  EXPECT_NEAR(removed, 20e-9 - scallops, 0.01 * scallops);
  // Entry and exit: the corner of the block is reached at x = −√(R² − 5²) mm; behind its end only scallops
  // are left.
  EXPECT_NEAR(first, -std::sqrt(36.0 - 25.0) * 1e-3, 7e-4);
  EXPECT_NEAR(last, 20e-3, 7e-4);
  EXPECT_NEAR(process.left_beside(0, 20e-3, process.stock(0)).value(), 0.0, 1e-5);
  EXPECT_FALSE(process.left_beside(0, 5e-3, process.stock(0))) << "beside the block";
}

TEST(Passes, TheNextOneCutsWhatTheLastOneLeft) {
  Mode soft{
      .of = Mode::Of::tool, .frequency = 900.0, .damping = 0.1, .stiffness = 2e6, .direction = Vec3::UnitY()};
  std::array<double, 2> spring{};
  for (const bool flexible : {false, true}) {
    const std::vector<Mode> modes = flexible ? std::vector<Mode>{soft} : std::vector<Mode>{};
    MillingProcess process(side_cut(), modes, through({along(-5.2e-3), along(-5e-3), along(-5e-3)}));
    ASSERT_EQ(process.motion().passes().size(), 3U);
    std::array<double, 3> removed{};
    while (!process.at_end()) {
      const std::size_t pass = process.motion().pass_of(process.steps());
      removed[pass] += process.advance().removed;
    }
    spring[flexible] = removed[2];
    if (flexible) {
      EXPECT_LT(removed[0], 0.8e-3 * 20e-6 - 4.0 * scallops) << "the tool is pushed off";
      EXPECT_LT(process.ledger().share(), 1e-4);
    } else {
      EXPECT_NEAR(removed[0], 0.8e-3 * 20e-6 - scallops, 0.01 * scallops);
      EXPECT_NEAR(removed[1], 0.2e-3 * 20e-6, 0.01 * scallops);
    }
    EXPECT_NEAR(removed[0] + removed[1] + removed[2], process.block() - process.volume(), 1e-16);
  }
  EXPECT_LT(spring[0], 0.1 * scallops) << "a stiff cutter finds nothing but scallops between its trochoids";
  EXPECT_GT(spring[1], 10.0 * spring[0]) << "the spring pass takes what the others were pushed off from";
}

TEST(Passes, AnArcIsCutAsASlotAroundIt) {
  // A quarter of a ring of 20 mm in a block that holds it, from edge to edge.
  MillingCut cut = milling_cut(3, 767e6, 0.0, down, 1.0);
  cut.feed = 2e-4;
  const double ring = 20e-3;
  CurvePiece arc{
      .from = Vec2(ring, 0.0), .to = Vec2(0.0, ring), .centre = Vec2::Zero(), .radius = ring, .name = ""};
  ProcessSettings settings =
      through({ToolPath({line(Vec2(ring, -8e-3), arc.from), arc, line(arc.to, Vec2(-8e-3, ring))})});
  settings.blank = Blank{.low = Vec2::Zero(), .high = Vec2(30e-3, 30e-3), .height = 1e-3};
  settings.layers = 1;
  MillingProcess process(cut, {}, settings);
  double power = 0.0, removed = 0.0;
  while (!process.at_end()) {
    const ProcessStep step = process.advance();
    removed += step.removed;
    power += step.power * full_turn / 800.0 / 360.0;
  }
  const double slot = 0.125 * full_turn * (26e-3 * 26e-3 - 14e-3 * 14e-3) * 1e-3;
  EXPECT_NEAR(removed / slot, 1.0, 1e-4);
  EXPECT_NEAR(power / (767e6 * removed), 1.0, 1e-10);
  const double way = 8e-3 + 0.125 * full_turn * ring; // the inner side lies on the left, at 45°
  const double left = process.left_beside(0, way, process.stock(0)).value();
  EXPECT_NEAR(left, 0.0, 1e-4) << "down-milling leaves the side on the right of the feed";
}

TEST(Passes, BeginBesideMatterOrInAHole) {
  ProcessSettings settings = through({along(-5e-3, 5e-3)});
  MillingProcess process(side_cut(), {}, settings);
  EXPECT_THROW(process.advance(), DivergenceError);
  settings.start = ProcessSettings::Start::hole;
  MillingProcess drilled(side_cut(), {}, settings);
  drilled.advance();
  EXPECT_LT(drilled.volume(), drilled.block() - 1e-9);
}

TEST(Blank, SectionsOfASurface) {
  // A square frame: outer 4 mm, opening 2 mm, as triangles between two heights that lean by 0.5 mm.
  TriangleSurface frame;
  const auto loop = [&](double half, double z, double shift) {
    for (const Vec2& c : {Vec2(-half, -half), Vec2(half, -half), Vec2(half, half), Vec2(-half, half)})
      frame.points.emplace_back(c.x() + shift, c.y(), z);
  };
  loop(2e-3, 0.0, 0.0), loop(2e-3, 1e-3, 0.5e-3), loop(1e-3, 0.0, 0.0), loop(1e-3, 1e-3, 0.5e-3);
  const auto quad = [&](int a, int b, int c, int d) {
    frame.triangles.push_back({a, b, c});
    frame.triangles.push_back({a, c, d});
  };
  for (int k = 0; k < 4; ++k) {
    const int n = (k + 1) % 4;
    quad(k, n, 4 + n, 4 + k);           // outside
    quad(8 + n, 8 + k, 12 + k, 12 + n); // opening
    quad(n, k, 8 + k, 8 + n);           // below
    quad(4 + k, 4 + n, 12 + n, 12 + k); // above
  }
  check_closed(frame);
  const DexelLayer layer(Vec2(-3e-3, -3e-3), Vec2(3e-3, 3e-3), Vec2::Constant(0.17e-3),
                         section_pieces(frame, 0.5e-3));
  EXPECT_NEAR(layer.area(), 12e-6, 1e-15);
  const std::vector<Interval> row = layer.matter(0, 0.01e-3);
  ASSERT_EQ(row.size(), 2U);
  EXPECT_NEAR(row[0].low, -1.75e-3, 1e-12);
  EXPECT_NEAR(row[0].high, -0.75e-3, 1e-12);
  const std::vector<Interval> slant =
      layer.matter(Vec2(0.25e-3, 0.0), Vec2(std::sqrt(0.5), std::sqrt(0.5)), 4e-3);
  ASSERT_EQ(slant.size(), 1U);
  EXPECT_NEAR(slant[0].low, std::sqrt(2.0) * 1e-3, 1e-12);
  EXPECT_NEAR(slant[0].high, std::sqrt(2.0) * 2e-3, 1e-12);
}

} // namespace
} // namespace cnem::machining
