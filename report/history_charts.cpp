#include "core/index.hpp"
#include "evaluate/force_stroke.hpp"
#include "report/chart.hpp"
#include "report/html.hpp"
#include "results/si_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace cnem::report {
namespace {

double largest(const std::vector<double>& values) {
  double size = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) size = std::max(size, std::abs(value));
  return size;
}

/// Whether a curve shows anything: some value differs from the first by more than can be seen.
bool moves(const std::vector<double>& values) {
  const double least = 1e-6 * largest(values);
  double first = std::nan("");
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    if (std::isnan(first)) first = value;
    if (std::abs(value - first) > least) return true;
  }
  return false;
}

// Sorts the columns of a history into charts; each column is drawn once.
class Charts {
public:
  Charts(const results::HistoryTable& history, const results::ShownUnits& units)
      : history_(history), units_(units), time_(history.column.front()) {
    for (const char* name : {"time", "step"}) use(history_.find(name));
  }

  std::vector<Chart> all() {
    forces();
    energies();
    groups("max.", [](const std::string& field) { return fmt::format("Largest {}", field); });
    groups("probe.", [](const std::string& field) { return fmt::format("Probes: {}", field); });
    step_size();
    conservation();
    groups("", [](const std::string& field) { return field; });
    return std::move(charts_);
  }

private:
  void use(int column) {
    if (column >= 0) used_.insert(column);
  }
  const std::vector<double>& column(int k) const { return history_.column[index_of(k)]; }
  results::ColumnName name(int k) const { return results::split_column_name(history_.names[index_of(k)]); }
  int columns() const { return static_cast<int>(history_.names.size()); }

  Chart against_time(std::string title, std::string label, std::string unit) const {
    Chart chart;
    chart.title = std::move(title);
    chart.y_label = std::move(label);
    chart.y_unit = std::move(unit);
    return chart;
  }

  ChartSeries series(std::string label, int k, std::size_t colour) const {
    ChartSeries line;
    line.label = std::move(label);
    line.x = time_;
    line.y = column(k);
    line.colour = static_cast<int>(colour);
    return line;
  }

  void forces() {
    std::vector<std::string> tools = evaluate::tools_of(history_);
    const std::string moving = evaluate::moving_tool(history_).value_or("");
    for (std::string& support : evaluate::supports_of(history_)) tools.push_back(std::move(support));
    for (const std::string& tool : tools) {
      use(history_.find(tool + ".stroke"));
      for (const char* motion : {".displacement_x", ".displacement_y", ".displacement_z", ".velocity_x",
                                 ".velocity_y", ".velocity_z"})
        if (const int at = history_.find(tool + motion); at >= 0 && largest(column(at)) == 0.0) use(at);
    }
    for (const std::string& tool : tools)
      for (const char* component : {".force_x", ".force_y", ".force_z"})
        if (const int k = history_.find(tool + component); k >= 0)
          largest_force_ = std::max(largest_force_, largest(column(k)));
    for (const char* component : {"z", "y", "x"}) force_chart(tools, moving, component);
  }

  void force_chart(const std::vector<std::string>& tools, const std::string& moving, const char* component) {
    Chart chart =
        against_time(fmt::format("Tool forces in {}", component), fmt::format("force in {}", component), "");
    const std::vector<double>* stroke = nullptr;
    if (!moving.empty()) {
      stroke = &column(history_.find(moving + ".stroke"));
      chart.title += " against stroke";
      chart.x_label = "stroke of " + moving;
      chart.x_unit = name(history_.find(moving + ".stroke")).unit;
    }
    const double sigma = evaluate::force_filter(time_);
    const std::vector<double> even = evaluate::even_times(time_);
    double most = 0.0;
    for (std::size_t n = 0; n < tools.size(); ++n) {
      const int k = history_.find(fmt::format("{}.force_{}", tools[n], component));
      if (k < 0) continue;
      use(k);
      chart.y_unit = name(k).unit;
      most = std::max(most, largest(column(k)));
      ChartSeries raw = series("", k, n);
      if (stroke) raw.x = *stroke;
      raw.faint = true;
      ChartSeries smooth = series(tools[n], k, n);
      if (sigma > 0.0) {
        smooth.x = stroke ? evaluate::interpolated(time_, *stroke, even) : even;
        smooth.y = evaluate::gaussian_filter(time_, column(k), sigma, even);
      }
      chart.series.push_back(std::move(raw));
      chart.series.push_back(std::move(smooth));
    }
    constexpr double rounding = 1e-9;
    if (!(most > rounding * largest_force_)) return;
    const double cutoff = std::sqrt(std::numbers::ln2) / (2.0 * std::numbers::pi * sigma);
    chart.note = fmt::format(
        "Force of the tool on the workpiece, {}. "
        "Pale: every recorded value; full: Gaussian low-pass in time, σ = {} (−3 dB at {}).",
        chart.y_unit == "N" ? "of the whole body" : "per unit thickness, of the part that is modelled",
        units_.format(sigma, "s", 3), units_.format(cutoff, "Hz", 3));
    charts_.push_back(std::move(chart));
  }

