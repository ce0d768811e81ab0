#include "plasticity/hardening_laws.hpp"

#include <algorithm>

namespace cnem::plasticity {

namespace {

using generic::Jet;

template<class Law> constexpr bool melts = requires(Law law) { law.T0, law.Tmelt; };

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
