#pragma once
// Materials as plain structs that can be tried at a single point.
#include "core/index.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cnem::plasticity {

/// Isotropic elasticity, paper 004 (31), (32): Kirchhoff stress linear in logarithmic strain.
struct Elasticity {
  double young = 0.0;   ///< Pa   E
  double poisson = 0.0; ///< –    ν in (−1, ½)

  double lambda() const { return young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); } ///< Pa
  double mu() const { return young / (2.0 * (1.0 + poisson)); }                                 ///< Pa
  double kappa() const { return young / (3.0 * (1.0 - 2.0 * poisson)); }                        ///< Pa

  double dilatational_speed(double density) const; ///< m/s  √((λ + 2μ)/ρ)
  double shear_speed(double density) const;        ///< m/s  √(μ/ρ)
  double bar_speed(double density) const;          ///< m/s  √(E/ρ)
};

/// Flow stress of Johnson and Cook, paper 004 (64), in Kirchhoff measure:
///   σ_y = (A + B ε̄pⁿ + Q (1 − e^{−δ ε̄p})) (1 + C ln⁺(ε̄̇p/ε̄̇0)) (1 − T*ᵐ),
/// T* = clip((T − T0)/(T_m − T0), 0, 1), where ln⁺ is zero below the reference rate. n = 1, C = 0 is linear
/// hardening, B = 0 perfect plasticity, an infinite melting temperature switches thermal softening off. Q,
/// the saturating hardening of Voce, is not in the paper: the finite-strain benchmarks of the literature need
/// it.
struct JohnsonCook {
  double A = 0.0;                                         ///< Pa   ≥ 0
  double B = 0.0;                                         ///< Pa   ≥ 0
  double n = 1.0;                                         ///< –    > 0
  double C = 0.0;                                         ///< –    ≥ 0
  double rate0 = 1.0;                                     ///< 1/s  > 0
  double m = 1.0;                                         ///< –    > 0
  double T0 = 0.0;                                        ///< K
  double Tmelt = std::numeric_limits<double>::infinity(); ///< K    > T0
  double saturation = 0.0;                                ///< Pa   Q ≥ 0
  double saturation_exponent = 0.0;                       ///< –    δ ≥ 0

  /// σ_y in Pa at equivalent plastic strain, its rate (1/s) and temperature (K).
  double flow_stress(double plastic_strain, double rate, double temperature) const;
  /// ∂σ_y/∂ε̄p at fixed rate and temperature, Pa; infinite at zero strain when n < 1.
  double hardening_modulus(double plastic_strain, double rate, double temperature) const;
  /// ∂σ_y/∂ε̄̇p at fixed strain and temperature, Pa s; zero below the reference rate.
  double rate_modulus(double plastic_strain, double rate, double temperature) const;
  /// T* = (T − T0)/(T_m − T0), clipped to [0, 1].
  double homologous_temperature(double temperature) const;
};

/// Fracture strain of Johnson and Cook (1985), σ* = σ_m/σ_eq positive in tension:
///   ε_f = [D1 + D2 exp(D3 σ*)] [1 + D4 ln⁺(ε̄̇p/ε̄̇0)] [1 + D5 T*],
/// and what breaking costs (plasticity/damage.hpp). T* and ln⁺ as in JohnsonCook.
struct JohnsonCookDamage {
  double D1 = 0.0;                                           ///< –
  double D2 = 0.0;                                           ///< –
  double D3 = 0.0;                                           ///< –    < 0: less ductile in tension
  double D4 = 0.0;                                           ///< –
  double D5 = 0.0;                                           ///< –
  double rate0 = 1.0;                                        ///< 1/s  > 0
  double T0 = 0.0;                                           ///< K
  double Tmelt = std::numeric_limits<double>::infinity();    ///< K    > T0
  double cut_off = -std::numeric_limits<double>::infinity(); ///< –    no damage at σ* ≤ this
  double fracture_energy = 0.0;                              ///< J/m² > 0, from initiation to separation
  double band = 2.5; ///< –    > 0, thickness of the band a broken cell stands for, in cell sizes

  double residual_strength = 0.0; ///< –    in [0, 1), share of the flow stress that broken matter keeps

  /// Share of the flow stress left at a softening ω.
  double flow_share(double softening) const { return 1.0 - (1.0 - residual_strength) * softening; }
  /// ε_f at a triaxiality, rate (1/s) and temperature (K).
  double fracture_strain(double triaxiality, double rate, double temperature) const;
};

struct Material {
  std::string name;
  double density = 0.0;                    ///< kg/m³
  Elasticity elasticity;                   ///<
  std::optional<JohnsonCook> hardening;    ///< none: elastic
  std::optional<JohnsonCookDamage> damage; ///< none: never breaks
  double specific_heat = 0.0;              ///< J/(kg K)
  double conductivity = 0.0;               ///< W/(m K)
  double taylor_quinney = 0.9;             ///< –      part χ of the plastic work that becomes heat
  double expansion = 0.0;                  ///< 1/K    linear, logarithmic
  double expansion_reference = 293.15;     ///< K      free of thermal strain at this temperature
};

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
