// Damage that never breaks a metal, and the lengths that breaking has.
#include "app/plausibility/list.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <variant>

namespace cnem::app {

namespace {

using plasticity::Material;

/// Of uniaxial tension, where the flow stress is what it is at a strain of 1.
double strain_at_fracture(const input::Case& input, const Material& material) {
  const plasticity::DamageLaw& law = material.damage->law;
  if (const auto* const work = std::get_if<plasticity::CockcroftLatham>(&law))
    return work->critical_work / starting_flow_stress(input, material, 1.0);
  if (const auto* const normalised = std::get_if<plasticity::NormalisedCockcroftLatham>(&law))
    return normalised->critical_strain;
  return std::get<plasticity::JohnsonCookDamage>(law).fracture_strain(1.0 / 3.0, 1.0,
                                                                      input.initial.temperature);
}

/// The finest cells there will be, m.
double finest_spacing(const input::Case& input, const ExplicitSolver<2>& solver) {
  const Field& volume = solver.approximation().node_volume;
  const Cloud<2>& cloud = solver.conditions().cloud;
  double finest = INFINITY;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    const double around =
        input.analysis.space() == Space::revolution ? cloud.position[i].x() * 2.0 * M_PI : 1.0;
    if (around > 0.0) finest = std::min(finest, std::sqrt(volume[i] / around));
  }
  return std::min(finest, adapted_spacing(input));
}

void doubt_opening(const input::Case& input, const Material& material, double spacing, Doubts& doubts) {
  const double energy = material.damage->fracture_energy;
  const double first = 2.0 * energy / starting_flow_stress(input, material, 0.0);
  const double hardened = 2.0 * energy / starting_flow_stress(input, material, 1.0);
  const double side = smaller_side(input);
  const auto doubt = [&](const std::string& text) {
    doubts.push_back(
        doubt_about(input, fmt::format("materials.{}.damage.fracture_energy", material.name), text));
  };
  if (spacing > first)
    doubt(fmt::format("with {:.3g} J/m² a crack has opened by 2 G_f/σ_y = {:.3g} mm when nothing holds it, "
                      "which is less than the finest spacing, {:.3g} mm: cells break at once, one after "
                      "another",
                      energy, 1e3 * first, 1e3 * spacing));
  else if (hardened > side && std::isfinite(hardened)) // else it is melted
    doubt(
        fmt::format("with {:.3g} J/m² a crack opens by 2 G_f/σ_y = {:.3g} mm before nothing holds it, which "
                    "is more than the workpiece is wide, {:.3g} mm: it never breaks; metals have 1 to "
                    "1,000 kJ/m²",
                    energy, 1e3 * hardened, 1e3 * side));
}

void doubt_length(const input::Case& input, const Material& material, double spacing, Doubts& doubts) {
  const double length = material.damage->length, side = smaller_side(input);
  constexpr double least = 1.5; // spacings
  const auto doubt = [&](const std::string& text) {
    doubts.push_back(doubt_about(input, fmt::format("materials.{}.damage.length", material.name), text));
  };
  if (length > side)
    doubt(fmt::format("damage is averaged over {:.3g} mm, more than the workpiece is wide, {:.3g} mm: all of "
                      "it breaks at once, expected the width of a few cells",
                      1e3 * length, 1e3 * side));
  else if (length > 0.0 && length < least * spacing)
    doubt(fmt::format("damage is averaged over {:.3g} mm, {:.2g} of the finest spacings, where hardly a "
                      "neighbour lies: expected {:g} at least, {:.3g} mm, or 0 for each cell by itself",
                      1e3 * length, length / spacing, least, 1e3 * least * spacing));
}

} // namespace

void doubt_damage(const input::Case& input, Doubts& doubts) {
  for (const Material* one : materials_in_use(input)) {
    if (!one->damage || !one->hardening) continue;
    const auto doubt = [&](const char* key, const std::string& text) {
      doubts.push_back(doubt_about(input, fmt::format("materials.{}.damage{}", one->name, key), text));
    };
    if (const auto* const law = std::get_if<plasticity::JohnsonCookDamage>(&one->damage->law);
        law && law->D2 * law->D3 > 0.0)
      doubt(".D3",
            fmt::format("D2 = {:g} and D3 = {:g} make the metal tougher the more it is pulled: ε_f holds "
                        "exp(D3 σ*), σ* positive in tension; tables that print exp(−D3 σ*) have the "
                        "other sign",
                        law->D2, law->D3));
    else if (const double strain = strain_at_fracture(input, *one), never = 10.0;
             strain > never && std::isfinite(strain))
      doubt("",
            fmt::format("in uniaxial tension it breaks at a strain of {:.3g}, where metals break at 0.1 to "
                        "3: are its constants in the units that are meant?",
                        strain));
  }
}

void doubt_fracture(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts) {
  const double spacing = finest_spacing(input, solver);
  for (const Material* one : materials_in_use(input)) {
    if (!one->damage || !one->hardening) continue;
    doubt_opening(input, *one, spacing, doubts);
    doubt_length(input, *one, spacing, doubts);
  }
}

} // namespace cnem::app
