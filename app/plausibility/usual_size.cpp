#include "app/plausibility/usual_size.hpp"

#include <fmt/format.h>
#include <optional>

namespace cnem::app {

namespace {

/// The power of a thousand that brings a value between the bounds, if one does.
std::optional<double> meant(const Usual& usual, double value) {
  for (const double factor : {1e3, 1e-3, 1e6, 1e-6, 1e9, 1e-9, 1e12, 1e-12})
    if (value * factor >= usual.low && value * factor <= usual.high) return value * factor;
  return std::nullopt;
}

} // namespace

void doubt_size(const input::Case& input, const std::string& table, const Usual& usual, double value,
                Doubts& doubts) {
  if (value == 0.0 || (value >= usual.low && value <= usual.high)) return;
  const auto instead = meant(usual, value);
  doubts.push_back(
      doubt_about(input, fmt::format("{}.{}", table, usual.key),
                  fmt::format("{}{:.4g} {}, where {} have {:.3g} to {:.3g} {}{}", usual.before, value,
                              usual.unit, usual.of, usual.low, usual.high, usual.unit,
                              instead ? fmt::format(": is {:.4g} {} meant?", *instead, usual.unit) : "")));
}

} // namespace cnem::app
