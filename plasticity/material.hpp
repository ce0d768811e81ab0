#pragma once
// Materials as plain structs that can be tried at a single point.
#include "core/index.hpp"
#include "core/parameter.hpp"
#include "plasticity/hardening.hpp"
#include "plasticity/hill48.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cnem::plasticity {

/// Isotropic elasticity, paper 004 (31), (32): Kirchhoff stress linear in logarithmic strain.
struct Elasticity {
  double young = 0.0, poisson = 0.0;

  static constexpr Parameter<Elasticity> parameters[] = {
      {&Elasticity::young,
       {.name = "young",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Young's modulus.",
        .example = "210 GPa"}},
      {&Elasticity::poisson,
       {.name = "poisson",
        .range = {.low = -1.0, .high = 0.5, .low_open = true, .high_open = true},
        .required = true,
        .meaning = "Poisson's ratio.",
        .example = "0.33"}}};

  double lambda() const { return young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); } ///< Pa
  double mu() const { return young / (2.0 * (1.0 + poisson)); }                                 ///< Pa
  double kappa() const { return young / (3.0 * (1.0 - 2.0 * poisson)); }                        ///< Pa

  double dilatational_speed(double density) const; ///< m/s  √((λ + 2μ)/ρ)
  double shear_speed(double density) const;        ///< m/s  √(μ/ρ)
  double bar_speed(double density) const;          ///< m/s  √(E/ρ)
};

/// Fracture strain of Johnson and Cook (1985) and what breaking costs (plasticity/damage.hpp). T* and ln⁺ as
/// in JohnsonCook.
struct JohnsonCookDamage {
  double D1 = 0.0, D2 = 0.0, D3 = 0.0, D4 = 0.0, D5 = 0.0;
  double rate0 = 1.0, T0 = 293.15, Tmelt = infinite, cut_off = -infinite;
  double fracture_energy = 0.0, residual_strength = 0.0, band = 2.5, length = 0.0;

  static constexpr const char* name = "johnson-cook";
  static constexpr const char* formula =
      "damage grows by dε̄p/ε_f, ε_f = [D1 + D2 exp(D3 σ*)] [1 + D4 ln(ε̄̇p/rate0)] [1 + D5 T*] (Johnson and "
      "Cook "
      "1985), σ* = mean stress over von Mises stress, positive in tension. At 1 the flow stress, and the "
      "mean "
      "stress in tension, begin to fall until `fracture_energy` is spent (Hillerborg, Modéer and Petersson "
      "1976)";
  static constexpr Parameter<JohnsonCookDamage> parameters[] = {
      {&JohnsonCookDamage::D1,
       {.name = "D1", .required = true, .meaning = "Fracture strain under high tension.", .example = "0.05"}},
      {&JohnsonCookDamage::D2,
       {.name = "D2", .required = true, .meaning = "Fracture strain in shear, less D1.", .example = "3.44"}},
      {&JohnsonCookDamage::D3,
       {.name = "D3",
        .required = true,
        .meaning =
            "Negative where tension makes the material less ductile: some tables give it for exp(−D3 σ*).",
        .example = "-2.12"}},
      {&JohnsonCookDamage::D4, {.name = "D4", .meaning = "Influence of the rate; none below `rate0`."}},
      {&JohnsonCookDamage::D5, {.name = "D5", .meaning = "Influence of the temperature."}},
      {&JohnsonCookDamage::rate0,
       {.name = "rate0",
        .unit = "1/s",
        .range = positive,
        .meaning = "Reference strain rate.",
        .computed = "`plastic.rate0`, else 1 /s"}},
      {&JohnsonCookDamage::T0,
       {.name = "T0",
        .unit = "K",
        .range = temperature_range,
        .meaning = "Temperature at which T* is 0.",
        .example = "293.15 K",
        .computed = "`plastic.T0`, else 293.15 K"}},
      {&JohnsonCookDamage::Tmelt,
       {.name = "Tmelt",
        .unit = "K",
        .range = temperature_range,
        .meaning = "Melting temperature, at which T* is 1; without it T* is 0.",
        .example = "1793 K",
        .computed = "`plastic.Tmelt`"}},
      {&JohnsonCookDamage::fracture_energy,
       {.name = "fracture_energy",
        .unit = "J/m2",
        .range = positive,
        .required = true,
        .meaning =
            "Plastic work per area that a band takes from the beginning of softening until it is broken."}},
      {&JohnsonCookDamage::residual_strength,
       {.name = "residual_strength",
        .range = {.low = 0.0, .high = 1.0, .high_open = true},
        .meaning = "Share of the flow stress that broken matter keeps, as rubble and the edges of cracks do; "
                   "tension is lost whole."}},
      {&JohnsonCookDamage::band,
       {.name = "band",
        .range = positive,
        .meaning =
            "Thickness of the band in which cells break, in cell sizes √area: with it the fracture energy "
            "is spread over the cells. docs/theory.md says where the default comes from."}},
      {&JohnsonCookDamage::length,
       {.name = "length",
        .unit = "m",
        .range = not_negative,
        .meaning =
            "Distance within which the growth of damage up to 1 is averaged, so that where and when the "
            "metal breaks does not depend on the cells: at least one and a half spacings. 0: each cell "
            "for itself.",
        .example = "0.2 mm"}},
      {&JohnsonCookDamage::cut_off,
       {.name = "cut_off",
        .meaning = "No damage grows at this σ* or below; without it damage grows at any σ*.",
        .example = "-0.3333"}}};
  static constexpr Order orders[] = {{"Tmelt", "T0"}};

