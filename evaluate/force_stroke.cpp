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

std::string component_name(const std::string& vector, std::size_t axis) {
  return fmt::format("{}_{}", vector, axis_name(axis));
}

/// x, y and, in space, z.
std::size_t dimensions(const results::HistoryTable& history, const std::string& vector) {
  return history.find(vector + "_z") < 0 ? 2 : 3;
}

std::vector<double> component(const results::HistoryTable& history, const std::string& vector,
                              const Vec3& along) {
  std::vector<double> value(history.rows(), 0.0);
  for (std::size_t c = 0; c < dimensions(history, vector); ++c) {
    const std::vector<double>& part = column(history, component_name(vector, c));
    for (std::size_t k = 0; k < part.size(); ++k) value[k] += along[as<int>(c)] * part[k];
  }
  return value;
}

std::vector<std::string> with_forces(const results::HistoryTable& history, bool supports) {
  constexpr std::string_view force = ".force_x";
  std::vector<std::string> names;
  for (const std::string& header : history.names) {
    const std::string name = results::split_column_name(header).name;
    if (name.ends_with(force) && name.starts_with("support.") == supports)
      names.push_back(name.substr(0, name.size() - force.size()));
  }
  return names;
}

double largest(const std::vector<double>& values) {
  double size = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) size = std::max(size, std::abs(value));
  return size;
}

/// |∫ y dt|, by trapezia.
double impulse(const std::vector<double>& t, const std::vector<double>& y) {
  double sum = 0.0;
  for (std::size_t k = 1; k < t.size(); ++k)
    if (std::isfinite(y[k - 1]) && std::isfinite(y[k])) sum += 0.5 * (y[k - 1] + y[k]) * (t[k] - t[k - 1]);
  return std::abs(sum);
}

/// Of those named, the one with the component of the largest impulse.
std::optional<LeadingForce> largest_component(const results::HistoryTable& history,
                                              const std::vector<std::string>& names) {
  LeadingForce leading;
  double most = 0.0;
  for (const std::string& name : names)
    for (std::size_t c = 0; c < dimensions(history, name + ".force"); ++c)
      if (const double size =
              impulse(history.column.front(), column(history, component_name(name + ".force", c)));
          size > most) {
        most = size;
        leading = {.of = name, .along = Vec3::Unit(as<int>(c))};
      }
  return most > 0.0 ? std::optional(leading) : std::nullopt;
}

/// Everything but the stroke.
ForceCurve filtered(const results::HistoryTable& history, const std::string& of, const Vec3& along) {
  ForceCurve curve;
  curve.time = history.column.front();
  curve.force = component(history, of + ".force", along);
  const int work = history.find(of + ".work");
  curve.work = work < 0 ? std::nan("") : history.column[index_of(work)].back();
  const double sigma = force_filter(curve.time);
  curve.even_time = sigma > 0.0 ? even_times(curve.time) : curve.time;
  curve.smooth = sigma > 0.0 ? gaussian_filter(curve.time, curve.force, sigma, curve.even_time) : curve.force;
  for (std::size_t k = 0; k < curve.smooth.size(); ++k)
    if (std::abs(curve.smooth[k]) > std::abs(curve.smooth[curve.largest])) curve.largest = k;
  return curve;
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
                       const std::string& punch, const std::vector<std::string>& dies, const Vec3& along) {
  ForceCurve curve = filtered(history, tool, along);
  curve.stroke = component(history, punch + ".displacement", along);
  for (const std::string& die : dies) {
    const std::vector<double> away = component(history, die + ".displacement", along);
    for (std::size_t k = 0; k < away.size(); ++k)
      curve.stroke[k] -= away[k] / static_cast<double>(dies.size());
  }
  curve.even_stroke = interpolated(curve.time, curve.stroke, curve.even_time);
  return curve;
}

std::vector<std::string> tools_of(const results::HistoryTable& history) {
  return with_forces(history, false);
}
std::vector<std::string> supports_of(const results::HistoryTable& history) {
  return with_forces(history, true);
}

std::optional<std::string> moving_tool(const results::HistoryTable& history) {
  std::optional<std::string> moving;
  double longest = 0.0;
  for (const std::string& tool : tools_of(history)) {
    const int stroke = history.find(tool + ".stroke");
    if (stroke < 0 || !(largest(history.column[index_of(stroke)]) > longest)) continue;
    longest = largest(history.column[index_of(stroke)]);
    moving = tool;
  }
  return moving;
}

std::optional<LeadingForce> leading_force(const results::HistoryTable& history) {
  if (history.rows() == 0) return std::nullopt;
  if (const std::optional<std::string> tool = moving_tool(history)) {
    const std::string way = *tool + ".displacement";
    Vec3 along{0, 0, 0};
    for (std::size_t c = 0; c < dimensions(history, way); ++c)
      along[as<int>(c)] = column(history, component_name(way, c)).back();
    if (along.norm() > 0.0)
      return LeadingForce{.of = *tool, .along = along.normalized(), .over_stroke = true};
  }
  if (auto tool = largest_component(history, tools_of(history))) return tool;
  return largest_component(history, supports_of(history));
}

LeadingForce leading_force(const BlankingResult& result) {
  return {.of = result.punch,
          .along = {result.direction_x, result.direction_y, result.direction_z},
          .over_stroke = true,
          .against = result.dies};
}

ForceCurve force_curve(const results::HistoryTable& history, const LeadingForce& force) {
  return force.over_stroke ? force_curve(history, force.of, force.of, force.against, force.along)
                           : filtered(history, force.of, force.along);
}

ToolForce largest_force(const ForceCurve& curve, const std::string& tool) {
  double sample = 0.0;
  for (const double force : curve.force) sample = std::max(sample, std::abs(force));
  return {tool, std::abs(curve.smooth[curve.largest]), curve.even_stroke[curve.largest], sample, curve.work};
}

} // namespace cnem::evaluate
