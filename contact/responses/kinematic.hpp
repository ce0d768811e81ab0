#pragma once
#include "contact/response_push.hpp"

#include <array>

namespace cnem::contact {

/// Nodes inside the tool take its velocity in the direction in which it moves; across that direction they
/// keep their own. Normal force and friction follow: their resultant points along the motion. Faces that do
/// not go ahead of the tool bear nothing.
struct Kinematic {
  static constexpr const char* name = "kinematic";
  static constexpr const char* formula =
      "nodes inside the tool take its velocity in the direction in which it moves, and keep theirs across";
  static constexpr const char* source = "paper 003, (24)";
  static constexpr std::array<Parameter<Kinematic>, 0> parameters{};

  template<int dim> Push<dim> push(const Intrusion<dim>& at) const {
    const double speed = at.tool.norm();
    if (!(speed > 0.0)) return {};
    const Vec<dim> ahead = at.tool / speed;
    const double missing = at.approach.dot(ahead), mobility = ahead.dot(at.mobility * ahead);
    if (!(at.normal.dot(ahead) > 0.0) || !(missing > 0.0) || !(mobility > 0.0)) return {};
    return {missing / mobility * ahead, false};
  }
};

} // namespace cnem::contact
