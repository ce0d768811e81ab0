// Cuts in the time domain against closed formulas and independently computed numbers.
#include "machining/milling_process.hpp"

#include "core/error.hpp"
#include "machining/stability.hpp"
#include "tests/unit/machining/benchmarks.hpp"

#include <array>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>

namespace cnem::machining {
namespace {

using enum Engagement::Side;

MillingCut end_mill(Engagement::Side side) {
  MillingCut cut = milling_cut(3, 1.0, 0.0, side, 0.25);
  cut.cutter.helix = std::numbers::pi / 6.0;
  cut.law = aluminium();
  return cut;
}

TEST(Milling, ForcesOnTrueTrochoids) {
  struct Row {
    Engagement::Side side;
    double angle; ///< deg
    Vec3 force;
    double torque;
  };
  const std::array rows{Row{up, 30, Vec3(-293.318, -87.770, -35.464), 1.57358},
                        Row{up, 60, Vec3(-492.803, 169.153, -94.633), 2.87185},
                        Row{down, 30, Vec3(159.428, 461.900, -89.225), 2.67502},
                        Row{down, 60, Vec3(224.427, 273.694, -42.881), 1.79904}};
  for (const Row& row : rows) {
    MillingProcess process(
        end_mill(row.side), {},
        {.spindle = 800.0, .axial_depth = 6e-3, .length = 1.5e-3, .pitch = 1e-5, .layers = 24, .steps = 720});
    ProcessStep before, now;
    const double at = 4.0 * full_turn + row.angle * std::numbers::pi / 180.0;
    while (now.angle < at) {
      before = now;
      now = process.advance();
    }
    const Vec3 force = 0.5 * (before.force + now.force);
    EXPECT_LT((force - row.force).norm(), 0.01 * row.force.norm()) << row.angle << ": " << force.transpose();
    EXPECT_NEAR(0.5 * (before.torque + now.torque), row.torque, 0.01 * row.torque);
  }
}

TEST(Milling, ChipsOfATrochoid) {
  MillingCut cut = milling_cut(1, 1.0, 0.0, down, 1.0);
  MillingProcess process(
      cut, {},
      {.spindle = 100.0, .axial_depth = 1e-3, .length = 1e-3, .pitch = 1e-5, .layers = 1, .steps = 720});
  std::array<double, 180> sum{}, count{};
  while (!process.at_end()) {
    const ProcessStep step = process.advance();
    const double degree = std::fmod(step.angle, full_turn) * 180.0 / std::numbers::pi;
    if (step.angle < 3.0 * full_turn || degree >= 180.0) continue;
    sum[static_cast<std::size_t>(degree)] += step.thickest;
    count[static_cast<std::size_t>(degree)] += 1.0;
  }
  double square = 0.0;
  for (std::size_t k = 3; k < 177; ++k) {
    const double phi = (static_cast<double>(k) + 0.5) * std::numbers::pi / 180.0, f = cut.feed,
                 r = cut.cutter.radius();
    // To second order in f/R, on trochoids: an earlier turn was elsewhere when it was at this angle.
    const double exact = f * std::sin(phi) + f * f * std::cos(phi) * std::cos(phi) / (2.0 * r) -
                         f * f * std::sin(phi) * std::cos(phi) / (full_turn * r);
    square += std::pow(sum[k] / count[k] / exact - 1.0, 2) / 174.0;
  }
  EXPECT_LT(std::sqrt(square), 0.002);
}

TEST(Milling, LocationErrorOfAToolThatSwings) {
  struct Row {
    Engagement::Side side;
    double speed;
    std::array<double, 3> error; ///< µm at 0, 2 and 4 mm
  };
  for (const Row& row : {Row{up, 6600, {1.431, 1.244, 1.167}}, Row{down, 5200, {0.229, 3.447, 6.054}},
                         Row{down, 8000, {9.722, 9.308, 7.603}}}) {
    MillingCut cut = milling_cut(2, 1.0, 0.0, row.side, 1.0 / 12.0);
    cut.cutter.helix = std::numbers::pi / 6.0;
    cut.law = aluminium();
    cut.feed = 8e-5;
    MillingProcess process(cut,
                           {{.of = Mode::Of::tool,
                             .frequency = 300.0,
                             .damping = 0.02,
                             .stiffness = 3e7,
                             .direction = Vec3::UnitY()}},
                           {.spindle = row.speed * rpm,
                            .axial_depth = 4e-3,
                            .length = 10e-3,
                            .pitch = 2e-5,
                            .layers = 21,
                            .steps = 360});
    while (!process.at_end()) process.advance();
    for (const std::size_t place : {0U, 1U, 2U}) {
      double sum = 0.0, count = 0.0;
      for (double x = 8e-3; x < 9.6e-3; x += 2e-5, count += 1.0)
        sum += process.left_at(place * 10, x).value();
      EXPECT_NEAR(1e6 * sum / count, row.error[place], std::max(0.3, 0.03 * row.error[place]))
          << row.speed << ' ' << place;
    }
  }
}

/// Once-a-tooth samples of a cut of Insperger and Stépán's benchmark.
std::vector<double> samples(Engagement::Side side, double immersion, double rpms, double depth, double feed,
                            int turns) {
  constexpr int steps = 1600;
  MillingCut cut = insperger(side, immersion);
  cut.feed = feed;
  MillingProcess process(cut, insperger_modes(1),
                         {.spindle = rpms * rpm,
                          .axial_depth = depth,
                          .length = turns * 2.0 * feed,
                          .pitch = 1e-6,
                          .layers = 1,
                          .steps = steps});
  std::vector<double> sample;
  for (int step = 0; !process.at_end(); ++step) {
    const ProcessStep now = process.advance();
    if (step % (steps / 2) == steps / 4) sample.push_back(now.displacement.x());
  }
  return sample;
}

double spread(const std::vector<double>& sample, std::size_t from, std::size_t to) {
  const auto [low, high] = std::minmax_element(sample.begin() + static_cast<std::ptrdiff_t>(from),
                                               sample.begin() + static_cast<std::ptrdiff_t>(to));
  return *high - *low;
}

TEST(Milling, DisturbancesGrowBeyondTheLimitOfFloquet) {
  // A feed of far fewer than a radian of the cutter: the delay is that of circles.
  for (const double share : {0.98, 1.02}) {
    const std::vector<double> sample = samples(up, 0.5, 5000.0, share * 0.2603e-3, 1e-5, 80);
    const double growth = spread(sample, sample.size() - 40, sample.size()) /
                          spread(sample, sample.size() - 120, sample.size() - 80);
    if (share < 1.0)
      EXPECT_LT(growth, 0.8);
    else
      EXPECT_GT(growth, 1.2);
  }
}

TEST(Milling, FlipsBeyondTheLimitOfFlips) {
  for (const double share : {0.98, 1.03}) {
    const std::vector<double> sample = samples(down, 0.1, 7000.0, share * 2.9878e-3, 1e-5, 100);
    // What changes from tooth to tooth and comes back with the second one.
    double early = 0.0, late = 0.0, slow = 0.0;
    const std::size_t n = sample.size();
    for (std::size_t k = 0; k < 20; ++k) {
      early += std::abs(sample[n - 100 + k] - sample[n - 101 + k]);
      late += std::abs(sample[n - 20 + k] - sample[n - 21 + k]);
      slow += std::abs(sample[n - 20 + k] - sample[n - 22 + k]);
    }
    if (share < 1.0) {
      EXPECT_LT(late / early, 0.9);
    } else {
      EXPECT_GT(late / early, 0.99) << "it lasts, as large as teeth let it that leave the cut";
      EXPECT_LT(slow, 0.2 * late) << "the sign of the disturbance turns with each tooth";
    }
  }
}

TEST(Milling, VibrationsSaturateAsTeethLeaveTheCut) {
  const std::vector<double> sample = samples(up, 0.5, 5000.0, 1.0e-3, 1e-5, 80);
  const double early = spread(sample, 10, 40), late = spread(sample, sample.size() - 40, sample.size()),
               middle = spread(sample, sample.size() - 80, sample.size() - 40);
  EXPECT_GT(late, 1e-6);
  EXPECT_GT(late, 0.5 * early);
  EXPECT_LT(late, 1e-3) << "grown without bound it would be far larger";
  EXPECT_NEAR(late / middle, 1.0, 0.3);
}

TEST(Milling, ThePartThatMovesIsTheToolThatMovesTheOtherWay) {
  std::array<std::vector<ProcessStep>, 2> steps;
  for (const Mode::Of of : {Mode::Of::tool, Mode::Of::part}) {
    const double way = of == Mode::Of::tool ? 1.0 : -1.0;
    MillingProcess process(
        end_mill(down),
        {{.of = of,
          .frequency = 900.0,
          .damping = 0.02,
          .stiffness = 1e6,
          .direction = way * Vec3(0.6, 0.8, 0.0)}},
        {.spindle = 800.0, .axial_depth = 2e-3, .length = 6e-4, .pitch = 1e-4, .layers = 4, .steps = 360});
    while (!process.at_end()) steps[of == Mode::Of::tool ? 0 : 1].push_back(process.advance());
  }
  ASSERT_EQ(steps[0].size(), steps[1].size());
  double most = 0.0;
  for (const ProcessStep& step : steps[0]) most = std::max(most, step.removed);
  for (std::size_t k = 0; k < steps[0].size(); ++k)
    EXPECT_NEAR(steps[0][k].removed, steps[1][k].removed, 1e-9 * most);
}

TEST(Milling, AModeMovesAsMuchAsItsShapeWhereItIsCut) {
  // A soft spring that is slow: the wall leans away from the force by shape² F/k.
  const auto lean = [](const Mode& mode) {
    MillingCut cut = milling_cut(3, 767e6, 168.8e6, down, 0.5);
    MillingProcess process(
        cut, {mode},
        {.spindle = 100.0, .axial_depth = 1e-3, .length = 9e-4, .pitch = 1e-4, .layers = 2, .steps = 360});
    double most = 0.0;
    while (!process.at_end()) most = std::max(most, process.advance().displacement.norm());
    return most;
  };
  Mode mode{.of = Mode::Of::part,
            .frequency = 5000.0,
            .damping = 0.3,
            .stiffness = 4e9,
            .direction = Vec3::UnitY()};
  const double full = lean(mode);
  const auto list = [](double a, double b) {
    NumberList numbers;
    numbers.value[0] = a;
    numbers.value[1] = b;
    numbers.size = 2;
    return numbers;
  };
  mode.along = list(-1.0, 1.0);
  mode.shape_along = list(0.5, 0.5);
  EXPECT_NEAR(lean(mode) / full, 0.25, 1e-3) << "half the force on the mode, half the way of it";
  mode.height = list(0.25e-3, 0.75e-3);
  mode.shape_over_height = list(0.0, 2.0);
  EXPECT_NEAR(lean(mode) / full, 0.5, 1e-3) << "the upper layer alone, with twice the share";
}

TEST(Milling, RunOutShowsInChipsAndPitchInTheirOrder) {
  MillingCut cut = milling_cut(2, 767e6, 0.0, down, 1.0);
  cut.cutter.run_out = 2e-5;
  const ProcessSettings settings{
      .spindle = 800.0, .axial_depth = 1e-3, .length = 2e-3, .pitch = 1e-5, .layers = 1, .steps = 720};
  MillingProcess process(cut, {}, settings);
  std::array<double, 2> thickest{};
  while (!process.at_end()) {
    const ProcessStep step = process.advance();
    if (step.angle < 4.0 * full_turn) continue;
    const double phi = std::fmod(step.angle, full_turn);
    double& most = thickest[phi < std::numbers::pi ? 0 : 1];
    most = std::max(most, step.thickest);
  }
  // The first tooth stands out by twice the run-out over the other: f + 2e, f − 2e at the middle.
  EXPECT_NEAR(thickest[0], 1.4e-4, 2e-6);
  EXPECT_NEAR(thickest[1], 0.6e-4, 2e-6);
}

TEST(Milling, EntersFromBesideTheWorkpiece) {
  MillingCut cut = milling_cut(3, 767e6, 0.0, down, 0.5);
  cut.feed = 3e-4;
  MillingProcess process(cut, {},
                         {.spindle = 800.0,
                          .axial_depth = 1e-3,
                          .length = 14e-3,
                          .start = ProcessSettings::Start::outside,
                          .pitch = 2e-5,
                          .layers = 1,
                          .steps = 720});
  const double whole = process.volume();
  double first = -1.0;
  while (!process.at_end()) {
    const ProcessStep step = process.advance();
    if (first < 0.0 && step.removed > 0.0) first = step.time;
  }
  EXPECT_GT(process.motion().start() + first * process.feed_of_turn() * 800.0 / full_turn, -6.1e-3);
  EXPECT_LT(process.volume(), whole);
  EXPECT_GT(first, 0.0);
}

/// A finishing cut whose edge forces push a tool by more than its feed in a step, when they come and go.
TEST(Milling, StepsThatAreAdvisedAreFineEnough) {
  MillingCut cut = milling_cut(4, 800e6, 300e6, up, 0.339 / 12.0);
  LinearLaw law;
  law.Ktc = 800e6;
  law.Krc = 300e6;
  law.Kte = 17.83e3;
  law.Kre = 38.76e3;
  cut.law = law;
  cut.feed = 24.8e-6;
  ProcessSettings settings{.spindle = 2837.0 * rpm,
                           .axial_depth = 5.71e-3,
                           .length = 3.0 * 4.0 * cut.feed,
                           .pitch = 0.1 * cut.feed,
                           .layers = 1,
                           .steps = 360};
  const std::vector<Mode> modes{{.of = Mode::Of::tool,
                                 .frequency = 1408.0,
                                 .damping = 0.0255,
                                 .stiffness = 3.12e6,
                                 .direction = Vec3::UnitY()}};
  const auto advised = [&] {
    try {
      for (MillingProcess process(cut, modes, settings); !process.at_end();) process.advance();
    } catch (const DivergenceError& error) {
      const std::string text = error.what(), key = "dexels.steps = ";
      EXPECT_NE(text.find(key), std::string::npos) << text;
      return std::atoi(text.c_str() + text.find(key) + key.size());
    }
    return 0;
  };
  settings.steps = advised();
  EXPECT_GT(settings.steps, 360);
  EXPECT_LT(settings.steps, 4000);
  EXPECT_EQ(advised(), 0);
}

} // namespace
} // namespace cnem::machining