  /// Share of the flow stress left at a softening ω.
  double flow_share(double softening) const { return 1.0 - (1.0 - residual_strength) * softening; }
  /// ε_f at a triaxiality, rate (1/s) and temperature (K).
  double fracture_strain(double triaxiality, double rate, double temperature) const;
};

/// Where the constants of a hardening law were measured: plastic strain, its rate in 1/s, temperature in K.
struct MeasuredRange {
  Range strain, rate, temperature;
};

struct Material {
  std::string name;
  double density = 0.0;
  Elasticity elasticity;
  std::optional<Hardening> hardening;      ///< none: elastic
  std::optional<Hill48> anisotropy;        ///< none: von Mises
  std::optional<JohnsonCookDamage> damage; ///< none: never breaks
  MeasuredRange measured;                  ///< of the hardening; it holds beyond as well
  double specific_heat = 0.0, conductivity = 0.0, taylor_quinney = 0.9, expansion = 0.0;
  double expansion_reference = 293.15;

  double melting_temperature() const; ///< K, of hardening or damage, the lower; infinite: neither knows one

  static const Parameter<Material> parameters[1];      ///< of mechanics
  static const Parameter<Material> heat_parameters[5]; ///< of a material in a thermal analysis
};

inline constexpr Parameter<Material> Material::parameters[] = {
    {&Material::density, {.name = "density", .unit = "kg/m3", .range = positive, .required = true}}};

inline constexpr Parameter<Material> Material::heat_parameters[] = {
    {&Material::specific_heat,
     {.name = "specific_heat", .unit = "J/(kg K)", .range = positive, .required = true}},
    {&Material::conductivity,
     {.name = "conductivity",
      .unit = "W/(m K)",
      .range = not_negative,
      .required = true,
      .meaning = "0: adiabatic."}},
    {&Material::taylor_quinney,
     {.name = "taylor_quinney",
      .range = fraction,
      .meaning = "Share of plastic work that becomes heat.",
      .source = "Taylor and Quinney 1934"}},
    {&Material::expansion, {.name = "expansion", .unit = "1/K", .meaning = "Linear thermal expansion."}},
    {&Material::expansion_reference,
     {.name = "reference_temperature",
      .unit = "K",
      .range = temperature_range,
      .meaning = "Temperature without thermal strain.",
      .example = "296 K",
      .computed = "`initial.temperature`"}}};

/// f(material, first, stop) for each run of points of one material among [begin, end); material[p] is the
/// index into `materials` of point p.
template<class F>
void for_each_run(const std::vector<Material>& materials, const std::vector<std::int32_t>& material,
                  std::ptrdiff_t begin, std::ptrdiff_t end, F&& f) {
  for (std::ptrdiff_t first = begin; first < end;) {
    const std::int32_t index = material[index_of(first)];
    std::ptrdiff_t stop = first + 1;
    while (stop < end && material[index_of(stop)] == index) ++stop;
    f(materials[index_of(index)], first, stop);
    first = stop;
  }
}

} // namespace cnem::plasticity
