#pragma once
#include "contact/friction_bound.hpp"

#include <array>

namespace cnem::contact {

struct Frictionless {
  static constexpr const char* name = "none";
  static constexpr const char* formula = "no friction";
  static constexpr const char* source = "";
  static constexpr std::array<Parameter<Frictionless>, 0> parameters{};

  FrictionBound bound(const Rubbing&) const { return {}; }
};

} // namespace cnem::contact
