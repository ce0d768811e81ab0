#pragma once
// Forecasts of cases, and whether their runs take what was foretold.
#include "app/forecast/forecast.hpp"
#include "app/run.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"
#include "tests/solver_of.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace cnem::app {

template<int dim = 2> Forecast expected_of(const input::Case& input) {
  ExplicitSolver<dim> solver = testing::solver_of<dim>(input);
  StepControl control(input.time);
  control.refresh(solver);
  return forecast(input, solver, control);
}

/// Within 1.5 in steps, nodes at the end and nodes in the mean.
template<int dim = 2> void expect_that_it_fits_its_run(const input::Case& input) {
  const Forecast expected = expected_of<dim>(input);
  const testing::TemporaryFolder folder("forecast");
  ASSERT_EQ(run(input, {.output = folder.path() / "results", .threads = 1, .version = "test"}), Exit::done);
  const results::RunStatus status = results::read_status(folder.path() / "results");
  const auto steps = static_cast<double>(status.steps);
  for (const auto& [foretold, taken] :
       {std::pair{expected.steps, steps},
        {expected.nodes_last, static_cast<double>(status.nodes)},
        {expected.nodes_mean, static_cast<double>(status.node_steps) / steps}}) {
    EXPECT_LT(foretold, 1.5 * taken);
    EXPECT_GT(foretold, taken / 1.5);
  }
}

} // namespace cnem::app
