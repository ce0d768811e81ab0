// Constants of materials that no metal has.
#include "app/plausibility/usual_size.hpp"
#include "plasticity/hardening_laws.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cnem::app {

double starting_flow_stress(const input::Case& input, const plasticity::Material& material, double strain) {
  return material.hardening->flow_stress(strain, 1.0, input.initial.temperature);
}

namespace {

using plasticity::Material;

// Polymers to tungsten. Not said of elastic materials, of which exact solutions are often written with E = 1.
constexpr const char* flowing_solids = "solids that flow";
constexpr Usual usual_young{"elastic.young", "Pa", 1e7, 1.3e12, flowing_solids};
constexpr Usual usual_density{"density", "kg/m³", 500.0, 25e3, flowing_solids};
constexpr Usual usual_flow_stress{"plastic", "Pa", 1e5, 1e10, flowing_solids, "it begins to flow at "};
constexpr Usual usual_specific_heat{"heat.specific_heat", "J/(kg K)", 80.0, 5e3, flowing_solids};
constexpr Usual usual_conductivity{"heat.conductivity", "W/(m K)", 0.05, 2500.0, flowing_solids};
constexpr Usual usual_expansion{"heat.expansion", "1/K", 1e-7, 3e-4, flowing_solids};

void doubt_sizes(const input::Case& input, const Material& material, Doubts& doubts) {
  const std::string table = "materials." + material.name;
  if (!material.ply) doubt_size(input, table, usual_young, material.elasticity.young, doubts);
  doubt_size(input, table, usual_density, material.density, doubts);
  doubt_size(input, table, usual_flow_stress, starting_flow_stress(input, material, 0.0), doubts);
  if (!input.analysis.thermal) return;
  doubt_size(input, table, usual_specific_heat, material.specific_heat, doubts);
  doubt_size(input, table, usual_conductivity, material.conductivity, doubts);
  doubt_size(input, table, usual_expansion, std::abs(material.expansion), doubts);
}

/// Also of what does not flow: solids as dense as metals are stiff.
void doubt_stiffness(const input::Case& input, const Material& material, Doubts& doubts) {
  constexpr double dense = 2000.0, soft = 1e9, nothing = 1e6; // kg/m³, Pa
  if (material.ply) return; // constants along and across fibres are not those of metals
  const double young = material.elasticity.young;
  if (material.density < dense || young >= soft || young < nothing) return;
  doubts.push_back(
      doubt_about(input, fmt::format("materials.{}.elastic.young", material.name),
                  fmt::format("{:.4g} Pa at {:.4g} kg/m³, where metals have 10 to 600 GPa: is {:.4g} Pa "
                              "meant?",
                              young, material.density, 1e3 * young)));
}

void doubt_flow_over_young(const input::Case& input, const Material& material, Doubts& doubts) {
  const double young = material.elasticity.young;
  const double first = starting_flow_stress(input, material, 0.0);
  // Laws of powers of the strain that begin near zero are strong soon after.
  const double soon = starting_flow_stress(input, material, 1e-4);
  const double late = starting_flow_stress(input, material, 1.0);
  constexpr double stiff = 1e-5, soft = 0.1, hardened = 0.2; // of Young's modulus
  const auto doubt = [&](const std::string& text) {
    doubts.push_back(doubt_about(input, fmt::format("materials.{}.plastic", material.name), text));
  };
  if (first > soft * young)
    doubt(fmt::format(
        "it begins to flow at {:.3g} of Young's modulus, an elastic strain of {:.0f}%, where metals "
        "flow below 2%: are both in the units that are meant?",
        first / young, 100.0 * first / young));
  else if (late > hardened * young)
    doubt(fmt::format("at a strain of 1 it flows at {:.3g} Pa, {:.2g} of Young's modulus, where metals "
                      "harden to 0.02 at most: is the hardening in the unit that is meant?",
                      late, late / young));
  else if (first >= usual_flow_stress.low && soon < stiff * young)
    doubt(
        fmt::format("it begins to flow at {:.4g} Pa, {:.2g} of Young's modulus, where metals have 0.0001 to "
                    "0.02: is {:.4g} Pa meant?",
                    first, first / young, 1e3 * first));
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
  constexpr double longest = 10.0; // strain
  if (const auto* const curve = law.maybe<plasticity::Tabulated>())
    if (const double last = curve->strain.value[curve->strain.size - 1]; last > longest)
      doubts.push_back(doubt_about(
          input, fmt::format("materials.{}.plastic.strain", material.name),
          fmt::format("strains of up to {:g}, where curves are measured up to 5 at most: are {:g}%, "
                      "{:g}, meant?",
                      last, last, last / 100.0)));
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

} // namespace

void doubt_materials(const input::Case& input, Doubts& doubts) {
  for (const Material* used : materials_in_use(input)) {
    const Material& material = *used;
    doubt_stiffness(input, material, doubts);
    if (!material.hardening) continue;
    doubt_sizes(input, material, doubts);
    if (!material.ply) doubt_flow_over_young(input, material, doubts);
    doubt_hardening(input, material, doubts);
  }
}

} // namespace cnem::app
