#pragma once
// The law of friction of a tool or between bodies: any of contact/laws/list.hpp.
#include "contact/laws/list.hpp"

#include <string>
#include <variant>

namespace cnem::contact {

/// Frictionless by default.
class Friction {
public:
  Friction() = default;
  template<class Law>
  requires requires { Law::parameters; }
  Friction(const Law& law) : law_(law) {}

  FrictionBound bound(const Rubbing& rubbing) const;
  bool needs_flow_stress() const;
  bool needs_speed() const;

  /// Throws InputError when a constant is out of its range; `owner` is whose friction this is.
  void check(const std::string& owner) const;

  /// The constants; throws std::bad_variant_access where it is another law.
  template<class Law> const Law& as() const { return std::get<Law>(law_); }

private:
  template<class List> struct VariantOf;
  template<class... Law> struct VariantOf<Laws<Law...>> { using type = std::variant<Law...>; };
  VariantOf<FrictionLaws>::type law_;
};

} // namespace cnem::contact
