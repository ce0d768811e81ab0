#pragma once
// How a material breaks: a law of plasticity/damage_laws/list.hpp until damage is 1, and what follows.
#include "core/parameter.hpp"
#include "plasticity/damage_laws/list.hpp"

#include <algorithm>
#include <variant>

namespace cnem::plasticity {

/// What follows when damage has reached 1, whatever its law: the strength falls until the fracture energy is
/// spent (Hillerborg, Modéer and Petersson, Cem. Concr. Res. 6, 1976).
struct Breaking {
  double fracture_energy = 0.0, residual_strength = 0.0, friction = 0.0, band = 2.5, length = 0.0;

  static constexpr Parameter<Breaking> parameters[] = {
      {&Breaking::fracture_energy,
       {.name = "fracture_energy",
        .unit = "J/m2",
        .range = positive,
        .required = true,
        .meaning =
            "Plastic work per area that a band takes from the beginning of softening until it is broken."}},
      {&Breaking::residual_strength,
       {.name = "residual_strength",
        .range = {.low = 0.0, .high = 1.0, .high_open = true},
        .meaning = "Share of the flow stress that broken matter keeps, as rubble and the edges of cracks do; "
                   "tension is lost whole."}},
      {&Breaking::friction,
       {.name = "friction",
        .range = not_negative,
        .meaning = "Of the faces of cracks on each other: under pressure broken matter keeps a strength in "
                   "shear of this coefficient times the pressure, at most that of sound matter and at least "
                   "`residual_strength` of it."}},
      {&Breaking::band,
       {.name = "band",
        .range = positive,
        .meaning =
            "Thickness of the band in which cells break, in cell sizes √area: with it the fracture energy "
            "is spread over the cells. docs/theory.md says where the default comes from."}},
      {&Breaking::length,
       {.name = "length",
        .unit = "m",
        .range = not_negative,
        .meaning =
            "Distance within which the growth of damage up to 1 is averaged, so that where and when the "
            "metal breaks does not depend on the cells: at least one and a half spacings. 0: each cell "
            "for itself.",
        .example = "0.2 mm"}}};

  /// Share of the flow stress left at a softening ω, where broken matter rubs with a share of it.
  double flow_share(double softening, double rubbing = 0.0) const {
    return 1.0 - (1.0 - std::max(residual_strength, rubbing)) * softening;
  }
};

template<class List> struct DamageLawOf;
template<class... Law> struct DamageLawOf<Laws<Law...>> { using type = std::variant<Law...>; };
using DamageLaw = DamageLawOf<DamageLaws>::type;

struct Damage : Breaking {
  DamageLaw law{};

  double melting_temperature() const; ///< K; infinite for laws without one
};

} // namespace cnem::plasticity
