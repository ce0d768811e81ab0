// Keys of materials.
#include "input/constants.hpp"
#include "plasticity/hardening_laws.hpp"
#include "plasticity/material.hpp"

#include <fmt/format.h>

namespace cnem::input {
namespace {

using enum Type;
namespace d = dimension;

KeyDraft add_source(Keys& k, const std::string& at, const std::string& more = "") {
  return k.add(
      at + ".source", texts,
      "Where these constants come from. An entry that begins with names of them, as in `A, B: …`, speaks "
      "of these alone." +
          more);
}

void add_range(Keys& k, const std::string& at) {
  k.add(at, table,
        "Where the constants were measured, as two values each; what is not stated has no limits. A run that "
        "goes beyond "
        "says so, and goes on.");
  k.add(at + ".strain", quantities, "Equivalent plastic strain.").in(not_negative).example("[0.0, 0.5]");
  k.add(at + ".rate", quantities, "Of the plastic strain. Only rates beyond the larger value are told of.")
      .unit(d::rate)
      .in(not_negative)
      .example("\"0.001 1000 /s\"");
  k.add(at + ".temperature", quantities, "").unit(d::temperature).in(not_negative).example("\"293 773 K\"");
  k.add(at + ".source", text, "Who states this range.").example("\"Jaspers 1999, section 5.2\"");
}

void add_damage(Keys& k, const std::string& at) {
  const std::vector<LawText> laws = law_texts(plasticity::DamageLaws{});
  k.add(at, table,
        "Ductile damage and separation; without it the material never breaks. At a damage of 1 the flow "
        "stress, "
        "and the mean stress in tension, begin to fall until `fracture_energy` is spent (Hillerborg, Modéer "
        "and "
        "Petersson 1976).");
  add_law_choice(k, at, laws).required();
  add_source(k, at, " The report calls them generic without it.").example("\"Johnson and Cook 1985\"");
  k.add(at + ".calibration", choice,
        "`fitted`: all of these constants come from tests of this metal; `generic`: some do not, `source` "
        "says which.")
      .one_of({"fitted", "generic"});
  add_law_constants(k, at, laws);
  add_constants(k, at, constant_texts<plasticity::Breaking>(plasticity::Breaking::parameters));
}

void add_anisotropy(Keys& k, const std::string& at) {
  const std::vector<LawText> laws = law_texts(plasticity::AnisotropyLaws{});
  k.add(
      at, table,
      "Yield function of rolled sheet and of plies; without it von Mises', the same in all directions. That "
      "of a metal, whose elasticity stays isotropic, has its directions along axes of the model at the "
      "start; "
      "those of a ply (`elastic.law = \"orthotropic\"`) are along and across its fibres. They turn with the "
      "material.");
  add_law_choice(k, at, laws).required();
  add_source(k, at);
  add_law_constants(k, at, laws);
  const std::vector<std::string> axes(std::begin(plasticity::axis_names), std::end(plasticity::axis_names));
  k.add(at + ".rolling", choice, "Axis of the model along the rolling direction, of a metal.")
      .one_of(axes)
      .fallback("\"x\"");
  k.add(at + ".normal", choice,
        "Axis of the model along the normal of the sheet. `y` makes a plane model the section of a sheet "
        "whose "
        "thickness is along y; in the plane z is across it, around an axis it is the hoop direction.")
      .one_of(axes)
      .fallback("\"y\"");
}

void add_failure(Keys& k, const std::string& at) {
  using plasticity::Failure;
  k.add(at, table,
        "How a ply fails (`elastic.law = \"orthotropic\"`); without it it never does. Modes of fibres and of "
        "matrix have an index each, of the stress that intact matter would have (docs/theory.md).");
  k.add(at + ".law", choice,
        "`max-stress`: each stress over its strength; `hashin`: with the shear in the modes of tension "
        "(Hashin 1980); `larc02`: planes of fracture and kinks (Davila and Camanho 2003).")
      .one_of(
          {std::begin(plasticity::failure_criterion_names), std::end(plasticity::failure_criterion_names)})
      .required();
  add_source(k, at);
  add_constants(k, at, constant_texts<Failure>(Failure::parameters));
  k.add(
       at + ".degradation", choice,
       "What follows when an index is 1: `energy`: the stress of the mode falls linearly with its opening "
       "until "
       "its energy is spent; `sudden`: stiffness is lost at the rate (1 − d) c/ℓ, c the speed of the fastest "
       "wave, whose energy falls with the cells. A hundredth of the strength (`energy`) or of the "
       "stiffness (`sudden`) is always left.")
      .one_of({std::begin(plasticity::degradation_names), std::end(plasticity::degradation_names)})
      .fallback("\"energy\"");
}

void add_equation_of_state(Keys& k, const std::string& at) {
  using Law = plasticity::MieGruneisen;
  k.add(at, table,
        "Pressure of compressed metal; without it Kirchhoff's pressure is −κ times the logarithm of the "
        "volume.");
  k.add(at + ".law", choice, fmt::format("`{}`: {}.", Law::name, Law::formula))
      .one_of({Law::name})
      .required();
  add_source(k, at);
  add_constants(k, at, constant_texts<Law>(Law::parameters));
}

} // namespace

void add_materials(Keys& k) {
  const std::string at = "materials.*";
  const std::vector<LawText> hardening_laws = law_texts(plasticity::HardeningLaws{});
  k.add("materials", named_tables, "Materials.").required().or_in_library();
  k.add(at, table,
        "A material with all its constants, or with a `base` and what is different; without `plastic` it is "
        "elastic.");
  k.add(at + ".base", text,
        "A material of the library (docs/materials.md): its constants hold where this table has none of its "
        "own. A table with a `law` of its own replaces that of the base.")
      .example("\"lib:304L\"");
  k.add(at + ".leave_out", choices, "Tables of the `base` that are not taken.")
      .one_of({"plastic", "anisotropy", "equation_of_state", "failure", "damage", "heat"})
      .example("[\"damage\"]");
  k.add(at + ".origin", text,
        "Written into resolved cases: the material of the library, and which of its constants the case has "
        "changed.");
  k.add(at + ".description", text, "Which metal it is, in which condition.")
      .example("\"AISI 304L, annealed sheet\"");
  add_source(k, at).example("\"paper 004, 5.4.3\"");
  k.add(at + ".notes", texts, "What a user should know of them: doubts, other values in print.");
  add_constants(k, at, constant_texts<plasticity::Material>(plasticity::Material::parameters));
  const std::vector<LawText> elastic_laws = law_texts(plasticity::ElasticLaws{});
  k.add(at + ".elastic", table, "Elasticity, linear in logarithmic strain where nothing else is said.")
      .required();
  add_law_choice(k, at + ".elastic", elastic_laws).fallback("\"isotropic\"");
  add_source(k, at + ".elastic");
  add_law_constants(k, at + ".elastic", elastic_laws);
  k.add(at + ".elastic.measure", choice,
        "Strain that the stress of a ply is linear in, of its stress-free state: `log`: ½ ln C, `green`: "
        "½ (C − 1), which softens in compression and is at rest again below a stretch of 0.58 (paper 000 "
        "(51)–(53)).")
      .one_of({std::begin(plasticity::strain_measure_names), std::end(plasticity::strain_measure_names)})
      .fallback("\"log\"")
      .when("law", {plasticity::Orthotropic::name});
  k.add(at + ".plastic", table,
        "Plasticity; the flow stress is a Kirchhoff stress, that of tension along the rolling direction "
        "where there "
        "is an `anisotropy`.");
  add_law_choice(k, at + ".plastic", hardening_laws).required();
  add_source(k, at + ".plastic");
  add_law_constants(k, at + ".plastic", hardening_laws);
  add_range(k, at + ".plastic.range");
  add_anisotropy(k, at + ".anisotropy");
  add_equation_of_state(k, at + ".equation_of_state");
  add_failure(k, at + ".failure");
  add_damage(k, at + ".damage");
  k.add(at + ".heat", table, "Thermal properties.");
  add_source(k, at + ".heat");
  add_constants(k, at + ".heat", constant_texts<plasticity::Material>(plasticity::Material::heat_parameters));
  add_constants(k, at + ".heat", list_texts<HeatCurves>());
}

} // namespace cnem::input
