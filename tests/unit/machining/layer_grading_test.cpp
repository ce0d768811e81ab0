// Where layers end, and what forces of rounded ends come of it.
#include "machining/layer_grading.hpp"

#include "machining/milling_process.hpp"
#include "tests/degree.hpp"
#include "tests/unit/machining/benchmarks.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace cnem::machining {
namespace {

using enum Engagement::Side;

TEST(LayerGrading, OfAHelixLayersAreEquallyThick) {
  MillingCut cut = milling_cut(3, 1e9, 0.0, up, 0.5);
  cut.cutter.helix = 0.5; // 4 mm of it lag by 20.87 degrees
  const LayerGrading grading(cut, 4e-3, 720);
  EXPECT_EQ(grading.layers(), 42);
  EXPECT_EQ(LayerGrading(cut, 4e-3, 360).layers(), 21);
  EXPECT_EQ(LayerGrading(cut, 4e-3, 100).layers(), 21) << "a degree at most";
  EXPECT_EQ(LayerGrading(cut, 4e-3, 3600).layers(), 42) << "half a degree will do";
  const std::vector<double> ends = grading.ends(5);
  ASSERT_EQ(ends.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(ends[k], 0.8e-3 * static_cast<double>(k), 1e-15);
  EXPECT_GT(LayerGrading(cut, 1e6, 720).layers(), 1'000'000);
  cut.cutter.helix = 0.0;
  EXPECT_EQ(LayerGrading(cut, 4e-3, 720).layers(), 1);
  EXPECT_EQ(LayerGrading(cut, 4e-3, 720).ends(5), (std::vector{0.0, 4e-3}));
}

/// Whether no layer lets edges enter or leave, normals turn, or a height pass by more than it may.
void expect_fine(const MillingCut& cut, double depth, const std::vector<double>& end) {
  constexpr double little = 1.05; // between tenths of a layer heights are linear
  const Cutter& cutter = cut.cutter;
  for (std::size_t k = 1; k < end.size(); ++k) {
    const auto differs = [&](const auto& at) { return std::abs(at(end[k]) - at(end[k - 1])); };
    EXPECT_LE(
        differs([&](double z) { return cutter.lag(z) + cut.engagement.entry(cutter, cutter.radius_at(z)); }),
        little * degree)
        << k;
    EXPECT_LE(
        differs([&](double z) { return cutter.lag(z) + cut.engagement.exit(cutter, cutter.radius_at(z)); }),
        little * degree)
        << k;
    EXPECT_LE(end[k] - end[k - 1], little * 0.05 * depth) << k;
    EXPECT_LE(cutter.lead(end[k], end[k]) - cutter.lead(end[k - 1], end[k - 1]), little * 4.5 * degree) << k;
  }
}

TEST(LayerGrading, OfABallLayersEndByWhereItsEdgesEnterAndByItsNormal) {
  MillingCut cut = milling_cut(3, 1e9, 0.0, up, 0.5);
  cut.cutter.corner = cut.cutter.radius();
  // Half a slot ends where edges of any radius leave: normals turn, by acos(1 − 4/6) up to 4 mm, and heights
  // pass.
  const LayerGrading half(cut, 4e-3, 360);
  EXPECT_GE(half.layers(), 20);
  EXPECT_LE(half.layers(), 26);
  expect_fine(cut, 4e-3, half.ends(half.layers()));
  EXPECT_LT(half.ends(half.layers())[1], 6e-3 * (1.0 - std::cos(4.51 * degree))) << "at the tip";
  // 2 mm beside the axis: edges are in the cut above 0.343 mm, where they leave as a root of the height.
  cut.engagement.radial_depth = 4e-3;
  const LayerGrading beside(cut, 4e-3, 360);
  EXPECT_GE(beside.layers(), static_cast<int>(std::acos(2.0 / std::sqrt(32.0)) / degree));
  const std::vector<double> fine = beside.ends(beside.layers());
  expect_fine(cut, 4e-3, fine);
  const auto above = std::upper_bound(fine.begin(), fine.end(), 6e-3 - std::sqrt(32.0) * 1e-3);
  ASSERT_GT(fine.end() - above, 1);
  EXPECT_LT(*(above + 1) - *above, 0.002e-3) << "there they are thin";
}

TEST(LayerGrading, OfABullWithStraightEdgesTheSideIsDividedToo) {
  MillingCut cut = milling_cut(3, 1e9, 0.0, up, 0.5);
  cut.cutter.corner = 1e-3;
  const LayerGrading grading(cut, 10e-3, 360);
  expect_fine(cut, 10e-3, grading.ends(grading.layers()));
}

// Passes of a ball: thin layers over each tip, of which those that another pass has near are left out.
TEST(Slices, OfARoundedCutterAreThinOverEachTip) {
  MillingCut cut = milling_cut(3, 1e9, 0.0, up, 0.5);
  cut.cutter.corner = cut.cutter.radius();
  cut.engagement.radial_depth = 4e-3;
  ProcessSettings settings{
      .axial_depth = 3e-3, .layers = LayerGrading(cut, 3e-3, 360).layers(), .steps = 360};
  const std::size_t alone = slices_of(cut, settings).size();
  EXPECT_EQ(alone, index_of(settings.layers));
  settings.blank = Blank{.low = {0.0, 0.0}, .high = {0.03, 0.03}, .height = 6e-3};
  for (const double tip : {0.0, 1e-3, 2e-3, 3e-3})
    settings.passes.push_back(
        ToolPath({CurvePiece{.from = Vec2::Zero(), .to = Vec2(0.01, 0.0), .name = ""}}, tip));
  const std::vector<Slice> all = slices_of(cut, settings);
  EXPECT_LT(all.size(), 4 * alone);
  double low = 0.0;
  for (const Slice& slice : all) {
    EXPECT_NEAR(slice.low, low, 1e-15);
    EXPECT_GT(slice.thickness, 1e-7);
    EXPECT_LT(slice.thickness, 0.16e-3);
    low += slice.thickness;
  }
  EXPECT_NEAR(low, 6e-3, 1e-15);
  for (const ToolPath& pass : settings.passes)
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Slice& slice) {
      return std::abs(slice.low - pass.tip()) < 1e-12;
    })) << pass.tip();
}

