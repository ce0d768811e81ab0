#include "plasticity/hardening_laws.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cnem::plasticity {

namespace {

using generic::Jet;

template<class Law> constexpr bool melts = requires(Law law) { law.T0, law.Tmelt; };

/// Strains close enough to see any fall of a law: its steepest ones are a hundredth of a strain wide, or lie
/// between points.
template<class Law> std::vector<double> sampled_strains(const Law& law) {
  std::vector<double> strains;
  for (double e = 1e-6; e < 20.0; e *= 1.005) strains.push_back(e);
  if constexpr (requires { law.strain.size; })
    for (int i = 1; i < law.strain.size; ++i)
      for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0 - 1e-9})
        strains.push_back(std::lerp(law.strain.value[i - 1], law.strain.value[i], share));
  return strains;
}

} // namespace

double Hardening::flow_stress(double plastic_strain, double rate, double temperature) const {
  return std::visit(
      [&](const auto& law) { return generic::flow_stress(law, plastic_strain, rate, temperature); },
      law_->law);
}

double Hardening::hardening_modulus(double plastic_strain, double rate, double temperature) const {
  const Jet<double> strain(plastic_strain, 1.0, 0.0), fixed(rate);
  return std::visit(
      [&](const auto& law) { return generic::flow_stress(law, strain, fixed, temperature).first; },
      law_->law);
}

double Hardening::rate_modulus(double plastic_strain, double rate, double temperature) const {
  const Jet<double> fixed(plastic_strain), varied(rate, 1.0, 0.0);
  return std::visit(
      [&](const auto& law) { return generic::flow_stress(law, fixed, varied, temperature).first; },
      law_->law);
}

Hardening::Fall Hardening::steepest_fall() const {
  Fall worst;
  std::visit(
      [&](const auto& law) {
        using Law = std::decay_t<decltype(law)>;
        if constexpr (generic::can_fall<Law>) {
          static_assert(melts<Law>);
          const double range = law.Tmelt < infinite ? law.Tmelt - law.T0 : 0.0;
          for (const double e : sampled_strains(law))
            for (int k = 0; k <= (range > 0.0 ? 20 : 0); ++k) {
              const double temperature = law.T0 + 0.05 * k * range;
              const double slope = -hardening_modulus(e, 1e6, temperature);
              if (slope > worst.slope) worst = {slope, e, temperature};
            }
        }
      },
      law_->law);
  return worst;
}

double Hardening::melting_temperature() const {
  return std::visit(
      [](const auto& law) {
        if constexpr (melts<std::decay_t<decltype(law)>>)
          return law.Tmelt;
        else
          return infinite;
      },
      law_->law);
}

double Hardening::homologous_temperature(double temperature) const {
  return std::visit(
      [&](const auto& law) {
        if constexpr (melts<std::decay_t<decltype(law)>>)
          return std::clamp((temperature - law.T0) / (law.Tmelt - law.T0), 0.0, 1.0);
        else
          return 0.0;
      },
      law_->law);
}

HardeningView Hardening::view() const {
  return {static_cast<int>(law_->law.index()),
          std::visit([](const auto& law) { return static_cast<const void*>(&law); }, law_->law)};
}

} // namespace cnem::plasticity
