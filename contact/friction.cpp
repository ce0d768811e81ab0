#include "contact/friction.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::contact {

double FrictionMelting::share(const Rubbing& rubbing) const {
  const double melting = std::isinf(temperature) ? rubbing.melting : temperature;
  return std::clamp((melting - rubbing.temperature) / range, 0.0, 1.0);
}

FrictionBound Friction::bound(const Rubbing& rubbing) const {
  FrictionBound bound = std::visit([&](const auto& law) { return law.bound(rubbing); }, law_);
  const double share = melting_.share(rubbing);
  if (share == 0.0) return {};
  bound.coefficient *= share;
  bound.shear *= share;
  return bound;
}

bool Friction::set_coefficient(double coefficient) {
  return std::visit(
      [&](auto& law) {
        if constexpr (requires { law.coefficient; }) {
          law.coefficient = coefficient;
          return true;
        }
        return false;
      },
      law_);
}

bool Friction::needs_flow_stress() const {
  return std::visit(
      [](const auto& law) {
        if constexpr (requires { law.needs_flow_stress(); })
          return law.needs_flow_stress();
        else
          return false;
      },
      law_);
}

bool Friction::needs_speed() const {
  return std::visit(
      [](const auto& law) {
        if constexpr (requires { law.needs_speed(); })
          return law.needs_speed();
        else
          return false;
      },
      law_);
}

bool Friction::rubs() const { return !std::holds_alternative<Frictionless>(law_); }

void Friction::check(const std::string& owner) const {
  std::visit(
      [&](const auto& law) {
        for (const auto& [member, info] : law.parameters)
          if (!info.range.contains(law.*member))
            throw InputError(
                fmt::format("{}: {} = {} of its friction is out of range", owner, info.name, law.*member));
      },
      law_);
  for (const auto& [member, info] : FrictionMelting::parameters)
    if (!info.range.contains(melting_.*member))
      throw InputError(
          fmt::format("{}: {} = {} of its friction is out of range", owner, info.name, melting_.*member));
}

} // namespace cnem::contact
