#include "contact/friction.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

namespace cnem::contact {

FrictionBound Friction::bound(const Rubbing& rubbing) const {
  return std::visit([&](const auto& law) { return law.bound(rubbing); }, law_);
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

void Friction::check(const std::string& owner) const {
  std::visit(
      [&](const auto& law) {
        for (const auto& [member, info] : law.parameters)
          if (!info.range.contains(law.*member))
            throw InputError(
                fmt::format("{}: {} = {} of its friction is out of range", owner, info.name, law.*member));
      },
      law_);
}

} // namespace cnem::contact
