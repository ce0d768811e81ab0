#pragma once
#include "contact/response_push.hpp"

#include <cmath>

namespace cnem::contact {

/// A spring between node and tool whose stiffness the explicit step can bear: f = scale · m g/Δt² along the
/// normal, and friction that stops the node in this step unless it slips.
struct Penalty {
  double scale = 1.0;

  static constexpr const char* name = "penalty";
  static constexpr const char* formula = "`scale` m g/Δt² on nodes at a depth g";
  static constexpr const char* source = "paper 000, (39)–(43); paper 003, (23)";
  static constexpr Parameter<Penalty> parameters[] = {
      {&Penalty::scale,
       {.name = "scale",
        .range = {.low = 0.0, .high = 2.0, .low_open = true},
        .meaning = "Stiffness of the spring over m/Δt²: 2 is that of the central differences of paper 000, 1 "
                   "that of the kinetic tool of paper 003. The stable step is √(1 − scale/4) of what it is "
                   "without.",
        .example = "2.0"}}};

  /// Largest stable step over that of a node without the spring: (ωΔt)² of both add up to 4 at most.
  double step_share() const { return std::sqrt(1.0 - 0.25 * scale); }

  template<int dim> Push<dim> push(const Intrusion<dim>& at) const {
    const double mobility = at.normal.dot(at.mobility * at.normal);
    if (!(mobility > 0.0)) return {};
    return {scale * at.depth * at.dt_mean / (mobility * at.dt * at.dt) * at.normal, true};
  }
};

} // namespace cnem::contact
