// Cutting laws from orthogonal cuts: made-up ones come back.
#include "machining/cutting_law.hpp"
#include "machining/orthogonal_fit.hpp"

#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace cnem::machining {
namespace {

constexpr double one_degree = std::numbers::pi / 180.0;

/// Forces of a linear law with Gaussian noise.
struct MadeUp {
  double Ktc = 767e6, Krc = 168.8e6, Kte = 27.7e3, Kre = 26.6e3;
  double own = 0.0;     ///< relative error that cuts know of
  double between = 0.0; ///< and that they do not

  std::vector<OrthogonalCut> cuts(unsigned seed, const std::vector<double>& thicknesses) const {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<OrthogonalCut> list;
    for (const double h : thicknesses) {
      OrthogonalCut cut{.name = "cut", .thickness = h, .speed = 2.0, .rake = 10.0 * one_degree};
      for (const auto& [force, exact] :
           {std::pair{&cut.tangential, Ktc * h + Kte}, {&cut.radial, Krc * h + Kre}})
        *force = {exact * (1.0 + std::hypot(own, between) * normal(engine)), own * exact};
      cut.chip_thickness = 2.0 * h * (1.0 + std::hypot(own, between) * normal(engine));
      list.push_back(cut);
    }
    return list;
  }
};

const std::vector<double> eight{0.03e-3, 0.05e-3, 0.08e-3, 0.1e-3, 0.12e-3, 0.15e-3, 0.18e-3, 0.2e-3};

TEST(LineFit, IsExactOnALine) {
  const std::vector<double> x{1, 2, 4}, y{5, 7, 11}, e{0.1, 0.2, 0.1};
  const LineFit line = fit_line(x, y, e);
  EXPECT_NEAR(line.intercept.value, 3.0, 1e-12);
  EXPECT_NEAR(line.slope.value, 2.0, 1e-12);
  EXPECT_NEAR(line.r_squared, 1.0, 1e-12);
  EXPECT_EQ(line.between, 0.0);
  // (XᵀWX)⁻¹ by hand: weights 100, 25, 100.
  const double n = 225, sx = 550, sxx = 1800, d = n * sxx - sx * sx;
  EXPECT_NEAR(line.slope.error, std::sqrt(n / d), 1e-12);
  EXPECT_NEAR(line.intercept.error, std::sqrt(sxx / d), 1e-12);
  EXPECT_NEAR(line.covariance, -sx / d, 1e-12);
}

TEST(LineFit, FindsTheScatterThatErrorsDoNotExplain) {
  const std::vector<double> x{1, 2, 3, 4, 5, 6}, y{1.2, 1.8, 3.2, 3.8, 5.2, 5.8}, none(6, 0.0);
  const LineFit line = fit_line(x, y, none);
  double squares = 0.0;
  for (const double r : line.residual) squares += r * r;
  EXPECT_NEAR(line.between, std::sqrt(squares / 4.0), 1e-9) << "ordinary least squares without errors";
  EXPECT_NEAR(line.slope.error, line.between / std::sqrt(17.5), 1e-9);
}

TEST(LineFit, OfTwoPointsHasTheirErrorsOrNone) {
  const std::vector<double> x{1, 2}, y{1, 3}, e{0.3, 0.4}, none(2, 0.0);
  EXPECT_NEAR(fit_line(x, y, e).slope.error, 0.5, 1e-12);
  EXPECT_NEAR(fit_line(x, y, none).slope.value, 2.0, 1e-12);
  EXPECT_TRUE(std::isnan(fit_line(x, y, none).slope.error));
}

/// Shares of 400 sets in which the truth is within one and two standard errors.
std::pair<double, double> coverage(const MadeUp& made, double truth, Estimate (*of)(const LinearFit&)) {
  int one = 0, two = 0;
  constexpr int sets = 400;
  for (unsigned seed = 1; seed <= sets; ++seed) {
    const Estimate estimate = of(fit_linear(made.cuts(seed, eight)));
    one += std::abs(estimate.value - truth) < estimate.error;
    two += std::abs(estimate.value - truth) < 2.0 * estimate.error;
  }
  return {one / double(sets), two / double(sets)};
}

TEST(OrthogonalFit, MadeUpCutsComeBackWithinTheirStandardErrors) {
  // Six degrees of freedom: Student's t has 64.4% within one and 90.8% within two; known errors 68.3
  // and 95.4%.
  for (const MadeUp& made :
       {MadeUp{.own = 0.02}, MadeUp{.between = 0.02}, MadeUp{.own = 0.01, .between = 0.02}}) {
    const auto ktc = coverage(made, made.Ktc, [](const LinearFit& fit) { return fit.tangential.slope; });
    const auto kre = coverage(made, made.Kre, [](const LinearFit& fit) { return fit.radial.intercept; });
    for (const auto& [one, two] : {ktc, kre}) {
      EXPECT_GT(one, 0.58);
      EXPECT_LT(one, 0.78);
      EXPECT_GT(two, 0.87);
      EXPECT_LT(two, 0.99);
    }
  }
}

TEST(OrthogonalFit, KienzleComesBack) {
  std::vector<OrthogonalCut> cuts = MadeUp{}.cuts(1, eight);
  for (OrthogonalCut& cut : cuts) {
    cut.tangential.value = 1.8e9 * 1e-3 * std::pow(cut.thickness / 1e-3, 0.75);
    cut.radial.value = -0.3e9 * 1e-3 * std::pow(cut.thickness / 1e-3, 0.6);
  }
  const auto fit = fit_kienzle(cuts);
  ASSERT_TRUE(fit && fit->radial);
  EXPECT_NEAR(fit->tangential.pressure.value, 1.8e9, 1.0);
  EXPECT_NEAR(fit->tangential.exponent.value, 0.25, 1e-12);
  EXPECT_NEAR(fit->radial->pressure.value, -0.3e9, 1.0);
  EXPECT_NEAR(fit->radial->exponent.value, 0.4, 1e-12);
  EXPECT_NEAR(fit->tangential.r_squared, 1.0, 1e-12);
  for (OrthogonalCut& cut : cuts) cut.tangential.value = 1e15 * cut.thickness * cut.thickness;
  EXPECT_EQ(fit_kienzle(cuts)->tangential.exponent.value, 0.0) << "no pressure grows with h";
  cuts.front().tangential.value = -1.0;
  EXPECT_FALSE(fit_kienzle(cuts));
}

TEST(OrthogonalFit, ShearPlaneGivesTheLinearLawBack) {
  const auto cuts = MadeUp{}.cuts(1, eight);
  const LinearFit linear = fit_linear(cuts);
  const auto plane = fit_shear_plane(cuts, linear);
  ASSERT_TRUE(plane);
  ObliqueLaw law;
  law.shear_stress = plane->shear_stress.value;
  law.friction_angle = plane->friction_angle.value;
  law.rake = 10.0 * one_degree;
  law.chip_ratio = plane->chip_ratio.value;
  law.inclination = 0.0;
  EXPECT_NEAR(law.pressures(1e-4)[0], 767e6, 1.0);
  EXPECT_NEAR(law.pressures(1e-4)[1], 168.8e6, 1.0);
  EXPECT_NEAR(std::tan(plane->shear_angle.value), 0.5 * std::cos(law.rake) / (1.0 - 0.5 * std::sin(law.rake)),
              1e-12);
}

TEST(OrthogonalFit, AnEdgeThatPullsIsNone) {
  MadeUp made;
  made.Kte = -2e3;
  const LinearFit fit = fit_linear(made.cuts(1, eight));
  EXPECT_TRUE(fit.no_edge_force);
  EXPECT_EQ(fit.tangential.intercept.value, 0.0);
  EXPECT_EQ(fit.tangential.degrees, 7);
}

TEST(OrthogonalFit, GroupsAndTablesOverRakesAndSpeeds) {
  std::vector<OrthogonalCut> cuts;
  for (const double rake : {10.0, 0.0})
    for (const double speed : {4.0, 2.0})
      for (const double h : {2e-4, 1e-4}) {
        OrthogonalCut cut{.name = "", .thickness = h, .speed = speed * (1.0 + h), .rake = rake * one_degree};
        cut.tangential.value = 1e9 * h + 1e3 * speed - 100.0 * rake;
        cuts.push_back(cut);
      }
  const auto groups = groups_of(cuts);
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_NEAR(groups[1].rake, 0.0, 1e-12);
  EXPECT_NEAR(groups[1].speed, 4.0, 1e-2);
  const auto table = table_of(groups);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->thickness, (std::vector{1e-4, 2e-4}));
  const std::vector<double> expected{102e3, 202e3, 104e3, 204e3, 101e3, 201e3, 103e3, 203e3};
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(table->tangential[k], expected[k], 1e-6);
  cuts.pop_back();
  EXPECT_FALSE(table_of(groups_of(cuts)));
}

} // namespace
} // namespace cnem::machining
