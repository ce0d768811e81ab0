// Keys of materials.
#include "input/keys.hpp"

namespace cnem::input {
namespace {

namespace d = dimension;
using enum Type;

void add_damage(Keys& k, const std::string& at) {
  k.add(at, table, "Ductile damage and separation; without it the material never breaks.");
  k.add(at + ".law", choice,
        "`johnson-cook`: damage grows by dε̄p/ε_f, ε_f = [D1 + D2 exp(D3 σ*)] [1 + D4 ln(ε̄̇p/rate0)] [1 + D5 "
        "T*], σ* = mean stress over von Mises stress, positive in tension. At 1 the flow stress, and the "
        "mean stress in tension, begin to fall until `fracture_energy` is spent.")
      .one_of({"johnson-cook"})
      .required();
  k.add(at + ".source", text, "Where these constants come from; the report calls them generic without it.")
      .example("\"Johnson and Cook 1985\"");
  k.add(at + ".D1", quantity, "").required().example("0.05");
  k.add(at + ".D2", quantity, "").required().example("3.44");
  k.add(at + ".D3", quantity,
        "Negative where tension makes the material less ductile: some tables give it for exp(−D3 σ*).")
      .required()
      .example("-2.12");
  k.add(at + ".D4", quantity, "Influence of the rate; none below `rate0`.").fallback("0.0");
  k.add(at + ".D5", quantity, "Influence of the temperature.").fallback("0.0");
  k.add(at + ".rate0", quantity, "Reference strain rate.")
      .unit(d::rate)
      .in(positive)
      .computed("`plastic.rate0`, else 1 /s");
  k.add(at + ".T0", quantity, "Temperature at which T* is 0.")
      .unit(d::temperature)
      .in(temperature_range)
      .example("\"293.15 K\"")
      .computed("`plastic.T0`, else 293.15 K");
  k.add(at + ".Tmelt", quantity, "Melting temperature, at which T* is 1; without it T* is 0.")
      .unit(d::temperature)
      .in(temperature_range)
      .example("\"1793 K\"")
      .computed("`plastic.Tmelt`");
  k.add(at + ".fracture_energy", quantity,
        "Plastic work per area that a band takes from the beginning of softening until it is broken.")
      .unit(d::surface_energy)
      .in(positive)
      .required();
  k.add(at + ".residual_strength", quantity,
        "Share of the flow stress that broken matter keeps, as rubble and the edges of cracks do; tension is "
        "lost whole.")
      .in({.low = 0.0, .high = 1.0, .high_open = true})
      .fallback("0");
  k.add(at + ".band", quantity,
        "Thickness of the band in which cells break, in cell sizes √area: with it the fracture energy is "
        "spread over the cells. docs/theory.md says where the default comes from.")
      .in(positive)
      .fallback("2.5");
  k.add(at + ".cut_off", quantity, "No damage grows at this σ* or below; without it damage grows at any σ*.")
      .example("-0.3333");
}

} // namespace

void add_materials(Keys& k) {
  const std::string at = "materials.*.";
  k.add("materials", named_tables, "Materials.").required();
  k.add("materials.*", table, "A material with all its constants; without `plastic` it is elastic.");
  k.add(at + "source", text, "Where the constants come from.").example("\"paper 004, 5.4.3\"");
  k.add(at + "density", quantity, "").unit(d::density).in(positive).required();
  k.add(at + "elastic", table, "Isotropic elasticity, linear in logarithmic strain.").required();
  k.add(at + "elastic.young", quantity, "Young's modulus.")
      .unit(d::pressure)
      .in(positive)
      .required()
      .example("\"210 GPa\"");
  k.add(at + "elastic.poisson", quantity, "Poisson's ratio.")
      .in({.low = -1.0, .high = 0.5, .low_open = true, .high_open = true})
      .required()
      .example("0.33");
  k.add(at + "plastic", table, "Isotropic plasticity; the flow stress is a Kirchhoff stress.");
  k.add(at + "plastic.law", choice,
        "`johnson-cook`: (A + B ε̄pⁿ)(1 + C ln(ε̄̇p/rate0))(1 − T*ᵐ), T* = (T − T0)/(Tmelt − T0) clipped to [0, "
        "1]; `linear`: yield + hardening ε̄p; `perfect`: yield; `voce`: yield + hardening ε̄p + (saturation − "
        "yield)"
        "(1 − exp(−exponent ε̄p)).")
      .one_of({"johnson-cook", "linear", "perfect", "voce"})
      .required();
  k.add(at + "plastic.A", quantity, "Yield stress.")
      .unit(d::pressure)
      .in(not_negative)
      .required()
      .when("law", {"johnson-cook"});
  k.add(at + "plastic.B", quantity, "Hardening.")
      .unit(d::pressure)
      .in(not_negative)
      .required()
      .when("law", {"johnson-cook"})
      .example("\"685 MPa\"");
  k.add(at + "plastic.n", quantity, "Hardening exponent.")
      .in(positive)
      .required()
      .when("law", {"johnson-cook"})
      .example("0.312");
  k.add(at + "plastic.C", quantity, "Rate sensitivity; none below `rate0`.")
      .in(not_negative)
      .fallback("0.0")
      .when("law", {"johnson-cook"});
  k.add(at + "plastic.rate0", quantity, "Reference strain rate.")
      .unit(d::rate)
      .in(positive)
      .fallback("\"1 /s\"")
      .when("law", {"johnson-cook"});
  k.add(at + "plastic.m", quantity, "Exponent of thermal softening.")
      .in(positive)
      .fallback("1.0")
      .when("law", {"johnson-cook"});
  k.add(at + "plastic.T0", quantity, "Temperature below which nothing softens.")
      .unit(d::temperature)
      .in(temperature_range)
      .fallback("\"293.15 K\"")
      .when("law", {"johnson-cook"});
  k.add(at + "plastic.Tmelt", quantity, "Melting temperature; without it there is no thermal softening.")
      .unit(d::temperature)
      .in(temperature_range)
      .when("law", {"johnson-cook"})
      .example("\"1698 K\"");
  k.add(at + "plastic.yield", quantity, "Yield stress.")
      .unit(d::pressure)
      .in(positive)
      .required()
      .when("law", {"linear", "perfect", "voce"})
      .example("\"400 MPa\"");
  k.add(at + "plastic.hardening", quantity, "Slope of the flow stress over plastic strain.")
      .unit(d::pressure)
      .in(not_negative)
      .required()
      .when("law", {"linear", "voce"})
      .example("\"100 MPa\"");
  k.add(at + "plastic.saturation", quantity, "What `yield` saturates to, without the linear part.")
      .unit(d::pressure)
      .in(positive)
      .required()
      .when("law", {"voce"})
      .example("\"715 MPa\"");
  k.add(at + "plastic.exponent", quantity, "How fast it saturates, per plastic strain.")
      .in(positive)
      .required()
      .when("law", {"voce"})
      .example("16.93");
  add_damage(k, at + "damage");
  k.add(at + "heat", table, "Thermal properties.");
  k.add(at + "heat.specific_heat", quantity, "").unit(d::specific_heat).in(positive).required();
  k.add(at + "heat.conductivity", quantity, "0: adiabatic.")
      .unit(d::conductivity)
      .in(not_negative)
      .required();
  k.add(at + "heat.taylor_quinney", quantity, "Share of plastic work that becomes heat.")
      .in(fraction)
      .fallback("0.9");
  k.add(at + "heat.expansion", quantity, "Linear thermal expansion.")
      .unit(d::expansion)
      .fallback("\"0 1/K\"");
  k.add(at + "heat.reference_temperature", quantity, "Temperature without thermal strain.")
      .unit(d::temperature)
      .in(temperature_range)
      .example("\"296 K\"")
      .computed("`initial.temperature`");
}

} // namespace cnem::input
