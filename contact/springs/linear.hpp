#pragma once
#include "contact/springs/preload.hpp"

namespace cnem::contact {

/// Hooke's, with a force at the start: a steel spring, or the frame of a press.
struct LinearSpring {
  double preload = 0.0, stiffness = 0.0;

  static constexpr const char* name = "linear";
  static constexpr const char* formula = "`preload` + `stiffness` s, in both senses";
  static constexpr const char* source = "";
  static constexpr Parameter<LinearSpring> parameters[] = {
      {&LinearSpring::preload, spring_preload},
      {&LinearSpring::stiffness,
       {.name = "stiffness",
        .unit = "N/m2",
        .range = positive,
        .required = true,
        .meaning = "Per unit thickness, or of the whole body of revolution; of what is modelled.",
        .example = "2 GN/m2"}}};

  double force(double s) const { return preload + stiffness * s; }
  double energy(double s) const { return (preload + 0.5 * stiffness * s) * s; }
  double slope(double) const { return stiffness; }
};

} // namespace cnem::contact
