// Flanks that plough against closed forms, and what they make of limits.
#include "machining/flank.hpp"

#include "machining/engaged_edges.hpp"
#include "machining/milling_process.hpp"
#include "machining/stability.hpp"
#include "machining/zero_order.hpp"
#include "tests/unit/machining/benchmarks.hpp"

#include <array>
#include <complex>
#include <gtest/gtest.h>

namespace cnem::machining {
namespace {

using enum Engagement::Side;

/// Worn by 60 µm, on a surface that springs back by 1 µm.
const Flank worn{.land = 60e-6, .recovery = 1e-6, .specific_force = 4e13, .friction = 0.3};

/// m², pressed in by a flank at φ = 1 whose edge has gone round with an outward displacement y(s), s m along
/// the circle up to 0.
template<class Y> double pressed_after(const Flank& flank, const Y& y, double cut_until = 0.0) {
  constexpr double radius = 6e-3, step = 1e-3; // rad
  FlankTraces traces(flank, std::array{radius}, 1, step);
  const auto edge = [&](int k) -> Vec2 { // relative to the axis without displacement
    const double phi = 1.0 + k * step;
    return (radius + y(radius * k * step)) * outward(phi).head<2>();
  };
  const auto way = [&](int k) -> FlankTraces::Way {
    return {edge(k) - edge(k - 1), 0.0, std::clamp((cut_until / radius - (k - 1) * step) / step, 0.0, 1.0)};
  };
  for (int k = -40; k < 0; ++k) traces.note(0, way(k), 0.0);
  return traces.pressed(0, radius * outward(1.0).head<2>(), way(0));
}

TEST(Flank, PressesInWhatAWaveStandsOutUnderIt) {
  constexpr double a = 0.2e-6, k = 2.0 * std::numbers::pi / 170e-6;
  for (const double phase : {0.3, 1.9, 4.0}) {
    const auto wave = [&](double s) { return a * std::sin(phase + k * s); };
    // ∫ (δ + y(0) − y(−s)) ds over the land.
    const double exact = worn.land * (worn.recovery + a * std::sin(phase)) -
                         a / k * (std::cos(phase - k * worn.land) - std::cos(phase));
    EXPECT_NEAR(pressed_after(worn, wave) / exact, 1.0, 1e-3) << phase;
  }
}

TEST(Flank, TouchesWhileItGoesOutwardsAlone) {
  Flank flank = worn;
  flank.recovery = 0.0;
  constexpr double slope = 3e-3;
  EXPECT_NEAR(pressed_after(flank, [](double s) { return slope * s; }) /
                  (0.5 * slope * flank.land * flank.land),
              1.0, 5e-3);
  EXPECT_EQ(pressed_after(flank, [](double s) { return -slope * s; }), 0.0);
  flank.clearance = std::atan(1e-3);
  EXPECT_NEAR(pressed_after(flank, [](double s) { return slope * s; }) / flank.pressed(slope), 1.0, 5e-3);
  flank.recovery = 30e-9; // leaves the surface after 15 of 60 µm
  flank.clearance = std::atan(2e-3);
  EXPECT_NEAR(flank.contact(0.0), 15e-6, 1e-9);
  EXPECT_NEAR(pressed_after(flank, [](double) { return 0.0; }) / (0.5 * 30e-9 * 15e-6), 1.0, 1e-3);
}

TEST(Flank, PressesOnlyWhereTheEdgeHasCut) {
  const auto still = [](double) { return 0.0; };
  EXPECT_NEAR(pressed_after(worn, still) / (worn.land * worn.recovery), 1.0, 1e-6);
  EXPECT_NEAR(pressed_after(worn, still, -20e-6) / (40e-6 * worn.recovery), 1.0, 1e-6);
  EXPECT_EQ(pressed_after(worn, still, -70e-6), 0.0);
}

TEST(Flank, SteadyForcesAreThoseOfTheFeed) {
  // A rigid cut takes the same chips with and without: the difference is that of flanks.
  MillingCut cut = milling_cut(1, 6e8, 2e8, down, 0.5);
  cut.flank = worn;
  cut.flank.clearance = 0.01;
  MillingCut sharp = cut;
  sharp.flank = {};
  const ProcessSettings settings{
      .spindle = 500.0, .axial_depth = 1e-3, .length = 3e-4, .pitch = 1e-5, .layers = 1, .steps = 1440};
  MillingProcess with(cut, {}, settings), without(sharp, {}, settings);
  int seen = 0;
  while (!with.at_end()) {
    const ProcessStep a = with.advance(), b = without.advance();
    const double phi = std::fmod(a.angle, full_turn);
    EXPECT_EQ(a.removed, b.removed);
    if (a.angle < 2.0 * full_turn || phi < 1.7 || phi > 3.0) continue;
    const double normal =
        worn.specific_force * cut.flank.pressed(flank_rise(cut, 0, phi, cut.cutter.radius())) * 1e-3;
    const Vec3 force = on_tool(phi, normal * Vec3(worn.friction, 1.0, 0.0));
    EXPECT_LT((a.force - b.force - force).norm(), 0.005 * force.norm()) << phi;
    EXPECT_NEAR((a.torque - b.torque) / (worn.friction * normal * 6e-3), 1.0, 0.005);
    ++seen;
  }
  EXPECT_GT(seen, 100);
  EXPECT_GT(with.ledger().ploughing, 0.0);
  EXPECT_EQ(without.ledger().ploughing, 0.0);
  EXPECT_LT(with.ledger().share(), 1e-5);
}

TEST(Flank, EnergiesOfACutThatVibratesAddUp) {
  for (const double helix : {0.0, 0.5}) {
    MillingCut cut = milling_cut(3, 767e6, 168.8e6, down, 0.25);
    cut.flank = worn;
    cut.cutter.helix = helix;
    cut.cutter.run_out = 1e-5;
    MillingProcess process(cut, insperger_modes(2),
                           {.spindle = 800.0,
                            .axial_depth = 0.3e-3,
                            .length = 1.5e-3,
                            .pitch = 1e-4,
                            .layers = 4,
                            .steps = 720});
    while (!process.at_end()) process.advance();
    EXPECT_LT(process.ledger().share(), 2e-5);
    EXPECT_GT(process.ledger().ploughing, 0.01 * process.ledger().cutting);
  }
}

/// Four teeth in a slot: at any time two cut that stand across each other, Σ n ⊗ n is one, and the radial
/// force alone regenerates: turning.
TEST(Flank, FourTeethInASlotAreDampedAsInTurning) {
  MillingCut cut = milling_cut(4, 6e8, 4e8, up, 1.0);
  cut.flank = worn;
  cut.flank.friction = 0.0;
  const std::vector<Mode> modes = insperger_modes(1);
  const Mode& mode = modes[0];
  for (const double speed : {3000.0, 4500.0, 9000.0}) {
    const double spindle = speed * rpm, delay = full_turn / 4.0 / spindle;
    const auto floquet = depth_limit(cut, modes, spindle, 5e-5, 2e-2);
    const auto zero = zero_order_limit(cut, modes, spindle);
    ASSERT_TRUE(floquet && zero);
    EXPECT_NEAR(zero->depth / floquet->depth, 1.0, 1e-5);
    // k − mω² + i ω (c + C b) + K b (1 − e^{−iωτ}) = 0
    using Complex = std::complex<double>;
    const double w = zero->frequency, b = zero->depth, k = mode.stiffness, m = mode.mass();
    const double c = 2.0 * mode.damping * std::sqrt(k * m),
                 C = 0.5 * worn.specific_force * worn.land * worn.land / (spindle * 6e-3);
    const Complex residual =
        k - m * w * w + Complex(0.0, w * (c + C * b)) + 4e8 * b * (1.0 - std::exp(Complex(0.0, -w * delay)));
    EXPECT_LT(std::abs(residual), 1e-4 * c * w) << speed;
  }
  // Where ωC is more than K no depth is unstable.
  EXPECT_FALSE(depth_limit(cut, modes, 600.0 * rpm, 1e-3, 2e-2));
  EXPECT_FALSE(zero_order_limit(cut, modes, 600.0 * rpm));
}

TEST(Flank, RaisesLimitsAtLowSpeeds) {
  MillingCut cut = insperger(down, 0.5);
  const std::vector<Mode> modes = insperger_modes(2);
  const auto limit = [&](double speed) { return depth_limit(cut, modes, speed * rpm, 1e-5, 5e-3)->depth; };
  const double slow = limit(1000.0), fast = limit(20000.0);
  cut.flank = worn;
  EXPECT_GT(limit(1000.0), 2.0 * slow);
  EXPECT_LT(limit(20000.0), 1.1 * fast);
  EXPECT_GT(limit(20000.0), fast);
}

/// By how much once-a-tooth samples spread more at the end than before.
double growth_of(const MillingCut& cut, double speed, double depth) {
  constexpr int steps = 1600, turns = 80;
  MillingProcess process(cut, insperger_modes(1),
                         {.spindle = speed,
                          .axial_depth = depth,
                          .length = turns * 2.0 * cut.feed,
                          .pitch = 1e-6,
                          .layers = 1,
                          .steps = steps});
  std::vector<double> sample;
  for (int step = 0; !process.at_end(); ++step) {
    const ProcessStep now = process.advance();
    if (step % (steps / 2) == steps / 4) sample.push_back(now.displacement.x());
  }
  const auto spread = [&](std::ptrdiff_t from, std::ptrdiff_t to) {
    const auto [low, high] = std::minmax_element(sample.end() - from, sample.end() - to);
    return *high - *low;
  };
  return spread(40, 0) / spread(120, 80);
}

TEST(Flank, DexelsLoseTheirStabilityWhereFloquetDoes) {
  MillingCut cut = insperger(up, 0.5);
  cut.feed = 1e-5;
  cut.flank = worn;
  const std::vector<Mode> modes = insperger_modes(1);
  const double speed = 5000.0 * rpm;
  for (const bool clears : {false, true}) { // half of the land
    if (clears) cut.flank = {.land = 100e-6, .clearance = 0.02, .recovery = 1e-6, .specific_force = 6e13};
    ASSERT_TRUE(!clears || longest_contact(cut) < 0.6 * cut.flank.land);
    const double limit = depth_limit(cut, modes, speed, 2e-5, 5e-3)->depth;
    EXPECT_GT(limit, 1.2 * 0.2603e-3) << "that of sharp edges";
    EXPECT_LT(growth_of(cut, speed, 0.97 * limit), 0.9) << clears;
    EXPECT_GT(growth_of(cut, speed, 1.03 * limit), 1.1) << clears;
  }
}

/// Two teeth of which run-out makes one stand out: it does not matter which is called the first.
TEST(Flank, LimitsWithRunOutDoNotDependOnWhichToothIsTheFirst) {
  MillingCut cut = insperger(up, 0.5);
  cut.cutter.run_out = 20e-6;
  cut.flank = {.land = 60e-6, .clearance = 0.008, .recovery = 0.1e-6, .specific_force = 4e13};
  const std::vector<Mode> modes = insperger_modes(1);
  const auto limit = [&](double angle, double helix) {
    cut.cutter.helix = helix;
    cut.cutter.run_out_angle = angle;
    return depth_limit(cut, modes, 3000.0 * rpm, 2e-5, 5e-3)->depth;
  };
  for (const double helix : {0.0, 0.5}) {
    const double first = limit(0.3, helix);
    EXPECT_NEAR(limit(0.3 + std::numbers::pi, helix) / first, 1.0, 1e-6) << helix;
    EXPECT_GT(std::abs(limit(1.8, helix) / first - 1.0), 1e-4) << "that it stands out elsewhere does";
  }
}

/// The same under a law that is not linear, from no run-out to one with which a tooth misses the cut.
TEST(Flank, LimitsWithRunOutGoOnWhereAToothBeginsToMiss) {
  KienzleLaw law;
  law.Kt1 = 400e6;
  law.Kr1 = 130e6;
  law.mt = law.mr = 0.2;
  MillingCut cut = insperger(up, 0.5);
  cut.law = law;
  const std::vector<Mode> modes = insperger_modes(1);
  const auto limit = [&](double run_out, double angle) {
    cut.cutter.run_out = run_out;
    cut.cutter.run_out_angle = angle;
    return depth_limit(cut, modes, 5000.0 * rpm, 2e-5, 5e-3)->depth;
  };
  const double misses = 0.5 * cut.feed / std::cos(0.3);
  for (const double run_out : {0.0, 0.5 * misses, 1.5 * misses})
    EXPECT_NEAR(limit(run_out, 0.3 + std::numbers::pi) / limit(run_out, 0.3), 1.0, 1e-6) << run_out;
  EXPECT_NEAR(limit(1e-10, 0.3) / limit(0.0, 0.3), 1.0, 1e-5);
  EXPECT_GT(limit(0.99 * misses, 0.3), 2.0 * limit(0.0, 0.3));
  // What a last sliver of a chip takes goes with its part of the turn, √, and the slope of the law.
  EXPECT_NEAR(limit((1.0 + 1e-7) * misses, 0.3) / limit((1.0 - 1e-7) * misses, 0.3), 1.0, 0.02);
}

/// Over a turn of two teeth the multiplier of a flip is +1.
TEST(Flank, FlipsStayFlipsWhereRunOutMakesTheTurnThePeriod) {
  MillingCut cut = insperger(down, 0.1);
  cut.flank = {.land = 10e-6, .recovery = 1e-6, .specific_force = 4e13};
  const std::vector<Mode> modes = insperger_modes(1);
  const double speed = 7000.0 * rpm;
  const auto even = depth_limit(cut, modes, speed, 1e-4, 5e-3);
  cut.cutter.run_out = 1e-9;
  const auto uneven = depth_limit(cut, modes, speed, 1e-4, 5e-3);
  ASSERT_TRUE(even && uneven);
  EXPECT_EQ(even->at.kind(), Bifurcation::flip);
  EXPECT_EQ(uneven->at.kind(), Bifurcation::flip);
  EXPECT_NEAR(uneven->depth / even->depth, 1.0, 1e-5);
  EXPECT_NEAR(uneven->at.frequency / even->at.frequency, 1.0, 1e-6);
}

/// A tooth that the other one leaves nothing has no surface to press.
TEST(Flank, OfAToothThatMissesTheCutDoesNotDamp) {
  MillingCut cut = insperger(up, 0.5);
  cut.flank = worn;
  cut.cutter.run_out = 100e-6;
  ASSERT_LT(steady_thickness(cut, 1, 1.0), 0.0);
  constexpr double depth = 1e-3, speed = 300.0;
  const EngagedEdges edges(cut, depth, speed);
  EXPECT_FALSE(edges.damping(0, 1.0).isZero(0.0));
  EXPECT_TRUE(edges.damping(1, 1.0).isZero(0.0));
}

/// In the time domain lands see the ways of edges across the axis alone: so do lobes, also of a ball.
TEST(Flank, OfABallMeetsNoVibrationAlongTheAxis) {
  MillingCut cut = insperger(up, 0.5);
  cut.flank = worn;
  cut.cutter.corner = cut.cutter.radius();
  const DirectionalFactors mean = EngagedEdges(cut, 1e-3, 300.0).mean_damping();
  EXPECT_GT(mean.col(0).norm(), 0.0);
  EXPECT_NE(mean(2, 0), 0.0) << "but push along it";
  EXPECT_TRUE(mean.col(2).isZero(0.0));
}

} // namespace
} // namespace cnem::machining
