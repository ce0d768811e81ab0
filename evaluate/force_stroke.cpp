#include "evaluate/force_stroke.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::evaluate {
namespace {

const std::vector<double>& column(const results::HistoryTable& history, const std::string& name) {
  const int k = history.find(name);
  if (k < 0) throw IoError(fmt::format("the history has no column '{}'", name));
  return history.column[index_of(k)];
}

std::vector<double> component(const results::HistoryTable& history, const std::string& vector,
                              const Vec2& along) {
  const std::vector<double>&x = column(history, vector + "_x"), &y = column(history, vector + "_y");
  std::vector<double> value(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) value[k] = along.x() * x[k] + along.y() * y[k];
  return value;
}

} // namespace

std::vector<double> even_times(const std::vector<double>& t) {
  const std::size_t count = std::min<std::size_t>(t.size(), 600);
  std::vector<double> even(count);
  for (std::size_t k = 0; k < count; ++k)
    even[k] = count == 1 ? t.front()
                         : t.front() + (t.back() - t.front()) * static_cast<double>(k) /
                                           static_cast<double>(count - 1);
  return even;
}

std::vector<double> interpolated(const std::vector<double>& t, const std::vector<double>& y,
                                 const std::vector<double>& at) {
  if (t.size() < 2) return std::vector<double>(at.size(), y.front());
  std::vector<double> value;
  for (const double time : at) {
    const auto upper = std::upper_bound(t.begin(), t.end(), time);
    const auto k = index_of(std::clamp<std::ptrdiff_t>(upper - t.begin(), 1, std::ssize(t) - 1));
    const double s = std::clamp((time - t[k - 1]) / (t[k] - t[k - 1]), 0.0, 1.0);
    value.push_back((1.0 - s) * y[k - 1] + s * y[k]);
  }
  return value;
}

std::vector<double> gaussian_filter(const std::vector<double>& t, const std::vector<double>& y, double sigma,
                                    const std::vector<double>& at) {
  std::vector<double> filtered;
  filtered.reserve(at.size());
  constexpr double reach = 4.0; // standard deviations; beyond, the weight is below 4e-4 of the peak
  for (const double centre : at) {
    const auto first = std::lower_bound(t.begin(), t.end(), centre - reach * sigma) - t.begin();
    double sum = 0.0, weights = 0.0;
    for (auto k = index_of(first); k < t.size() && t[k] <= centre + reach * sigma; ++k) {
      if (!std::isfinite(y[k])) continue;
      const double interval = 0.5 * (t[std::min(k + 1, t.size() - 1)] - t[k > 0 ? k - 1 : 0]);
      const double distance = (t[k] - centre) / sigma;
      const double weight = interval * std::exp(-0.5 * distance * distance);
      sum += weight * y[k];
      weights += weight;
    }
    filtered.push_back(weights > 0.0 ? sum / weights : std::nan(""));
  }
  return filtered;
}

double force_filter(const std::vector<double>& t) { return 0.01 * (t.back() - t.front()); }

ForceCurve force_curve(const results::HistoryTable& history, const std::string& tool,
                       const std::string& punch, const std::vector<std::string>& dies, const Vec2& along) {
  ForceCurve curve;
  curve.time = history.column.front();
  curve.force = component(history, tool + ".force", along);
  curve.stroke = component(history, punch + ".displacement", along);
  for (const std::string& die : dies) {
    const std::vector<double> away = component(history, die + ".displacement", along);
    for (std::size_t k = 0; k < away.size(); ++k)
      curve.stroke[k] -= away[k] / static_cast<double>(dies.size());
  }
  curve.work = column(history, tool + ".work").back();
  const std::vector<double> even = even_times(curve.time);
  const double sigma = force_filter(curve.time);
  curve.even_stroke = interpolated(curve.time, curve.stroke, even);
  curve.smooth = sigma > 0.0 ? gaussian_filter(curve.time, curve.force, sigma, even) : curve.force;
  for (std::size_t k = 0; k < curve.smooth.size(); ++k)
    if (std::abs(curve.smooth[k]) > std::abs(curve.smooth[curve.largest])) curve.largest = k;
  return curve;
}

ToolForce largest_force(const ForceCurve& curve, const std::string& tool) {
  double sample = 0.0;
  for (const double force : curve.force) sample = std::max(sample, std::abs(force));
  return {tool, std::abs(curve.smooth[curve.largest]), curve.even_stroke[curve.largest], sample, curve.work};
}

} // namespace cnem::evaluate
