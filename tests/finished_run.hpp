#pragma once
// A run to its end in a folder of its own, and what it left there.
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cnem::testing {

struct FinishedRun {
  /// events: changes of the cloud, none without adaptation; no history of what is not stepped
  results::HistoryTable history, events;
  results::RunStatus status;

  /// A column of the history or of the changes, by its name with or without the unit.
  const std::vector<double>& of(const std::string& name) const { return find(history, name); }
  const std::vector<double>& of_changes(const std::string& name) const { return find(events, name); }
  /// Mean of a column of the history over time, s: by trapezoids between its rows, of which there are some
  /// before and after.
  double mean(const std::string& name, double from, double to) const {
    const std::vector<double>&time = of("time"), &value = of(name);
    double integral = 0.0;
    for (std::size_t r = 1; r < time.size(); ++r) {
      const double begin = std::max(time[r - 1], from), end = std::min(time[r], to);
      if (!(begin < end)) continue;
      const double slope = (value[r] - value[r - 1]) / (time[r] - time[r - 1]);
      integral += (end - begin) * (value[r - 1] + slope * (0.5 * (begin + end) - time[r - 1]));
    }
    return integral / (to - from);
  }
  double metric(const std::string& name) const {
    for (const auto& [key, value] : status.metrics)
      if (key == name) return value;
    ADD_FAILURE() << name;
    return 0.0;
  }

private:
  static const std::vector<double>& find(const results::HistoryTable& table, const std::string& name) {
    return table.column.at(static_cast<std::size_t>(table.find(name)));
  }
};

/// Runs the case with one thread, as tests run side by side; one that does not end with 0 is a failure.
inline FinishedRun finish(const input::Case& input) {
  const TemporaryFolder folder("run");
  EXPECT_EQ(app::run(input, {.output = folder.path(), .force = true, .threads = 1, .version = "test"}),
            Exit::done);
  const auto read = [&](const char* name) {
    const std::filesystem::path file = folder.path() / name;
    return std::filesystem::exists(file) ? results::read_history(file) : results::HistoryTable{};
  };
  return {.history = read(results::files::history),
          .events = read(results::files::adaptation),
          .status = results::read_status(folder.path())};
}

/// What every change of the cloud keeps, and the whole run.
inline void expect_nothing_lost(const FinishedRun& done) {
  for (const char* kept : {"mass_error", "momentum_error", "heat_error", "energy_error"})
    EXPECT_LT(done.metric(std::string("adapt.") + kept), 1e-12) << kept;
  EXPECT_LT(std::abs(done.metric("mass_drift")), 1e-12);
  EXPECT_LT(done.status.energy_residual, 3e-3);
}

} // namespace cnem::testing
