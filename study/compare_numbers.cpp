// What a comparison says in numbers.
#include "core/index.hpp"
#include "report/html.hpp"
#include "results/fields.hpp"
#include "study/compare.hpp"
#include "study/page.hpp"
#include "study/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace cnem::study {

namespace {

using Number = std::optional<double>;
using Shown = ComparedNumber::Shown;

/// A number of status.json.
Number of_status(const Outcome& outcome, const std::string& name) {
  return outcome.status ? status_number(*outcome.status, name) : std::nullopt;
}

/// None where the divisor is 0 or one of them is not known.
Number ratio(Number a, Number b, double factor) {
  if (!a || !b || !(*b > 0.0)) return {};
  return factor * *a / *b;
}

template<class Value>
ComparedNumber number(const Compared& compared, std::string name, std::string label, Shown shown,
                      Value&& value) {
  ComparedNumber result{{std::move(name), {}}, std::move(label), shown};
  if (shown == Shown::unit) result.unit = results::split_column_name(result.name).unit;
  for (const Outcome& outcome : compared.outcome) result.value.push_back(value(outcome));
  return result;
}

ComparedNumber from_status(const Compared& compared, const std::string& name, std::string label, Shown shown,
                           std::string column) {
  return number(compared, std::move(column), std::move(label), shown,
                [&](const Outcome& outcome) { return of_status(outcome, name); });
}

/// The unit of a column that some run has, "" where none has it.
std::string unit_of(const Compared& compared, const std::string& column) {
  for (const Outcome& outcome : compared.outcome)
    if (const int at = outcome.history.find(column); at >= 0)
      return results::split_column_name(outcome.history.names[index_of(at)]).unit;
  return "";
}

/// The last value of a column, of a run that is done.
Number at_the_end(const Outcome& outcome, const std::string& column) {
  const int at = outcome.history.find(column);
  return at < 0 || !outcome.done() ? Number() : outcome.history.column[index_of(at)].back();
}

void add_forces(const Compared& compared, std::vector<ComparedNumber>& numbers) {
  if (!compared.force) return;
  const std::string& of = compared.force->of;
  std::vector<Number> largest, work;
  for (const Outcome& outcome : compared.outcome) {
    largest.emplace_back();
    work.emplace_back();
    if (outcome.history.rows() < 2) continue;
    const evaluate::ForceCurve curve = evaluate::force_curve(outcome.history, *compared.force);
    largest.back() = std::abs(curve.smooth[curve.largest]);
    if (std::isfinite(curve.work)) work.back() = curve.work;
  }
  const std::string force_unit = unit_of(compared, of + ".force_x"),
                    work_unit = unit_of(compared, of + ".work");
  numbers.push_back({{fmt::format("largest_force[{}]", force_unit), std::move(largest)},
                     "Largest force of " + in_words(of),
                     Shown::unit,
                     force_unit});
  if (compared.force->over_stroke)
    numbers.push_back({{fmt::format("work[{}]", work_unit), std::move(work)},
                       "Work of " + in_words(of),
                       Shown::unit,
                       work_unit});
}

} // namespace

std::string in_words(std::string name) {
  std::replace(name.begin(), name.end(), '.', ' ');
  return report::words(std::move(name));
}

std::vector<ComparedNumber> compared_numbers(const Compared& compared) {
  std::vector<ComparedNumber> numbers{
      from_status(compared, "nodes", "Nodes", Shown::count, "nodes"),
      from_status(compared, "points", "Stress points", Shown::count, "points"),
      from_status(compared, "steps", "Steps", Shown::count, "steps"),
      from_status(compared, "time", "Simulated", Shown::unit, "time[s]"),
      number(compared, "mean_step[s]", "Mean time step", Shown::unit,
             [](const Outcome& o) { return ratio(of_status(o, "time"), of_status(o, "steps"), 1.0); }),
      from_status(compared, "wall_s.total", "Wall time", Shown::duration, "wall[s]"),
      from_status(compared, "cpu_s", "CPU time", Shown::duration, "cpu[s]"),
      number(compared, "cost[ns]", "Cost of a node-step", Shown::unit,
             [](const Outcome& o) -> Number {
               const Number step = of_status(o, "wall_s.step"), rebuild = of_status(o, "wall_s.rebuild");
               if (!step || !rebuild) return {};
               return ratio(*step + *rebuild, of_status(o, "node_steps"), 1e9);
             }),
      from_status(compared, "energy_residual", "Energy residual", Shown::percent, "energy_residual")};
  add_forces(compared, numbers);
  return numbers;
}

std::vector<ComparedNumber> compared_metrics(const Compared& compared) {
  std::vector<ComparedNumber> metrics;
  std::set<std::string> known;
  for (const Outcome& outcome : compared.outcome)
    for (const std::string& header : outcome.history.names) {
      const results::ColumnName column = results::split_column_name(header);
      if (!column.name.starts_with("probe.") || !known.insert(header).second) continue;
      metrics.push_back(number(compared, header, in_words(column.name) + " at the end", Shown::unit,
                               [&](const Outcome& o) { return at_the_end(o, header); }));
    }
  for (const Outcome& outcome : compared.outcome)
    if (outcome.status)
      for (const auto& [name, value] : outcome.status->metrics)
        if (known.insert(name).second) {
          const std::string unit = outcome.status->unit_of(name);
          metrics.push_back(from_status(compared, "metrics." + name, in_words(name),
                                        unit.empty() ? Shown::plain : Shown::unit,
                                        results::with_unit(name, unit)));
        }
  return metrics;
}

std::string compare_table(const Compared& compared) {
  std::vector<NumberColumn> columns;
  for (const ComparedNumber& known : compared_numbers(compared)) columns.push_back(known);
  for (const ComparedNumber& metric : compared_metrics(compared)) columns.push_back(metric);
  std::vector<RunRecord> runs;
  for (const Outcome& outcome : compared.outcome) runs.push_back(outcome.record);
  return csv_table(compared.study, runs, columns);
}

} // namespace cnem::study
