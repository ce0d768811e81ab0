// What edges bear on together, against fine sums.
#include "machining/engaged_edges.hpp"

#include "tests/unit/machining/benchmarks.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cnem::machining {
namespace {

using enum Engagement::Side;

/// Slopes that jump at every point of the table.
CuttingLaw steps_of_slope() {
  TableLaw law;
  law.thickness = {{10e-6, 20e-6, 30e-6, 45e-6, 60e-6, 75e-6}, 6};
  law.Ft = {{30e3, 44e3, 48e3, 72e3, 75e3, 110e3}, 6};
  law.Fr = {{25e3, 31e3, 40e3, 41e3, 60e3, 61e3}, 6};
  law.Fa = {{1e3, 4e3, 5e3, 9e3, 9e3, 12e3}, 6};
  return law;
}

/// One or a few slices long, with a helix: the edge goes through slopes that jump, and teeth of a run-out
/// miss some of the cut.
MillingCut flat_cut(double run_out) {
  MillingCut cut = milling_cut(2, 1.0, 0.0, up, 0.4);
  cut.cutter.helix = 0.6;
  cut.cutter.run_out = run_out * cut.feed;
  cut.cutter.run_out_angle = 0.7;
  cut.law = steps_of_slope();
  return cut;
}

/// Of one tooth, by the middles of many thin discs.
DirectionalFactors fine_sum(const MillingCut& cut, double depth, double spindle, std::size_t tooth,
                            double tip) {
  constexpr int discs = 400;
  DirectionalFactors sum = DirectionalFactors::Zero();
  for (int k = 0; k < discs; ++k) {
    const double z = depth * (k + 0.5) / discs, phi = tip - cut.cutter.lag(z);
    if (phi < cut.engagement.entry(cut.cutter) || phi > cut.engagement.exit(cut.cutter)) continue;
    const double h = steady_thickness(cut, tooth, phi);
    if (!(h > 0.0)) continue;
    const Vec3 slope = cut.law.at({.thickness = h, .speed = spindle * cut.cutter.radius()}).slope;
    sum += on_tool(phi, slope) * outward(phi).transpose() * (depth / discs);
  }
  return sum;
}

// At single angles eight points of a slice miss jumps of slopes by some per cent; over a turn that is evened
// out.
TEST(EngagedEdges, FactorsOfAFlatEndWithATableAndRunOutAreThoseOfAFineSum) {
  constexpr double spindle = 800.0;
  for (const double run_out : {0.0, 0.15, 0.5})
    for (const double depth : {0.6e-3, 2.5e-3}) {
      const MillingCut cut = flat_cut(run_out);
      const EngagedEdges edges(cut, depth, spindle);
      double error = 0.0, size = 0.0;
      DirectionalFactors mean = DirectionalFactors::Zero(), fine = mean;
      for (std::size_t tooth = 0; tooth < 2; ++tooth)
        for (int k = 0; k < 720; ++k) {
          const double tip = 0.0013 + 0.003 * k;
          const DirectionalFactors found = edges.factors(tooth, tip),
                                   sum = fine_sum(cut, depth, spindle, tooth, tip);
          error += (found - sum).squaredNorm();
          size += sum.squaredNorm();
          mean += found;
          fine += sum;
        }
      ASSERT_GT(size, 0.0);
      EXPECT_LT(std::sqrt(error / size), 0.06) << run_out << ' ' << depth;
      EXPECT_LT((mean - fine).norm(), 2e-3 * fine.norm()) << run_out << ' ' << depth;
    }
}

// A ball of 6 mm, 1.2 mm deep, reaches 3.6 mm from its axis, with a normal of 36.87 deg: there it comes as
// far as that into a workpiece whose side is 2 mm beside the axis, to where cos φ is 2 in 3.6.
TEST(SteadyChips, AreThoseOfTheEdgesThatCut) {
  MillingCut cut = milling_cut(3, 1e9, 0.0, up, 1.0 / 3.0);
  const SteadyChips flat = steady_chips(cut, 1.2e-3);
  EXPECT_NEAR(flat.thickest, 1e-4 * std::sqrt(1.0 - 1.0 / 9.0), 1e-12);
  EXPECT_EQ(flat.radius, 6e-3);
  cut.cutter.corner = cut.cutter.radius();
  const SteadyChips ball = steady_chips(cut, 1.2e-3);
  EXPECT_NEAR(ball.radius, 3.6e-3, 1e-9);
  EXPECT_NEAR(ball.thickest, 1e-4 * 0.6 * std::sqrt(1.0 - 1.0 / 3.24), 1e-9);
  EXPECT_GT(ball.thinnest, 0.0);
  cut.cutter.run_out = 0.5 * cut.feed;
  EXPECT_LE(steady_chips(cut, 1.2e-3).thinnest, 0.0) << "a tooth misses the begin of the cut";
  cut.engagement.radial_depth = 1e-3; // farther out than it reaches
  const SteadyChips none = steady_chips(cut, 1.2e-3);
  EXPECT_EQ(none.thickest, 0.0);
  EXPECT_EQ(none.radius, 0.0);
}

} // namespace
} // namespace cnem::machining