  /// The large ones each, the small ones together: a curve at the bottom of the chart says nothing.
  void energies() {
    Chart chart = against_time("Energies", "energy", "");
    double most = 0.0;
    std::vector<int> terms;
    for (int k = 0; k < columns(); ++k) {
      const results::ColumnName full = name(k);
      if (!full.name.starts_with("energy.") || full.name == "energy.residual") continue;
      use(k);
      chart.y_unit = full.unit;
      most = std::max(most, largest(column(k)));
      if (moves(column(k))) terms.push_back(k);
    }
    if (terms.size() == 1) terms.clear(); // what nothing else pays for is rounding
    constexpr double small = 0.01;
    ChartSeries others;
    std::string names;
    for (const int k : terms) {
      const std::string term = words(name(k).name.substr(7));
      if (largest(column(k)) >= small * most) {
        chart.series.push_back(series(term, k, chart.series.size()));
        continue;
      }
      others.y.resize(time_.size(), 0.0);
      for (std::size_t r = 0; r < others.y.size(); ++r) others.y[r] += std::abs(column(k)[r]);
      names += (names.empty() ? "" : ", ") + term;
    }
    if (!others.y.empty()) {
      others.label = "others";
      others.x = time_;
      others.colour = static_cast<int>(chart.series.size());
      chart.series.push_back(std::move(others));
      chart.note = fmt::format("Others: the sizes of what stays below 1% of the largest, together: {}. The "
                               "table of energies has all.",
                               names);
    }
    if (!chart.series.empty()) charts_.push_back(chart);
    const int residual = history_.find("energy.residual");
    if (residual < 0) return;
    use(residual);
    if (!(largest(column(residual)) > 0.0)) return;
    chart = against_time("Residual of the energy balance", "residual", name(residual).unit);
    chart.series.push_back(series("", residual, 0));
    charts_.push_back(std::move(chart));
  }

  void step_size() {
    const int dt = history_.find("dt");
    if (dt < 0) return;
    use(dt);
    Chart chart = against_time("Time step", "step", "s");
    ChartSeries line = series("", dt, 0);
    double least = 0.0;
    for (double& value : line.y) {
      if (!(value > 0.0))
        value = std::nan(""); // the row at time 0 has no step behind it
      else
        least = least > 0.0 ? std::min(least, value) : value;
    }
    if (!moves(line.y)) return;
    chart.log_y = least > 0.0 && largest(line.y) > 50.0 * least;
    chart.series.push_back(std::move(line));
    charts_.push_back(std::move(chart));
  }

  void conservation() {
    const bool whole = history_.find("enclosed_volume") >= 0;
    Chart chart = against_time(whole ? "Mass and enclosed volume" : "Mass and area", "change", "%");
    for (const char* quantity : {"mass", whole ? "enclosed_volume" : "area"}) {
      const int k = history_.find(quantity);
      if (k < 0) continue;
      use(k);
      ChartSeries line = series(quantity, k, chart.series.size());
      const double initial = line.y.front();
      for (double& value : line.y) value = 100.0 * (value / initial - 1.0);
      constexpr double seen = 1e-6; // per cent
      if (!(largest(line.y) > seen)) continue;
      chart.series.push_back(std::move(line));
    }
    if (!chart.series.empty()) charts_.push_back(std::move(chart));
    const int nodes = history_.find("nodes");
    if (nodes < 0) return;
    use(nodes);
    if (!moves(column(nodes))) return;
    chart = against_time("Nodes", "number of nodes", "");
    chart.series.push_back(series("", nodes, 0));
    charts_.push_back(std::move(chart));
  }

  // One chart per field and unit of the columns <prefix>[<who>.]<field>.
  template<class Title> void groups(const std::string& prefix, Title&& title) {
    std::map<std::pair<std::string, std::string>, std::vector<int>> group;
    for (int k = 0; k < columns(); ++k) {
      const results::ColumnName full = name(k);
      if (used_.contains(k) || !full.name.starts_with(prefix)) continue;
      const std::size_t dot = full.name.rfind('.');
      const std::string field = dot == std::string::npos ? full.name : full.name.substr(dot + 1);
      group[{field, full.unit}].push_back(k);
      use(k);
    }
    for (const auto& [key, members] : group) {
      const std::string field = words(key.first);
      Chart chart = against_time(title(field), field, key.second);
      for (const int k : members) {
        if (!moves(column(k))) continue;
        const std::string full = name(k).name;
        const std::size_t tail = key.first.size() + 1;
        std::string who;
        if (full.size() > prefix.size() + tail)
          who = full.substr(prefix.size(), full.size() - prefix.size() - tail);
        chart.series.push_back(series(words(std::move(who)), k, chart.series.size()));
      }
      if (!chart.series.empty()) charts_.push_back(std::move(chart));
    }
  }

  const results::HistoryTable& history_;
  const results::ShownUnits& units_;
  const std::vector<double>& time_;
  std::set<int> used_;
  std::vector<Chart> charts_;
  double largest_force_ = 0.0; ///< of all tools and components
};

} // namespace

std::vector<Chart> history_charts(const results::HistoryTable& history, const results::ShownUnits& units) {
  if (history.rows() < 2) return {};
  return Charts(history, units).all();
}

} // namespace cnem::report
