// Constants of materials that no metal has.
#include "app/plausibility/list.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace cnem::app {

namespace {

using plasticity::Material;

/// What solids that flow have, with room on both sides: polymers to tungsten. Not said of elastic materials,
/// of which exact solutions are often written with E = 1.
struct Usual {
  const char* key;
  const char* unit;
  double low, high;
  double (*value)(const Material&, const input::Case&);
};

double initial_flow_stress(const Material& material, const input::Case& input) {
  return material.hardening->flow_stress(0.0, 1.0, input.initial.temperature);
}

constexpr std::array usual_of_mechanics{
    Usual{"elastic.young", "Pa", 1e7, 1.3e12,
          [](const Material& m, const input::Case&) { return m.elasticity.young; }},
    Usual{"density", "kg/m³", 500.0, 25e3, [](const Material& m, const input::Case&) { return m.density; }},
    Usual{"plastic", "Pa", 1e5, 1e10, initial_flow_stress},
};
constexpr std::array usual_of_heat{
    Usual{"heat.specific_heat", "J/(kg K)", 80.0, 5e3,
          [](const Material& m, const input::Case&) { return m.specific_heat; }},
    Usual{"heat.conductivity", "W/(m K)", 0.05, 2500.0,
          [](const Material& m, const input::Case&) { return m.conductivity; }},
    Usual{"heat.expansion", "1/K", 1e-7, 3e-4,
          [](const Material& m, const input::Case&) { return std::abs(m.expansion); }},
};

/// The power of a thousand that brings a value between the bounds, if one does.
std::optional<double> meant(const Usual& usual, double value) {
  for (const double factor : {1e3, 1e-3, 1e6, 1e-6, 1e9, 1e-9, 1e12, 1e-12})
    if (value * factor >= usual.low && value * factor <= usual.high) return value * factor;
  return std::nullopt;
}

void doubt_size(const input::Case& input, const Material& material, const Usual& usual, Doubts& doubts) {
  const double value = usual.value(material, input);
  if (value == 0.0 || (value >= usual.low && value <= usual.high)) return; // zero: without it
  const auto instead = meant(usual, value);
  doubts.push_back(
      doubt_about(input, fmt::format("materials.{}.{}", material.name, usual.key),
                  fmt::format("{}{:.4g} {}, where solids that flow have {:.3g} to {:.3g} {}{}",
                              usual.value == initial_flow_stress ? "it begins to flow at " : "", value,
                              usual.unit, usual.low, usual.high, usual.unit,
                              instead ? fmt::format(": is {:.4g} {} meant?", *instead, usual.unit) : "")));
}

/// Also of what does not flow: solids as dense as metals are stiff.
void doubt_stiffness(const input::Case& input, const Material& material, Doubts& doubts) {
  constexpr double dense = 2000.0, soft = 1e9, nothing = 1e6; // kg/m³, Pa
  const double young = material.elasticity.young;
  if (material.density < dense || young >= soft || young < nothing) return;
  doubts.push_back(
      doubt_about(input, fmt::format("materials.{}.elastic.young", material.name),
                  fmt::format("{:.4g} Pa at {:.4g} kg/m³, where metals have 10 to 600 GPa: is {:.4g} Pa "
                              "meant?",
                              young, material.density, 1e3 * young)));
}

void doubt_yield_strain(const input::Case& input, const Material& material, Doubts& doubts) {
  const double strain = initial_flow_stress(material, input) / material.elasticity.young;
  if (strain > 0.1)
    doubts.push_back(doubt_about(
        input, fmt::format("materials.{}.plastic", material.name),
        fmt::format(
            "it begins to flow at {:.3g} of Young's modulus, an elastic strain of {:.0f}%, where metals "
            "flow below 2%: are both in the units that are meant?",
            strain, 100.0 * strain)));
}

/// How the flow stress answers strain, rate and temperature, whatever the law.
void doubt_hardening(const input::Case& input, const Material& material, Doubts& doubts) {
  const plasticity::Hardening& law = *material.hardening;
  const double warm = input.initial.temperature;
  const auto doubt = [&](const std::string& text) {
    doubts.push_back(doubt_about(input, fmt::format("materials.{}.plastic", material.name), text));
  };
  const double early = law.hardening_modulus(0.1, 1.0, warm), late = law.hardening_modulus(1.0, 1.0, warm);
  if (constexpr double concave = 1.2; early > 0.0 && late > concave * early)
    doubt(fmt::format("it hardens {:.2g} times as fast at a strain of 1 as at 0.1, where metals harden less "
                      "and less: an exponent above 1?",
                      late / early));
  const double slow = law.flow_stress(0.1, 1.0, warm), quick = law.flow_stress(0.1, 1e4, warm);
  if (constexpr double most = 4.0; slow > 0.0 && quick > most * slow)
    doubt(fmt::format("a rate of 10⁴ /s makes the flow stress {:.2g} times that at 1 /s, where metals have "
                      "1.05 to 2.5: a decimal point?",
                      quick / slow));
  if (!std::isfinite(law.melting_temperature())) return;
  constexpr double coldest_melt = 400.0, cold = 100.0; // K: lower than that of tin; than any T0 in use
  if (law.melting_temperature() < coldest_melt)
    doubt(fmt::format("it melts at {:g} K, {:g} °C, where metals that are formed melt above 500 K: are {:g} "
                      "degC meant?",
                      law.melting_temperature(), law.melting_temperature() - 273.15,
                      law.melting_temperature()));
  else if (law.homologous_temperature(warm) >= 1.0)
    doubt(fmt::format("it begins at {:g} K, melted: nothing is left of its flow stress", warm));
  if (law.homologous_temperature(cold) > 0.0)
    doubt(fmt::format("it softens from below {:g} K on: is T0 in degC meant?", cold));
}

void doubt_damage(const input::Case& input, const Material& material, Doubts& doubts) {
  if (const auto* const law = std::get_if<plasticity::JohnsonCookDamage>(&material.damage->law);
      law && law->D2 * law->D3 > 0.0)
    doubts.push_back(doubt_about(
        input, fmt::format("materials.{}.damage.D3", material.name),
        fmt::format(
            "D2 = {:g} and D3 = {:g} make the metal tougher the more it is pulled: ε_f holds exp(D3 σ*), "
            "σ* positive in tension; tables that print exp(−D3 σ*) have the other sign",
            law->D2, law->D3)));
}

} // namespace

void doubt_materials(const input::Case& input, Doubts& doubts) {
  for (const Material* used : materials_in_use(input)) {
    const Material& material = *used;
    doubt_stiffness(input, material, doubts);
    if (!material.hardening) continue;
    for (const Usual& one : usual_of_mechanics) doubt_size(input, material, one, doubts);
    doubt_yield_strain(input, material, doubts);
    doubt_hardening(input, material, doubts);
    if (input.analysis.thermal)
      for (const Usual& one : usual_of_heat) doubt_size(input, material, one, doubts);
    if (material.damage) doubt_damage(input, material, doubts);
  }
  if (constexpr double coldest = 100.0; input.analysis.thermal && input.initial.temperature < coldest)
    doubts.push_back(
        doubt_about(input, "initial.temperature",
                    fmt::format("{:g} K are {:g} °C: are {:g} degC meant?", input.initial.temperature,
                                input.initial.temperature - 273.15, input.initial.temperature)));
}

} // namespace cnem::app
