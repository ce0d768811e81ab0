#pragma once
// The law of friction of a tool or between bodies: any of contact/laws/list.hpp.
#include "contact/laws/list.hpp"
#include "core/law_variant.hpp"

#include <string>

namespace cnem::contact {

/// Melt bears no shear: whatever the law, friction falls linearly to nothing over the range below the melting
/// temperature. Without it the heat of friction in proportion to the pressure alone has no end.
struct FrictionMelting {
  double temperature = infinite; ///< K; infinite: that of the workpiece
  double range = 100.0;          ///< K

  static constexpr Parameter<FrictionMelting> parameters[] = {
      {&FrictionMelting::temperature,
       {.name = "melting",
        .unit = "K",
        .range = temperature_range,
        .meaning = "Temperature of the interface at which friction has fallen to nothing.",
        .example = "1836 K",
        .computed = "the lower of `plastic.Tmelt` and `damage.Tmelt` of the material there; none without"}},
      {&FrictionMelting::range,
       {.name = "melting_range",
        .unit = "K",
        .range = positive,
        .meaning = "How far below `melting` friction begins to fall: alloys melt over some 50 to 140 K."}}};

  /// Share of friction that is left, 1 unless the interface is within the range.
  double share(const Rubbing& rubbing) const;
};

/// Frictionless by default.
class Friction {
public:
  Friction() = default;
  /// Throws InputError where constants of the law do not fit together.
  template<class Law>
  requires requires { Law::parameters; }
  Friction(const Law& law) : law_(law) {
    if constexpr (requires { law.complete(); }) law.complete();
  }

  FrictionBound bound(const Rubbing& rubbing) const;
  bool needs_flow_stress() const;
  bool needs_speed() const;
  bool rubs() const; ///< whether it is any friction: then its melting is looked at

  /// False where the law has no coefficient of its own.
  bool set_coefficient(double coefficient);
  void set_melting(const FrictionMelting& melting) { melting_ = melting; }

  /// Throws InputError when a constant is out of its range; `owner` is whose friction this is.
  void check(const std::string& owner) const;

  /// The constants; throws std::bad_variant_access where it is another law.
  template<class Law> const Law& as() const { return std::get<Law>(law_); }

private:
  VariantOf<FrictionLaws> law_;
  FrictionMelting melting_;
};

} // namespace cnem::contact