/// 16 mm, corner 1.5 mm, 2.5 mm deep, four teeth at uneven pitches with a helix of 35 degrees, run-out 8 µm.
MillingCut uneven_bull(Engagement::Side side) {
  MillingCut cut = milling_cut(4, 1.0, 0.0, side, 0.25);
  cut.cutter.diameter = 16e-3;
  cut.cutter.corner = 1.5e-3;
  cut.cutter.pitch = {80 * degree, 100 * degree, 85 * degree, 95 * degree};
  cut.cutter.helix = 35 * degree;
  cut.cutter.run_out = 8e-6;
  cut.cutter.run_out_angle = 100 * degree;
  cut.engagement.radial_depth = 4e-3;
  cut.feed = 1e-4;
  cut.law = aluminium();
  return cut;
}

// Beside an independent program: 3,000 slices of equal arc on true trochoids, means over steps of 0.5°.
// Layers of one thickness are off by up to 16% there, by 3% of the largest force.
TEST(Milling, ForcesOfABullEndByDefaultLayers) {
  struct Row {
    Engagement::Side side;
    double steps; ///< 0.5° each
    Vec3 force;
    double torque;
  };
  const std::array rows{
      Row{up, 20, {-59.774, -21.549, 37.251}, 0.413},  Row{up, 66, {-186.673, -0.750, 25.965}, 1.274},
      Row{up, 170, {-25.026, -5.217, 21.868}, 0.170},  Row{up, 174, {-42.977, -13.953, 32.361}, 0.297},
      Row{up, 300, {-32.976, 21.501, -6.962}, 0.284},  Row{up, 409, {-199.755, -27.546, 23.208}, 1.389},
      Row{up, 608, {-221.661, 30.053, 19.048}, 1.558}, Row{down, 20, {16.332, 14.256, -1.130}, 0.133},
      Row{down, 60, {12.456, 98.680, 20.076}, 0.679},  Row{down, 66, {34.860, 187.084, 24.856}, 1.329},
      Row{down, 174, {94.100, 76.807, 16.599}, 0.782}, Row{down, 300, {101.802, 189.441, 18.248}, 1.499},
      Row{down, 409, {5.688, 58.769, 15.285}, 0.397},  Row{down, 660, {131.280, 226.588, 9.507}, 1.856}};
  for (const Engagement::Side side : {up, down}) {
    const MillingCut cut = uneven_bull(side);
    const double depth = 2.5e-3;
    MillingProcess process(cut, {},
                           {.spindle = 800.0,
                            .axial_depth = depth,
                            .length = 1.4e-3,
                            .pitch = 1e-5,
                            .layers = LayerGrading(cut, depth, 720).layers(),
                            .steps = 720});
    std::vector<ProcessStep> steps;
    while (!process.at_end()) steps.push_back(process.advance());
    for (const Row& row : rows) {
      if (row.side != side) continue;
      const double angle = 2.0 * full_turn + (row.steps + 0.5) * 0.5 * degree;
      const auto step = std::find_if(steps.begin(), steps.end(),
                                     [&](const ProcessStep& s) { return std::abs(s.angle - angle) < 1e-6; });
      ASSERT_NE(step, steps.end());
      EXPECT_LT((step->force - row.force).norm(), 0.01 * row.force.norm())
          << row.steps << ": " << step->force.transpose();
      EXPECT_NEAR(step->torque, row.torque, 0.01 * row.torque) << row.steps;
    }
  }
}

} // namespace
} // namespace cnem::machining
