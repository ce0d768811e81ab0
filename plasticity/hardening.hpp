#pragma once
// The hardening law of a material: any of plasticity/laws/list.hpp. Who makes one, or looks at its constants,
// includes plasticity/hardening_laws.hpp; nobody else sees the laws.
#include "core/parameter.hpp"
#include "plasticity/return_map_parameters.hpp"

#include <memory>

namespace cnem::plasticity {

struct AnyHardening;

/// A law with its constants, which do not change; copies share them.
class Hardening {
public:
  /// Throws InputError where constants of the law do not fit together.
  template<class Law>
  requires requires { Law::parameters; }
  Hardening(const Law& law);

  /// σ_y in Pa at equivalent plastic strain, its rate (1/s) and temperature (K), in Kirchhoff measure.
  double flow_stress(double plastic_strain, double rate, double temperature) const;
  /// ∂σ_y/∂ε̄p at fixed rate and temperature, Pa; may be infinite at zero strain.
  double hardening_modulus(double plastic_strain, double rate, double temperature) const;
  /// ∂σ_y/∂ε̄̇p at fixed strain and temperature, Pa s.
  double rate_modulus(double plastic_strain, double rate, double temperature) const;

  struct Fall {
    double slope = 0.0;       ///< Pa, −∂σ_y/∂ε̄p
    double strain = 0.0;      ///< –
    double temperature = 0.0; ///< K
  };
  /// Where the flow stress falls most steeply with strain, among samples at 10⁶ /s, strains up to 20 and
  /// temperatures from T0 to melting; no slope where it does not fall. The return map needs less than 3μ.
  Fall steepest_fall() const;

  /// K; infinite for laws without one.
  double melting_temperature() const;
  /// (T − T0)/(Tmelt − T0), clipped to [0, 1]; 0 for laws without these.
  double homologous_temperature(double temperature) const;

  /// As kernels see it, for as long as this object or a copy of it lives.
  HardeningView view() const;

  /// The constants; throws std::bad_variant_access where it is another law.
  template<class Law> const Law& as() const;
  /// The constants; none where it is another law.
  template<class Law> const Law* maybe() const;

private:
  std::shared_ptr<const AnyHardening> law_;
};

} // namespace cnem::plasticity
