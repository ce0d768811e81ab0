// Friction that no pair of metals has.
#include "app/plausibility/list.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cnem::app {

void doubt_friction(const input::Case& input, Doubts& doubts) {
  constexpr double most = 1.0;
  const auto look_at = [&](const std::string& key, const contact::Friction& friction) {
    const double mu = friction.bound({.flow_stress = 1.0}).coefficient; // no limit by the flow stress
    if (std::isfinite(mu) && mu > most)
      doubts.push_back(doubt_about(
          input, key + ".friction",
          fmt::format("a coefficient of {:g}, where metals on tools have 0.02 to 0.8: is {:g} meant?", mu,
                      mu >= 5.0 ? mu / 100.0 : mu / 10.0)));
  };
  for (const input::Tool& tool : input.tools) look_at("tools." + tool.name, tool.friction);
  if (input.contact.active) look_at("contact", input.contact.friction);
}

} // namespace cnem::app
