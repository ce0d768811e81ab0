#pragma once
// The law of a cohesive interface: tractions of two faces by their separation.
#include "core/parameter.hpp"
#include "core/vec.hpp"

namespace cnem::plasticity {

/// Linear softening in the effective opening λ = √(⟨δn⟩² + δs²), with the mode β = δs²/λ² (paper 001, (25)
/// and (26); Benzeggagh and Kenane 1996; Camanho and Dávila 2002, NASA/TM-2002-211737; Turon et al. 2006).
///
///   t_n = (1 − d) K δn in tension, K δn in compression; t_s = (1 − d) K δs
///   onset      (⟨t_n⟩/strength)² + (t_s/shear_strength)² = 1, at λ0(β)
///   energy     G(β) = energy + (shear_energy − energy) β^eta
///   softening  λf = 2 G/(K λ0),  d = λf (λ − λ0)/(λ (λf − λ0)), which never falls
struct CohesiveLaw {
  double stiffness = 0.0;           ///< K, Pa/m
  double strength = 0.0;            ///< Pa
  double shear_strength = infinite; ///< Pa; infinite before complete(): as strength
  double energy = 0.0;              ///< J/m²
  double shear_energy = infinite;   ///< J/m²; infinite before complete(): as energy
  double eta = 1.0;

  static constexpr Parameter<CohesiveLaw> parameters[] = {
      {&CohesiveLaw::stiffness,
       {.name = "stiffness",
        .unit = "Pa/m",
        .range = positive,
        .required = true,
        .meaning = "K, traction per separation before onset, and always in compression.",
        .source = "paper 001, (25)",
        .example = "38 GPa/mm"}},
      {&CohesiveLaw::strength,
       {.name = "strength",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Traction in pure opening at onset.",
        .source = "paper 001, (26)",
        .example = "18 MPa"}},
      {&CohesiveLaw::shear_strength,
       {.name = "shear_strength",
        .unit = "Pa",
        .range = positive,
        .meaning = "Traction in pure shear at onset.",
        .source = "paper 001, (26)",
        .example = "18 MPa",
        .computed = "`strength`"}},
      {&CohesiveLaw::energy,
       {.name = "energy",
        .unit = "J/m2",
        .range = positive,
        .required = true,
        .meaning = "Fracture energy in pure opening.",
        .example = "28 J/m2"}},
      {&CohesiveLaw::shear_energy,
       {.name = "shear_energy",
        .unit = "J/m2",
        .range = positive,
        .meaning = "Fracture energy in pure shear.",
        .example = "28 J/m2",
        .computed = "`energy`"}},
      {&CohesiveLaw::eta,
       {.name = "eta",
        .range = positive,
        .meaning = "Exponent of the share of shear in the fracture energy of mixed modes.",
        .source = "Benzeggagh and Kenane 1996"}}};

  /// Fills what follows from other constants. Throws InputError where in some mode the energy is stored
  /// before onset already, G ≤ λ0² K/2: there would be no softening left.
  void complete();

  /// m, effective opening at onset of mode β in [0, 1].
  double onset(double mode) const;
  /// m, effective opening at which nothing is borne any more.
  double end(double mode) const;

  /// Damage at a separation (δn, δs), m, where it was `damage` before; in [damage, 1].
  double damage_at(const Vec2& separation, double damage) const;
  /// (t_n, t_s), Pa.
  Vec2 traction(const Vec2& separation, double damage) const;
  /// J/m², what the separation stores.
  double stored(const Vec2& separation, double damage) const;
  /// J/m², what is dissipated from one separation and damage to another, where tractions work as the mean of
  /// both: ½ K (⟨δn⟩⟨δn'⟩ + δs δs') Δd, exact on straight paths of one mode.
  double dissipated(const Vec2& from, const Vec2& to, double growth) const;
};

} // namespace cnem::plasticity
