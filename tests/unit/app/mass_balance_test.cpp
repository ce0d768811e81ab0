// Mass and volume of cells on new references without adaptation: what keeps them together, and who tells when
// they are not.
#include "app/watches/mass_balance.hpp"

#include "app/adaptation.hpp"
#include "app/simulation.hpp"
#include "input/case_reader.hpp"
#include "tests/shared_cases.hpp"
#include "tests/solver_of.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numeric>

namespace cnem::app {
namespace {

/// Sheared by 1/20 a step of a picosecond, in which no wave gets anywhere.
const std::string sheared = testing::free_block + R"toml(
[cloud.refine.corner]
points = ["0 0 mm"]
spacing = "0.02 mm"
[time]
end = "1 ns"
[initial]
velocity_gradient.xy = "5e10 1/s"
)toml";

constexpr double step = 1e-12; // s

class MassBalance : public ::testing::TestWithParam<const char*> {
protected:
  const input::Case input =
      input::read_case_text(fmt::format("{}[method]\nname = \"{}\"\n", sheared, GetParam()), "case.toml");
};

double sum(const Field& field) { return std::accumulate(field.begin(), field.end(), 0.0); }

TEST_P(MassBalance, is_watched) {
  ExplicitSolver<2> solver = testing::solver_of(input);
  MassBalanceWatch watch;
  watch.look(solver);
  EXPECT_EQ(watch.warning(), "");
  for (int k = 0; k < 80; ++k) {
    solver.advance(step);
    if (k % 5 == 4) solver.prepare();
    watch.look(solver);
    const auto [low, high] = solver.mass_balance();
    ASSERT_EQ(watch.warning().empty(), low >= 0.5 && high <= 2.0) << low << ", " << high;
    if (watch.warning().empty()) continue;
    for (const char* part : {"the cell of node ", "times the mass", "step ", "t = "})
      EXPECT_NE(watch.warning().find(part), std::string::npos) << watch.warning();
    const std::string first = watch.warning();
    solver.advance(step);
    watch.look(solver);
    EXPECT_EQ(watch.warning(), first) << "it is told once";
    return;
  }
  FAIL() << "the two stay together";
}

TEST_P(MassBalance, is_kept_on_new_references_without_adaptation) {
  ExplicitSolver<2> solver = testing::solver_of(input), left_alone = testing::solver_of(input);
  Adaptation adaptation(input, solver);
  ASSERT_FALSE(adaptation.active());
  const double mass = sum(solver.state().node.mass);
  const auto momentum = [&] {
    double total = 0.0;
    for (std::size_t i = 0; i < solver.state().node.size(); ++i)
      total += solver.state().node.mass[i] * solver.state().node.velocity[0][i];
    return total;
  };
  double apart = 1.0;
  for (int k = 0; k < 80; ++k) {
    for (ExplicitSolver<2>* one : {&solver, &left_alone}) one->advance(step);
    if (k % 5 != 4) continue;
    const double before = momentum();
    adaptation.balance(solver);
    left_alone.prepare();
    EXPECT_NEAR(momentum(), before, 1e-12 * std::abs(before));
    const auto [low, high] = solver.mass_balance();
    EXPECT_GT(low, 0.75);
    EXPECT_LT(high, 1.3);
    apart = std::max(apart, left_alone.mass_balance()[1]);
  }
  EXPECT_GT(apart, 2.0);
  EXPECT_NEAR(sum(solver.state().node.mass), mass, 1e-13 * mass);
  EXPECT_GT(adaptation.metrics().front().second, 10.0);
  const EnergyLedger ledger = solver.ledger();
  EXPECT_GE(ledger["resampling"], 0.0);
  EXPECT_EQ(solver.references(), left_alone.references());
}

INSTANTIATE_TEST_SUITE_P(of, MassBalance, ::testing::Values("cnem", "fe-triangles"), [](const auto& test) {
  return std::string(test.param == std::string("cnem") ? "cells" : "triangles");
});

} // namespace
} // namespace cnem::app
