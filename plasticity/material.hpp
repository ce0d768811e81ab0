#pragma once
// Materials as plain structs that can be tried at a single point.
#include "core/heat_curves.hpp"
#include "core/index.hpp"
#include "core/parameter.hpp"
#include "plasticity/breaking.hpp"
#include "plasticity/equation_of_state.hpp"
#include "plasticity/failure.hpp"
#include "plasticity/hardening.hpp"
#include "plasticity/hill48.hpp"
#include "plasticity/orthotropic.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cnem::plasticity {

/// Isotropic elasticity, paper 004 (31), (32): Kirchhoff stress linear in logarithmic strain.
struct Elasticity {
  double young = 0.0, poisson = 0.0;

  static constexpr const char* name = "isotropic";
  static constexpr const char* formula = "Kirchhoff stress linear in logarithmic strain";
  static constexpr const char* source = "paper 004 (31), (32)";
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

  /// The same shear modulus with another bulk modulus, Pa.
  Elasticity with_bulk_modulus(double kappa) const;
};

/// Where the constants of a hardening law were measured: plastic strain, its rate in 1/s, temperature in K.
struct MeasuredRange {
  Range strain, rate, temperature;
};

using ElasticLaws = Laws<Elasticity, Orthotropic>;

struct Material {
  std::string name;
  double density = 0.0;
  Elasticity elasticity;                         ///< where it is no ply
  std::optional<Orthotropic> ply;                ///< none: isotropic
  std::optional<Failure> failure;                ///< of a ply; none: never fails
  std::optional<Hardening> hardening;            ///< none: elastic
  std::optional<Anisotropy> anisotropy;          ///< none: von Mises
  std::optional<Damage> damage;                  ///< none: never breaks
  std::optional<MieGruneisen> equation_of_state; ///< none: the logarithmic law in compression too
  MeasuredRange measured;                        ///< of the hardening; it holds beyond as well
  double specific_heat = 0.0, conductivity = 0.0, taylor_quinney = 0.9, expansion = 0.0;
  double expansion_reference = 293.15;
  HeatCurves heat_curves; ///< factors of specific heat and conductivity

  HillCoefficients yield_coefficients() const; ///< of the anisotropy or von Mises
  double shear_modulus() const;                ///< Pa, μ or G12
  /// Pa: λ + 2μ, without stress out of the plane E/(1 − ν²), of a ply the largest eigenvalue of its stiffness
  double wave_modulus(bool stress_free = false) const;
  double fastest_wave() const; ///< m/s, √(wave modulus/ρ), without strain out of the plane
  double thermal_strain(double temperature) const { return expansion * (temperature - expansion_reference); }
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
