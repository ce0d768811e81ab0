// Multipliers and limits against published and independently computed numbers.
#include "machining/stability.hpp"

#include "core/machine/threads.hpp"
#include "machining/largest_eigenvalue.hpp"
#include "machining/zero_order.hpp"
#include "tests/unit/machining/benchmarks.hpp"
#include "tests/unit/machining/marched_cut.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <gtest/gtest.h>

namespace cnem::machining {
namespace {

using enum Engagement::Side;

double limit_mm(const MillingCut& cut, const std::vector<Mode>& modes, double speed, double step) {
  const auto limit = depth_limit(cut, modes, speed * rpm, step, 20e-3);
  return limit ? 1e3 * limit->depth : -1.0;
}

TEST(Floquet, SpectralRadiiOfASlot) {
  // Semi-discretisation of 200 steps gives 0.8192, 1.0726, 1.2197, 1.4040; the converged values stand here.
  for (const auto& [depth, radius] :
       {std::pair{0.2, 0.819743}, {0.5, 1.073976}, {0.7, 1.221556}, {1.0, 1.406474}})
    EXPECT_NEAR(spectral_radius(insperger(), insperger_modes(1), 5000.0 * rpm, 1e-3 * depth), radius, 2e-6);
}

struct LimitRow {
  int dofs;
  double immersion;
  Engagement::Side side;
  std::array<double, 6> limit; ///< mm at 5000, 6000, … 10000 rpm
};

class Limits : public testing::TestWithParam<LimitRow> {};

TEST_P(Limits, OfInspergerAndStepan) {
  const LimitRow& row = GetParam();
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(limit_mm(insperger(row.side, row.immersion), insperger_modes(row.dofs),
                         5000.0 + 1000.0 * static_cast<double>(i), row.dofs == 1 ? 1e-4 : 4e-5),
                row.limit[i], 1e-3 * row.limit[i] + 5e-5);
}

INSTANTIATE_TEST_SUITE_P(
    Of, Limits,
    testing::Values(LimitRow{1, 1.0, up, {0.4086, 0.3532, 1.1520, 0.6764, 3.0092, 0.3224}},
                    LimitRow{1, 0.5, up, {0.2603, 0.2279, 0.7722, 0.4060, 1.6020, 0.2135}},
                    LimitRow{1, 0.5, down, {0.8472, 1.1389, 2.5506, 0.7979, 1.5648, 2.1047}},
                    LimitRow{1, 0.1, down, {1.2963, 1.7329, 2.9878, 1.2204, 2.4411, 2.5184}},
                    LimitRow{2, 1.0, up, {0.0475, 0.0483, 0.2189, 0.0515, 0.3462, 0.0714}},
                    LimitRow{2, 0.5, down, {0.1271, 0.1274, 0.5665, 0.1409, 0.9526, 0.1810}},
                    LimitRow{2, 0.1, up, {0.9164, 0.8429, 3.2137, 0.8077, 6.7271, 0.9701}}));

TEST(Floquet, SaysHopfOrFlip) {
  const auto modes = insperger_modes(1);
  const auto flip = depth_limit(insperger(down, 0.1), modes, 7000.0 * rpm, 1e-4, 5e-3);
  ASSERT_TRUE(flip);
  EXPECT_EQ(flip->at.kind(), Bifurcation::flip);
  // Two teeth at 7000 rpm pass at 233.3 Hz: half of it, and odd multiples; the fourth is nearest to 922 Hz.
  EXPECT_NEAR(flip->at.frequency, 3.5 * 7000.0 / 30.0, 1e-6);
  const auto hopf = depth_limit(insperger(), modes, 5000.0 * rpm, 1e-4, 5e-3);
  ASSERT_TRUE(hopf);
  EXPECT_EQ(hopf->at.kind(), Bifurcation::hopf);
  EXPECT_GT(hopf->at.frequency, 922.0);
  EXPECT_LT(hopf->at.frequency, 1.2 * 922.0);
}

TEST(Floquet, FrequencyIsThatOfZeroOrderWhereThatIsNear) {
  const auto modes = spindle_modes();
  const MillingCut cut = spindle_cut(1.0);
  const auto zero = zero_order_limit(cut, modes, 18000.0 * rpm);
  const auto floquet = depth_limit(cut, modes, 18000.0 * rpm, 1e-4, 5e-3);
  ASSERT_TRUE(zero && floquet);
  EXPECT_NEAR(floquet->at.frequency, zero->frequency / (2.0 * std::numbers::pi), 2.0);
}

TEST(ZeroOrder, LimitsOfASpindle) {
  const std::array speed{5000.0, 7500.0, 10000.0, 12000.0, 14000.0, 18000.0};
  struct Row {
    double immersion, minimum;
    std::array<double, 6> zero, floquet;
  };
  for (const Row& row : {Row{0.5,
                             1.0868,
                             {1.0870, 1.1717, 1.3396, 4.0335, 2.7915, 1.2465},
                             {1.0974, 1.1616, 1.3650, 4.2911, 2.7426, 1.2476}},
                         Row{1.0,
                             0.7774,
                             {0.7798, 0.8091, 0.9556, 2.6888, 1.8890, 0.8643},
                             {0.7880, 0.8066, 0.9679, 2.7645, 1.8492, 0.8634}}}) {
    const MillingCut cut = spindle_cut(row.immersion);
    const auto modes = spindle_modes();
    EXPECT_NEAR(1e3 * zero_order_minimum(cut, modes, 100.0)->depth, row.minimum, 1e-3 * row.minimum);
    for (std::size_t i = 0; i < speed.size(); ++i) {
      EXPECT_NEAR(1e3 * zero_order_limit(cut, modes, speed[i] * rpm)->depth, row.zero[i], 5e-4 * row.zero[i]);
      EXPECT_NEAR(limit_mm(cut, modes, speed[i], 2e-4), row.floquet[i], 5e-4 * row.floquet[i]);
    }
  }
}

TEST(ZeroOrder, NoLimitAlongTheAxis) {
  // A flat end that moves along its axis cuts the same chips.
  Mode along = insperger_modes(1).front();
  along.direction = Vec3::UnitZ();
  const MillingCut cut = milling_cut(2, 6e8, 2e8, up, 0.1);
  EXPECT_FALSE(zero_order_limit(cut, std::vector{along}, 5000.0 * rpm));
  EXPECT_FALSE(zero_order_minimum(cut, std::vector{along}, 5000.0 * rpm));
}

TEST(ZeroOrder, NoLimitWithoutModes) {
  const MillingCut cut = milling_cut(2, 6e8, 2e8, up, 0.1);
  EXPECT_FALSE(zero_order_limit(cut, {}, 5000.0 * rpm));
  EXPECT_FALSE(zero_order_minimum(cut, {}, 5000.0 * rpm));
}

TEST(Floquet, APartThatVibratesIsAToolThatDoes) {
  std::vector<Mode> modes = spindle_modes();
  const double radius = spectral_radius(spindle_cut(0.5), modes, 9000.0 * rpm, 1e-3);
  for (Mode& mode : modes) mode.of = Mode::Of::part;
  EXPECT_NEAR(spectral_radius(spindle_cut(0.5), modes, 9000.0 * rpm, 1e-3), radius, 1e-10);
  modes[0].of = Mode::Of::tool; // modes that are not coupled by inertia: the signs go out
  EXPECT_NEAR(spectral_radius(spindle_cut(0.5), modes, 9000.0 * rpm, 1e-3), radius, 1e-10);
}

// An independent way: the delayed equations marched in small steps, with slices along the edge.
class Marched : public testing::TestWithParam<int> {};

TEST_P(Marched, GrowthIsTheSpectralRadius) {
  MillingCut cut = milling_cut(3, 7e8, 2e8, down, 0.4);
  std::vector<Mode> modes = spindle_modes();
  double depth = 2e-3, speed = 4000.0 * rpm;
  if (GetParam() >= 1) cut.cutter.helix = 0.6, depth = 9e-3;
  if (GetParam() >= 2) {
    cut.cutter.pitch = {1.9, 2.3, 2.0 * std::numbers::pi - 4.2};
    modes.push_back({.of = Mode::Of::part,
                     .frequency = 1100.0,
                     .damping = 0.02,
                     .stiffness = 8e6,
                     .direction = Vec3(0.6, 0.6, 0.5).normalized()});
  }
  if (GetParam() == 3) { // two and two alike: the pattern repeats after half a turn
    cut.cutter.pitch = {1.4, std::numbers::pi - 1.4, 1.4, std::numbers::pi - 1.4};
    speed = 3000.0 * rpm;
  }
  if (GetParam() >= 4) { // a ball, a bull: chips of what moves along the axis, less of the tip in the cut
    cut.cutter.corner = GetParam() == 4 ? cut.cutter.radius() : 0.4 * cut.cutter.radius();
    if (GetParam() == 5) cut.engagement.side = up;
    depth = GetParam() == 4 ? 3e-3 : 2.3e-3;
    modes.push_back({.of = Mode::Of::tool,
                     .frequency = 800.0,
                     .damping = 0.03,
                     .stiffness = 4e6,
                     .direction = Vec3::UnitZ()});
  }
  const double turns = cut.cutter.pattern() == 1   ? static_cast<double>(cut.cutter.teeth())
                       : cut.cutter.pattern() == 2 ? 2.0
                                                   : 1.0;
  const double radius = std::pow(spectral_radius(cut, modes, speed, depth), turns); // over a whole turn
  EXPECT_NEAR(marched_growth(cut, modes, speed, depth) / radius, 1.0, 2e-3) << radius;
}

INSTANTIATE_TEST_SUITE_P(Of, Marched, testing::Range(0, 6));

// Without forces but those of the edge: in down-milling it leaves the cut earlier by Δy/f, in up-milling it
// comes as much earlier, an impulse −Kre b Δy/(f Ω) in y once a tooth. Between, the mode is free.
class EdgeImpulse : public testing::TestWithParam<Engagement::Side> {};

TEST_P(EdgeImpulse, IsThatOfAnEdgeThatComesAndGoes) {
  MillingCut cut = milling_cut(2, 0.0, 0.0, GetParam(), 0.2);
  LinearLaw law;
  law.Kre = 26.6e3;
  cut.law = CuttingLaw(law);
  const Mode mode = insperger_modes(2).back(); // along y
  const double spindle = 8700.0 * rpm, T = std::numbers::pi / spindle, w = mode.omega(), z = mode.damping,
               wd = w * std::sqrt(1.0 - z * z), c = std::cos(wd * T), s = std::sin(wd * T) / wd,
               decay = std::exp(-z * w * T);
  EXPECT_NEAR(spectral_radius(cut, std::vector{mode}, spindle, 2e-3), decay, 1e-6); // nothing regenerates
  bool grows = false;
  for (const double depth : {0.5e-3, 2e-3, 5e-3}) {
    // (y, v, y of the tooth before) just before an impulse.
    Eigen::Matrix3d kick = Eigen::Matrix3d::Identity(), free = Eigen::Matrix3d::Zero();
    const double g = law.Kre * depth / (cut.feed * spindle) / (mode.stiffness / (w * w));
    kick.row(1) << -g, 1.0, g;
    kick.row(2) << 1.0, 0.0, 0.0;
    free.topLeftCorner<2, 2>() << c + z * w * s, s, -w * w * s, c - z * w * s;
    free.topLeftCorner<2, 2>() *= decay;
    free(2, 2) = 1.0;
    const double exact = Eigen::Matrix3d(free * kick).eigenvalues().cwiseAbs().maxCoeff();
    EXPECT_NEAR(spectral_radius(with_edge_forces(cut), std::vector{mode}, spindle, depth), exact,
                2e-3 * std::abs(exact - decay));
    grows |= exact > 1.0;
  }
  EXPECT_TRUE(grows);
}

INSTANTIATE_TEST_SUITE_P(Of, EdgeImpulse, testing::Values(up, down));

TEST(Chart, IsTheSameWithAnyNumberOfThreads) {
  const auto modes = insperger_modes(2);
  const MillingCut cut = insperger(down, 0.5);
  std::vector<StabilityChart> charts;
  for (const int threads : {1, 3}) {
    const ThreadCount count(threads);
    charts.push_back(stability_chart(cut, modes, 5000.0 * rpm, 9000.0 * rpm, 9, 1e-3, 10));
  }
  EXPECT_EQ(charts[0].radius, charts[1].radius);
  ASSERT_TRUE(charts[0].limit[0]);
  EXPECT_NEAR(1e3 * charts[0].limit[0]->depth, 0.1271, 1e-4);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(charts[0].limit[i]->depth, charts[1].limit[i]->depth);
  const auto better = nearest_speed(charts[0], 7400.0 * rpm, 0.5e-3);
  ASSERT_TRUE(better);
  EXPECT_NEAR(charts[0].speed[*better] / rpm, 7000.0, 1e-6);
  EXPECT_FALSE(nearest_speed(charts[0], 8000.0 * rpm, 0.99e-3).has_value());
}

TEST(LargestEigenvalue, OfAMatrix) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(70, 70);
  for (Eigen::Index i = 0; i < 70; ++i) matrix.col(i) *= std::pow(0.8, static_cast<double>(i));
  matrix(0, 0) = 5.0;
  const Eigenpair pair = largest_eigenvalue(
      [&](const Eigen::VectorXd& from, Eigen::VectorXd& to) { to = matrix * from; }, 70, 1e-12);
  EXPECT_LT((matrix * pair.vector - pair.value * pair.vector).norm(), 1e-8);
}

} // namespace
} // namespace cnem::machining
