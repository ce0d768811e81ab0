// What a body does must not depend on where it is.
#include "app/run.hpp"
#include "app/simulation.hpp"
#include "app/statics/static_model.hpp"
#include "input/case_reader.hpp"
#include "results/fields.hpp"
#include "results/history_writer.hpp"
#include "tests/solver_of.hpp"
#include "tests/temporary_folder.hpp"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

/// A block of 2^-7 m with its lower left corner at (x, y) m, where every number of the case is one of the
/// machine.
std::string block_at(double x, double y, const std::string& more) {
  constexpr double side = 0.0078125;
  return fmt::format(R"(time.end = "4 us"
domain = {{ material = "steel", outer.rectangle = {{ from = "{} {} m", to = "{} {} m" }} }}
cloud = {{ pattern = "jittered", spacing = "0.6 mm" }}
materials.steel = {{ density = "7850 kg/m3", elastic = {{ young = "210 GPa", poisson = 0.3 }} }}
output.history_every = "0.1 us"
output.pictures = []
)",
                     x, y, x + side, y + side) +
         more;
}

const std::vector<Vec2> far_places{{0.00390625, 0.00390625}, {0.0625, 0.0625}, {1.0, 1.0},
                                   {128.0, -128.0},          {8192.0, 8192.0}, {1e4, 0.0}};

/// Stretched along x at 1/s, held along y: the exact velocity everywhere.
std::string stretched(const Vec2& x, double rate) {
  return block_at(x.x(), x.y(),
                  fmt::format(R"(initial.velocity_gradient = {{ xx = "{0} 1/s", centre = "{1} {2} m" }}
method.bulk_viscosity = {{ linear = 0.0, quadratic = 0.0 }}
boundary.left = {{ pieces = ["left"], symmetry = true }}
boundary.sides = {{ pieces = ["bottom", "top"], symmetry = true }}
boundary.right = {{ pieces = ["right"], velocity = {{ x = "{3} m/s" }} }}
)",
                              rate, x.x(), x.y(), rate * 0.0078125));
}

TEST(FarFromOrigin, the_patch_test_holds_in_dynamics) {
  constexpr double rate = 1000.0, dt = 2e-8, lambda_2mu = 210e9 * 0.7 / (1.3 * 0.4);
  for (const int renew_every : {1000, 7})
    for (const Vec2& place : far_places) {
      const input::Case input = input::read_case_text(stretched(place, rate), "case.toml");
      ExplicitSolver<2> solver = testing::solver_of(input);
      for (int step = 1; step <= 100; ++step) {
        if (step % renew_every == 0) solver.prepare();
        solver.advance(dt);
      }
      const double stretch = 1.0 + rate * solver.state().time;
      const double exact = lambda_2mu * std::log(stretch) / stretch;
      double worst = 0.0;
      for (const double stress : results::values_at_points(results::snapshot(solver), "stress_xx"))
        worst = std::max(worst, std::abs(stress / exact - 1.0));
      EXPECT_LT(worst, 1e-9) << place.transpose() << ", renewed every " << renew_every << " steps";
    }
}

TEST(FarFromOrigin, the_patch_test_holds_in_statics) {
  // Uniaxial stress in plane strain.
  constexpr double strain = 1e-3, exact = 210e9 / (1.0 - 0.09) * strain;
  for (const Vec2& place : far_places) {
    const input::Case input = input::read_case_text(block_at(place.x(), place.y(), R"(analysis.type = "static"
boundary.left = { pieces = ["left"], symmetry = true }
boundary.bottom = { pieces = ["bottom"], symmetry = true }
boundary.right = { pieces = ["right"], displacement = { x = "7.8125 um" } }
)"),
                                                    "case.toml");
    const StaticModel<2> model(input);
    const StaticSolution<2> solution = solve_statics(model.problem());
    double worst = 0.0;
    for (const double stress : solution.stress[0]) worst = std::max(worst, std::abs(stress / exact - 1.0));
    for (const std::size_t k : {1U, 3U})
      for (const double stress : solution.stress[k]) worst = std::max(worst, std::abs(stress / exact));
    EXPECT_LT(worst, 1e-9) << place.transpose();
    EXPECT_LT(solution.residual, 1e-9) << place.transpose();
  }
}

class FarRun : public ::testing::Test {
protected:
  /// The run of a case; its history.
  results::HistoryTable run_case(const std::string& text) {
    const auto file = temporary.path() / "far.toml";
    std::ofstream(file) << text;
    RunOptions options;
    options.output = temporary.path() / "out";
    options.force = true;
    EXPECT_EQ(run(input::read_case(file.string()), options), Exit::done);
    status = results::read_status(options.output);
    return results::read_history(options.output / "history.csv");
  }
  static std::vector<double> column(const results::HistoryTable& history, const std::string& name) {
    const int k = history.find(name);
    EXPECT_GE(k, 0) << name;
    return history.column.at(static_cast<std::size_t>(k));
  }
  const cnem::testing::TemporaryFolder temporary{"far_from_origin"};
  results::RunStatus status;
};

TEST_F(FarRun, an_unloaded_body_stays_at_rest) {
  for (const Vec2& place : far_places) {
    const results::HistoryTable history = run_case(block_at(place.x(), place.y(), ""));
    EXPECT_LT(status.energy_residual, 1e-5) << place.transpose();
    EXPECT_LT(column(history, "energy.elastic[J/m]").back(), 1e-18) << place.transpose();
  }
}

TEST_F(FarRun, tools_press_as_at_the_origin) {
  const auto pressed = [&](double x, double y) {
    return run_case(block_at(x, y,
                             fmt::format(R"(method = {{ lagrangian = "periodic", rereference.every = 20 }}
boundary.bottom = {{ pieces = ["bottom"], symmetry = true }}
[tools.punch]
circle = {{ centre = "{} {} m", radius = "0.00390625 m" }}
velocity = "0 -20 m/s"
friction = {{ law = "coulomb", coefficient = 0.2 }}
)",
                                         x + 0.005859375, y + 0.01171875)));
  };
  const results::HistoryTable near = pressed(0, 0);
  for (const double x : {1.0, 128.0, 8192.0}) {
    const results::HistoryTable far = pressed(x, -x);
    for (const char* name : {"punch.force_x[N/m]", "punch.force_y[N/m]"}) {
      const std::vector<double> expected = column(near, name), found = column(far, name);
      ASSERT_EQ(expected.size(), found.size());
      EXPECT_GT(std::abs(expected.back()), 1e3);
      EXPECT_NEAR(found.back() / expected.back(), 1.0, 1e-8) << name << " at " << x;
    }
  }
}

TEST_F(FarRun, results_say_where_the_body_is) {
  run_case(block_at(8192.0, 1.0, R"(boundary.left = { pieces = ["left"], symmetry = true }
output.lines.middle = { from = "8192.001 1.004 m", to = "8192.002 1.004 m", samples = 2, fields = ["pressure"] }
)"));
  std::ifstream lines(temporary.path() / "out" / "lines" / "middle.csv");
  std::string header, first;
  std::getline(lines, header);
  std::getline(lines, first);
  double distance = -1.0, x = 0.0, y = 0.0;
  ASSERT_EQ(std::sscanf(first.c_str(), "%lf,%lf,%lf", &distance, &x, &y), 3) << first;
  EXPECT_NEAR(x, 8192.001, 1e-9);
  EXPECT_NEAR(y, 1.004, 1e-12);
}

} // namespace
} // namespace cnem::app
