// Materials of the case reader.
#include "input/case_parts.hpp"
#include "input/constants.hpp"
#include "input/library.hpp"
#include "input/schema/nearest.hpp"
#include "plasticity/hardening_laws.hpp"
#include "plasticity/ply_return.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>

namespace cnem::input {
namespace {

/// A fracture strain that is nowhere positive between shear (σ* = 0) and uniaxial tension (1/3), or in the
/// same span above the cut-off, is a slip: metal would break with its first flow.
void check_ductility(const plasticity::JohnsonCookDamage& law, const Setting& table,
                     Diagnostics& diagnostics) {
  const auto strain = [&](double triaxiality) {
    return law.D1 + law.D2 * std::exp(std::clamp(law.D3 * triaxiality, -700.0, 700.0));
  };
  const double low = std::max(0.0, law.cut_off), high = low + 1.0 / 3.0;
  if (strain(low) > 0.0 || strain(high) > 0.0) return;
  const Setting& first = *table.find("D1");
  diagnostics.add(
      Mistake::range, first.where, first.path,
      fmt::format("found D1 = {:g}, D2 = {:g}, D3 = {:g}, with which the fracture strain D1 + D2 exp(D3 σ*) "
                  "is {:.3g} at σ* = {:.3g} and {:.3g} at σ* = {:.3g}, expected more than 0",
                  law.D1, law.D2, law.D3, strain(low), low, strain(high), high));
}

/// Factors of the fracture strain that turn it negative within what metal sees in a cut.
void warn_of_brittleness(const plasticity::JohnsonCookDamage& law, const Setting& table,
                         std::vector<std::string>& warnings) {
  constexpr double fast = 1e6; // 1/s
  const double share = 1.0 + law.D4 * std::log(std::max(1.0, fast / law.rate0));
  if (!(share > 0.0))
    warnings.push_back(
        fmt::format("{}.D4 = {:g} makes the fracture strain {:.3g} times that at rate0 at {:g} "
                    "1/s: metal breaks there with its first flow",
                    table.path, law.D4, share, fast));
  if (law.D5 <= -1.0)
    warnings.push_back(
        fmt::format("{}.D5 = {:g} makes the fracture strain {:.3g} times the cold one at Tmelt: "
                    "metal breaks there with its first flow",
                    table.path, law.D5, 1.0 + law.D5));
}

std::optional<plasticity::Damage> read_damage(const Setting& table, const Setting& material,
                                              std::vector<std::string>& warnings, Diagnostics& diagnostics) {
  const auto law = read_law<plasticity::DamageLaw>(plasticity::DamageLaws{}, table, diagnostics);
  if (!law) return std::nullopt;
  plasticity::Damage damage{{}, *law};
  plasticity::Breaking& breaking = damage;
  read_constants(plasticity::Breaking::parameters, table, breaking);
  if (!material.find("plastic"))
    diagnostics.add(Mistake::missing_key, table.where, table.path,
                    "found in an elastic material, expected a plastic law beside it: damage grows with "
                    "plastic strain");
  const auto* johnson_cook = std::get_if<plasticity::JohnsonCookDamage>(&*law);
  if (!johnson_cook) return damage;
  if (const Setting& share = *table.find("D5"); johnson_cook->D5 != 0.0 && !table.find("Tmelt"))
    diagnostics.add(Mistake::missing_key, share.where, share.path,
                    fmt::format("found {:g} without a melting temperature, expected damage.Tmelt or "
                                "plastic.Tmelt beside it",
                                johnson_cook->D5));
  check_ductility(*johnson_cook, table, diagnostics);
  warn_of_brittleness(*johnson_cook, table, warnings);
  return damage;
}

plasticity::Axis axis_of(const std::string& name) {
  const auto* found = std::find(std::begin(plasticity::axis_names), std::end(plasticity::axis_names), name);
  return static_cast<plasticity::Axis>(found - std::begin(plasticity::axis_names));
}

/// Of a sheet; a ply has its own.
template<class Law> void read_axes(const Setting& table, Law& law, Diagnostics& diagnostics) {
  law.rolling = axis_of(table.get<std::string>("rolling"));
  law.normal = axis_of(table.get<std::string>("normal"));
  if (law.rolling != law.normal) return;
  const Setting& rolling = *table.find("rolling");
  const Setting& one = rolling.given ? rolling : *table.find("normal");
  diagnostics.add(
      Mistake::conflict, one.where, one.path,
      fmt::format("found \"{}\" for the rolling direction and the normal of the sheet, expected two "
                  "axes",
                  plasticity::axis_names[static_cast<int>(law.rolling)]));
}

std::optional<plasticity::Anisotropy> read_anisotropy(const Setting& table, const Setting& material, bool ply,
                                                      Diagnostics& diagnostics) {
  auto law = read_law<plasticity::Anisotropy>(plasticity::AnisotropyLaws{}, table, diagnostics);
  if (!law) return law;
  if (!ply)
    std::visit([&](auto& own) { read_axes(table, own, diagnostics); },
               static_cast<plasticity::Anisotropy::variant&>(*law));
  else
    for (const char* axis : {"rolling", "normal"})
      if (const Setting* key = table.find(axis))
        diagnostics.add(Mistake::conflict, key->where, key->path,
                        "found in an orthotropic material, expected none: 1 lies along its fibres, 2 across "
                        "them in the plane");
  if (!law->coefficients().convex()) {
    const auto& own = std::get<plasticity::HillRatios>(*law);
    diagnostics.add(Mistake::range, table.where, table.path,
                    fmt::format("found R11 = {:g}, R22 = {:g}, R33 = {:g}, with which some stresses would "
                                "never yield, expected 1/R of each to be less than the sum of the other two",
                                own.R11, own.R22, own.R33));
  }
  if (!material.find("plastic"))
    diagnostics.add(
        Mistake::missing_key, table.where, table.path,
        "found in an elastic material, expected a plastic law beside it: it says where the material yields");
  return law;
}

void require_key(const Setting& table, const char* key, const std::string& because,
                 Diagnostics& diagnostics) {
  if (!table.find(key))
    diagnostics.add(Mistake::missing_key, table.where, fmt::format("{}.{}", table.path, key),
                    "missing, expected it with " + because);
}

bool material_expands(const Setting& expansion) { return std::get<double>(expansion.value) != 0.0; }

/// The constants have to leave every strain an energy above zero.
void read_elasticity(const Setting& table, const Setting& of, plasticity::Material& material,
                     Diagnostics& diagnostics) {
  using plasticity::Elasticity, plasticity::Orthotropic;
  if (table.get<std::string>("law") == Elasticity::name)
    return read_constants(Elasticity::parameters, table, material.elasticity);
  Orthotropic ply;
  read_constants(Orthotropic::parameters, table, ply);
  ply.measure = table.choice<plasticity::StrainMeasure>("measure");
  material.ply = ply;
  if (!ply.sound_in_plane()) {
    const Setting& key = *table.find("nu12");
    diagnostics.add(
        Mistake::range, key.where, key.path,
        fmt::format(
            "found {:g}, expected between −√(E1/E2) and √(E1/E2) = {:.4g}: pulled plies would release "
            "energy",
            ply.nu12, std::sqrt(ply.E1 / ply.E2)));
  } else if (!ply.sound_in_space()) {
    const Setting& key = *table.find("nu23");
    diagnostics.add(
        Mistake::range, key.where, key.path,
        fmt::format("found nu23 = {:g} beside nu12 = {:g}, nu13 = {:g} and these moduli, expected "
                    "constants with which every strain stores energy",
                    ply.nu23, ply.nu12, ply.nu13));
  }
  if (const Setting* found = of.find("equation_of_state"))
    diagnostics.add(Mistake::conflict, found->where, found->path,
                    "found beside an orthotropic elasticity, expected an isotropic one: pressure alone would "
                    "change the shape of a ply");
  const Setting* plastic = of.find("plastic");
  if (plastic && ply.measure == plasticity::StrainMeasure::green) {
    const Setting& measure = *table.find("measure");
    diagnostics.add(
        Mistake::conflict, measure.where, measure.path,
        "found \"green\" in a material that flows, expected \"log\": plastic strains add up in the "
        "logarithm alone");
  }
  if (const Setting* failure = of.find("failure"); failure && plastic)
    diagnostics.add(
        Mistake::conflict, failure->where, failure->path,
        "found beside a plastic law, expected one of them: failure by modes is that of plies that "
        "are elastic until then, a ply that flows breaks by damage");
  if (const Setting* expansion = of.find("heat.expansion"); expansion && material_expands(*expansion))
    diagnostics.add(Mistake::conflict, expansion->where, expansion->path,
                    "found in an orthotropic material, expected 0: plies expand differently along and across "
                    "fibres");
}

/// Pa, the largest S with which fibres of LaRC02 kink at some angle under Xc alone: 4 k S/Xc = 1.
double largest_shear_strength(const plasticity::Failure& law) {
  const double c = std::cos(law.alpha0), friction = -std::cos(2.0 * law.alpha0) / (law.Yc * c * c); // ηL/S
  return 0.5 * law.Xc / std::sqrt(1.0 + friction * law.Xc);
}

std::optional<plasticity::Failure> read_failure(const Setting& table, const plasticity::Material& material,
                                                Diagnostics& diagnostics) {
  using plasticity::Failure;
  Failure law;
  law.criterion = table.choice<plasticity::FailureCriterion>("law");
  law.degradation = table.choice<plasticity::Degradation>("degradation");
  read_constants(Failure::parameters, table, law);
  if (law.Gs == infinite) law.Gs = law.Gmt;
  const bool larc02 = law.criterion == plasticity::FailureCriterion::larc02;
  require_key(table, larc02 ? "eps1t" : "Xt", fmt::format("law = \"{}\"", table.get<std::string>("law")),
              diagnostics);
  if (const Setting& shear = *table.find("S"); larc02 && law.S > largest_shear_strength(law))
    diagnostics.add(
        Mistake::range, shear.where, shear.path,
        fmt::format("found {:g} Pa beside Xc = {:g} Pa, Yc = {:g} Pa and alpha0 = {:g} deg, expected "
                    "at most {:.4g} Pa: no angle of kinks would bear Xc",
                    law.S, law.Xc, law.Yc, law.alpha0 * 180.0 / std::numbers::pi,
                    largest_shear_strength(law)));
  if (law.degradation == plasticity::Degradation::energy)
    for (const char* energy : {"Gft", "Gfc", "Gmt", "Gmc"})
      require_key(table, energy, "degradation = \"energy\"", diagnostics);
  if (!material.ply)
    diagnostics.add(
        Mistake::conflict, table.where, table.path,
        "found in an isotropic material, expected elastic.law = \"orthotropic\": its modes are those "
        "of fibres and matrix");
  return law;
}

/// It gives a material its bulk modulus and its expansion by heat.
void read_equation_of_state(const Setting& table, const Setting& of, plasticity::Material& material,
                            Diagnostics& diagnostics) {
  plasticity::MieGruneisen law;
  read_constants(plasticity::MieGruneisen::parameters, table, law);
  if (std::isfinite(law.C))
    material.elasticity = material.elasticity.with_bulk_modulus(material.density * law.C * law.C);
  if (const Setting* own = of.find("heat.expansion"); own && material.expansion != 0.0)
    diagnostics.add(
        Mistake::conflict, own->where, own->path,
        fmt::format("found {:g} 1/K beside an equation of state, expected 0: heat would expand the "
                    "metal by it and by gamma0",
                    material.expansion));
  material.expansion =
      law.gamma0 * material.density * material.specific_heat / (3.0 * material.elasticity.kappa());
  material.equation_of_state = law;
}

/// A lower and an upper value; no limits where the key is absent.
Range read_limits(const Setting& table, const char* name, Diagnostics& diagnostics) {
  const Setting* limits = table.find(name);
  if (!limits) return anything;
  const auto& list = std::get<std::vector<double>>(limits->value);
  if (list.size() == 2 && list[0] < list[1]) return {.low = list[0], .high = list[1]};
  diagnostics.add(Mistake::range, limits->where, limits->path,
                  fmt::format("found {}, expected a lower and a higher value such as {}",
                              fmt::join(list, " and "), limits->key->example));
  return anything;
}

plasticity::MeasuredRange read_range(const Setting& table, Diagnostics& diagnostics) {
  return {read_limits(table, "strain", diagnostics), read_limits(table, "rate", diagnostics),
          read_limits(table, "temperature", diagnostics)};
}

} // namespace

void set_material_defaults(Setting& root, double temperature) {
  for (const Setting& entry : root.entries("materials"))
    if (const std::optional<double> along = entry.maybe<double>("anisotropy.r0"))
      for (const char* key : {"r45", "r90"})
        root.set_default(fmt::format("{}.anisotropy.{}", entry.path, key), *along);
  for (const Setting& entry : root.entries("materials")) {
    if (entry.maybe<std::string>("anisotropy.law") != plasticity::HillRatios::name) continue;
    for (const auto& [key, of] : {std::pair{"R33", "R22"}, {"R13", "R12"}})
      root.set_default(fmt::format("{}.anisotropy.{}", entry.path, key),
                       entry.maybe<double>(fmt::format("anisotropy.{}", of)).value_or(1.0));
  }
  for (const Setting& entry : root.entries("materials")) {
    if (entry.maybe<std::string>("elastic.law") != plasticity::Orthotropic::name) continue;
    for (const char* axis : {"rolling", "normal"}) // those of a ply are its fibres'
      if (const std::string path = fmt::format("{}.anisotropy.{}", entry.path, axis);
          root.find(path) && !root.find(path)->given)
        root.erase(path);
    for (const auto& [key, of] : {std::pair{"E3", "E2"}, {"nu13", "nu12"}})
      if (const auto value = entry.maybe<double>(fmt::format("elastic.{}", of)))
        root.set_default(fmt::format("{}.elastic.{}", entry.path, key), *value);
    if (const auto matrix = entry.maybe<double>("failure.Gmt"))
      root.set_default(entry.path + ".failure.Gs", *matrix);
  }
  for (const Setting& entry : root.entries("materials")) {
    if (entry.maybe<std::string>("damage.law") != plasticity::JohnsonCookDamage::name) continue;
    const auto from_plastic = [&](const char* key) {
      return entry.maybe<double>(fmt::format("plastic.{}", key));
    };
    const std::string damage = entry.path + ".damage.";
    const std::optional<double> melting = from_plastic("Tmelt");
    const double rate = from_plastic("rate0").value_or(1.0), cold = from_plastic("T0").value_or(293.15);
    root.set_default(damage + "rate0", rate);
    root.set_default(damage + "T0", cold);
    if (melting) root.set_default(damage + "Tmelt", *melting);
  }
  for (const Setting& entry : root.entries("materials"))
    if (entry.find("heat")) root.set_default(entry.path + ".heat.reference_temperature", temperature);
}

namespace {

/// An increment of strain is to have one stress: the elastic one must fall faster than the flow stress.
void check_fall(const plasticity::Material& material, const Setting& table, Diagnostics& diagnostics) {
  const plasticity::Hardening::Fall fall = material.hardening->steepest_fall();
  const double least = material.anisotropy ? least_slope(material.anisotropy->form()) : 1.5;
  const double limit = material.ply
                           ? plasticity::least_ply_slope(*material.ply, material.yield_coefficients())
                           : 2.0 * least * material.elasticity.mu();
  if (fall.slope < limit) return;
  const std::string words =
      material.ply ? "the least slope of its elastic way back"
                   : fmt::format("{} shear moduli",
                                 material.anisotropy ? fmt::format("{:.3g}", 2.0 * least) : "three");
  diagnostics.add(
      Mistake::range, table.where, table.path,
      fmt::format("found a flow stress that falls by {:.3g} GPa per strain at a plastic strain of "
                  "{:.3g} and {:.4g} K, expected less than {}, {:.3g} GPa: an "
                  "increment of strain would have several stresses",
                  fall.slope * 1e-9, fall.strain, fall.temperature, words, limit * 1e-9));
}

} // namespace

plasticity::Material read_material(const Setting& table, std::vector<std::string>& warnings,
                                   Diagnostics& diagnostics) {
  plasticity::Material material;
  material.name = table.name;
  using plasticity::Material;
  read_constants(Material::parameters, table, material);
  read_elasticity(*table.find("elastic"), table, material, diagnostics);
  if (const Setting* failure = table.find("failure"))
    material.failure = read_failure(*failure, material, diagnostics);
  if (const Setting* anisotropy = table.find("anisotropy"))
    material.anisotropy = read_anisotropy(*anisotropy, table, material.ply.has_value(), diagnostics);
  if (const Setting* plastic = table.find("plastic")) {
    material.hardening = read_law<plasticity::Hardening>(plasticity::HardeningLaws{}, *plastic, diagnostics);
    if (material.hardening) check_fall(material, *plastic, diagnostics);
    if (const Setting* range = plastic->find("range")) material.measured = read_range(*range, diagnostics);
  }
  if (const Setting* damage = table.find("damage"))
    material.damage = read_damage(*damage, table, warnings, diagnostics);
  if (const Setting* heat = table.find("heat")) {
    read_constants(Material::heat_parameters, *heat, material);
    read_lists(*heat, material.heat_curves, diagnostics);
  }
  if (const Setting* state = table.find("equation_of_state"))
    read_equation_of_state(*state, table, material, diagnostics);
  return material;
}

namespace {

/// What an unknown name may have meant: a material of the case, else one of the library.
std::string hint(const std::string& name, const std::vector<std::string>& names) {
  const std::string own = did_you_mean(name, names);
  return own.empty() ? did_you_mean_library(name) : own;
}

} // namespace

void read_materials(const Setting& root, Case& result, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const Setting& table : root.entries("materials")) {
    result.materials.push_back(read_material(table, result.warnings, diagnostics));
    names.push_back(table.name);
  }
  const auto check = [&](const Setting& wanted) {
    const auto& name = std::get<std::string>(wanted.value);
    const Setting* table =
        std::find(names.begin(), names.end(), name) == names.end() ? nullptr : root.find("materials." + name);
    if (!table) {
      diagnostics.add(Mistake::reference, wanted.where, wanted.path,
                      fmt::format("found {}, expected one of the materials {}{}",
                                  toml_quoted(shortened(name)), fmt::join(names, ", "), hint(name, names)));
    } else if (result.analysis.thermal && !table->find("heat")) {
      diagnostics.add(
          Mistake::missing_key, table->where, table->path + ".heat",
          "missing, expected a table with specific_heat and conductivity because analysis.thermal is "
          "true");
    }
  };
  const Setting& everywhere = *root.find("domain.material");
  check(everywhere);
  for (const Setting& region : root.entries("domain.regions"))
    if (const Setting& own = *region.find("material"); own.given) check(own);
  for (const Setting& bundle : root.entries("domain.fibres")) check(*bundle.find("material"));
}

} // namespace cnem::input
