// Passes whose tips are at different heights.
#include "machining/milling_process.hpp"
#include "tests/unit/machining/benchmarks.hpp"

#include <array>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>
#include <vector>

namespace cnem::machining {
namespace {

using enum Engagement::Side;

/// With a helix, all three forces, edge forces too.
MillingCut helical_cut() {
  MillingCut cut = milling_cut(3, 767e6, 168.8e6, up, 1.0 / 12.0);
  cut.law = aluminium();
  cut.cutter.helix = std::numbers::pi / 6.0;
  cut.feed = 2e-4;
  return cut;
}

/// Along x through a block of 3 mm beside y = 0: whole turns, so that the next pass begins at the same angle.
ToolPath past(double y, double tip) {
  return ToolPath({CurvePiece{.from = Vec2(-8e-3, y), .to = Vec2(-8e-3 + 33 * 6e-4, y), .name = ""}}, tip);
}

ProcessSettings milled(double height, double depth, std::vector<ToolPath> passes) {
  return {.spindle = 800.0,
          .axial_depth = depth,
          .start = ProcessSettings::Start::outside,
          .pitch = 1e-4,
          .layers = 3,
          .steps = 180,
          .passes = std::move(passes),
          .blank = Blank{.low = Vec2(0.0, 0.0), .high = Vec2(3e-3, 8e-3), .height = height}};
}

struct Course {
  std::vector<Vec3> force; ///< N, a step
  double removed = 0.0;    ///< m³
  double most() const {
    double most = 0.0;
    for (const Vec3& f : force) most = std::max(most, f.norm());
    return most;
  }
};

/// [pass]
std::vector<Course> courses(MillingProcess& process) {
  std::vector<Course> courses(process.motion().passes().size());
  while (!process.at_end()) {
    Course& course = courses[process.motion().pass_of(process.steps())];
    const ProcessStep step = process.advance();
    course.force.push_back(step.force);
    course.removed += step.removed;
  }
  return courses;
}

void expect_same_forces(const Course& one, const Course& other) {
  ASSERT_EQ(one.force.size(), other.force.size());
  ASSERT_GT(one.most(), 50.0);
  for (std::size_t k = 0; k < one.force.size(); ++k)
    ASSERT_LT((one.force[k] - other.force[k]).norm(), 1e-9 * one.most()) << "step " << k;
  EXPECT_NEAR(one.removed, other.removed, 1e-12 * one.removed);
}

std::vector<Mode> soft_tool() {
  return {{.of = Mode::Of::tool,
           .frequency = 900.0,
           .damping = 0.05,
           .stiffness = 2e7,
           .direction = Vec3::UnitY()},
          {.of = Mode::Of::tool,
           .frequency = 1500.0,
           .damping = 0.05,
           .stiffness = 2e7,
           .direction = Vec3(0.6, 0.0, 0.8)}};
}

} // namespace

TEST(Slices, EquallyThickWhereTipsAllowIt) {
  const std::vector<Slice> even = slices(6e-3, 0.9e-3, {2e-3, 4e-3, 0.0});
  ASSERT_EQ(even.size(), 9U); // of 2/3 mm: thirds of 2 mm, at which tips are
  const std::vector<Slice> equal = slices(6e-3, 1e-3, {2e-3, 4e-3});
  ASSERT_EQ(equal.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_DOUBLE_EQ(equal[k].low, 1e-3 * static_cast<double>(k));
    EXPECT_DOUBLE_EQ(equal[k].thickness, 1e-3);
  }
}

TEST(Slices, LieBetweenTips) {
  const std::vector<Slice> odd = slices(5e-3, 1e-3, {3.3e-3, 0.7e-3, 3.3e-3});
  // 0.7 in one, 2.6 in three, 1.7 in two.
  ASSERT_EQ(odd.size(), 6U);
  EXPECT_DOUBLE_EQ(odd[1].low, 0.7e-3);
  EXPECT_DOUBLE_EQ(odd[4].low, 3.3e-3);
  double height = 0.0;
  for (const Slice& slice : odd) {
    EXPECT_NEAR(slice.low, height, 1e-18);
    EXPECT_LE(slice.thickness, 1e-3);
    height += slice.thickness;
  }
  EXPECT_NEAR(height, 5e-3, 1e-17);
}

TEST(PassDepths, EachTakesItsStepOfDepth) {
  // The cutter is wider than the block: every pass takes all that is over its tip.
  ProcessSettings settings = milled(5e-3, 2e-3, {past(0.0, 3e-3), past(0.0, 1.5e-3), past(0.0, 0.0)});
  settings.blank->low = Vec2(0.0, -4e-3);
  settings.blank->high = Vec2(3e-3, 5e-3);
  MillingProcess process(helical_cut(), {}, settings);
  const std::vector<Course> of = courses(process);
  EXPECT_NEAR(process.block(), 3e-3 * 9e-3 * 5e-3, 1e-12 * process.block());
  for (const auto& [pass, depth] : {std::pair{0U, 2e-3}, {1U, 1.5e-3}, {2U, 1.5e-3}})
    EXPECT_NEAR(of[pass].removed, 3e-3 * 9e-3 * depth, 1e-12 * 3e-3 * 9e-3 * depth) << pass;
  EXPECT_LT(process.volume(), 1e-12 * process.block());
}

TEST(PassDepths, TheSecondStepIsALonePassOfItsDepth) {
  // The first goes farther in by more than the tool swings: over the second one's depth nothing is left.
  for (const bool flexible : {false, true}) {
    const std::vector<Mode> modes = flexible ? soft_tool() : std::vector<Mode>{};
    MillingProcess two(helical_cut(), modes, milled(4e-3, 2e-3, {past(-4.5e-3, 2e-3), past(-5e-3, 0.0)}));
    MillingProcess lone(helical_cut(), modes, milled(2e-3, 2e-3, {past(-5e-3, 0.0)}));
    const std::vector<Course> of = courses(two);
    ASSERT_EQ(of[0].force.size() % 180, 0U) << "whole turns";
    expect_same_forces(courses(lone)[0], of[1]);
    EXPECT_LT(two.ledger().share(), 1e-4);
  }
}

TEST(PassDepths, ACutIsTheSameAtAnyHeight) {
  // Rounded ends, run-out, flanks, and shapes over the height, which go up with the tool, not with the part.
  MillingCut cut = helical_cut();
  cut.cutter.run_out = 5e-6;
  cut.flank = {.land = 60e-6, .clearance = 0.0, .recovery = 1e-6, .specific_force = 4e13, .friction = 0.3};
  const double r = cut.cutter.radius();
  for (const double corner : {0.0, 1e-3, r}) {
    cut.cutter.corner = corner;
    const double y = corner < r ? -4.9e-3 : -3.5e-3; // a ball is 4.5 mm wide there
    std::array<Course, 2> course;
    for (const double tip : {0.0, 1.5e-3}) {
      std::vector<Mode> modes = soft_tool();
      modes[1].of = Mode::Of::part;
      for (Mode& mode : modes) {
        const double up_by = mode.of == Mode::Of::part ? tip : 0.0;
        mode.height = {{up_by, 2e-3 + up_by}, 2};
        mode.shape_over_height = {{0.5, 1.0}, 2};
      }
      MillingProcess process(cut, modes, milled(2e-3 + tip, 2e-3, {past(y, tip)}));
      const double below = 3e-3 * 8e-3 * tip;
      course[tip > 0.0] = courses(process)[0];
      double kept = 0.0;
      for (std::size_t k = 0; k < process.layers().size(); ++k)
        if (process.height(k) < tip) kept += process.layers()[k].area() * process.slices()[k].thickness;
      EXPECT_NEAR(kept, below, 1e-12 * below) << "nothing is taken below the tip";
    }
    expect_same_forces(course[0], course[1]);
  }
}

} // namespace cnem::machining
