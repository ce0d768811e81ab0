// Keys of materials.
#include "input/constants.hpp"
#include "plasticity/hardening_laws.hpp"
#include "plasticity/material.hpp"

#include <fmt/format.h>

namespace cnem::input {
namespace {

using enum Type;

void add_damage(Keys& k, const std::string& at) {
  using Law = plasticity::JohnsonCookDamage;
  k.add(at, table, "Ductile damage and separation; without it the material never breaks.");
  k.add(at + ".law", choice, fmt::format("`{}`: {}.", Law::name, Law::formula))
      .one_of({Law::name})
      .required();
  k.add(at + ".source", text, "Where these constants come from; the report calls them generic without it.")
      .example("\"Johnson and Cook 1985\"");
  add_constants(k, at, constant_texts<Law>(Law::parameters));
}

} // namespace

void add_materials(Keys& k) {
  const std::string at = "materials.*";
  const std::vector<LawText> hardening_laws = law_texts(plasticity::HardeningLaws{});
  k.add("materials", named_tables, "Materials.").required();
  k.add(at, table, "A material with all its constants; without `plastic` it is elastic.");
  k.add(at + ".source", text, "Where the constants come from.").example("\"paper 004, 5.4.3\"");
  add_constants(k, at, constant_texts<plasticity::Material>(plasticity::Material::parameters));
  k.add(at + ".elastic", table, "Isotropic elasticity, linear in logarithmic strain.").required();
  add_constants(k, at + ".elastic",
                constant_texts<plasticity::Elasticity>(plasticity::Elasticity::parameters));
  k.add(at + ".plastic", table, "Isotropic plasticity; the flow stress is a Kirchhoff stress.");
  add_law_choice(k, at + ".plastic", hardening_laws).required();
  add_law_constants(k, at + ".plastic", hardening_laws);
  add_damage(k, at + ".damage");
  k.add(at + ".heat", table, "Thermal properties.");
  add_constants(k, at + ".heat", constant_texts<plasticity::Material>(plasticity::Material::heat_parameters));
}

} // namespace cnem::input
