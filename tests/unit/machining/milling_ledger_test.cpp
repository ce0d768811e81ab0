// Energies of cuts add up.
#include "machining/milling_process.hpp"
#include "tests/unit/machining/benchmarks.hpp"

#include <gtest/gtest.h>

namespace cnem::machining {
namespace {

using enum Engagement::Side;

TEST(MillingLedger, ADampedSwingLosesWhatItHad) {
  const Mode mode{.frequency = 922.0, .damping = 0.03, .stiffness = 1.3e6};
  for (const double time : {1e-5, 1e-3, 5e-2}) {
    const Vec2 begin(3e-6, -5e-6), end = FreeMotion(mode, time).of_state * begin;
    const double lost = 0.5 * mode.stiffness * (begin.squaredNorm() - end.squaredNorm());
    EXPECT_NEAR(begin.dot(damping_loss(mode, time) * begin) / lost, 1.0, 1e-10) << time;
  }
}

struct Row {
  Engagement::Side side;
  double helix, run_out;
  std::vector<Mode> modes;
};

MillingLedger ledger_of(const Row& row, int steps) {
  MillingCut cut = milling_cut(3, 767e6, 168.8e6, row.side, 0.25);
  LinearLaw law{.Ktc = 767e6};
  law.Krc = 168.8e6;
  law.Kac = 222e6;
  law.Kte = 27.7e3;
  law.Kre = 26.6e3;
  cut.law = CuttingLaw(law);
  cut.cutter.helix = row.helix;
  cut.cutter.run_out = row.run_out;
  MillingProcess process(cut, row.modes,
                         {.spindle = 800.0,
                          .axial_depth = 0.3e-3,
                          .length = 1.5e-3,
                          .pitch = 1e-4,
                          .layers = 4,
                          .steps = steps});
  while (!process.at_end()) process.advance();
  return process.ledger();
}

TEST(MillingLedger, DrivesPutInWhatCutAndModesTake) {
  std::vector<Mode> modes = insperger_modes(2);
  modes.push_back({.of = Mode::Of::part,
                   .frequency = 1500.0,
                   .damping = 0.02,
                   .stiffness = 2e6,
                   .direction = Vec3(0.0, 0.6, 0.8)});
  NumberList along, shape; // a wall that is softer farther on
  along.size = shape.size = 2;
  along.value[1] = 2e-3;
  shape.value[0] = 0.5;
  shape.value[1] = 1.0;
  modes.back().along = along;
  modes.back().shape_along = shape;
  for (const Row& row : {Row{down, 0.0, 0.0, {}}, Row{up, 0.5, 2e-5, {}}, Row{down, 0.5, 0.0, modes},
                         Row{up, 0.0, 2e-5, modes}}) {
    const MillingLedger coarse = ledger_of(row, 360), fine = ledger_of(row, 1440);
    EXPECT_LT(coarse.share(), 3e-5);
    EXPECT_LT(fine.share(), 2e-6) << "of second order in a step";
    EXPECT_GT(fine.cutting, 0.0);
    EXPECT_EQ(fine.damping > 0.0, !row.modes.empty());
    EXPECT_EQ(fine.kinetic + fine.elastic > 0.0, !row.modes.empty());
    EXPECT_LT(std::abs(fine.feed), 0.05 * fine.spindle);
  }
}

} // namespace
} // namespace cnem::machining
