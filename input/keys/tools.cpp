// Keys of tools and of contact with them.
#include "input/case.hpp"
#include "input/constants.hpp"
#include "input/keys/keys.hpp"

#include <fmt/format.h>

namespace cnem::input {

namespace d = dimension;
using enum Type;

void add_friction(Keys& k, const std::string& at, const std::string& doc) {
  const std::vector<LawText> laws = law_texts(contact::FrictionLaws{});
  k.add(at, table, doc).always();
  add_law_choice(k, at, laws).fallback("\"none\"");
  add_law_constants(k, at, laws);
  add_constants(k, at, constant_texts<contact::FrictionMelting>(contact::FrictionMelting::parameters));
}

void add_friction_by_material(Keys& k, const std::string& friction) {
  const std::string at = friction + ".by_material";
  k.add(at, named_tables,
        "By names of `materials`: friction of a law with a `coefficient` has another one on these. A node "
        "that touches "
        "counts with its material.");
  k.add(at + ".*", table, "Friction on one material.");
  k.add(at + ".*.coefficient", quantity, "μ on this material.").in(not_negative).required().example("0.2");
}

namespace {

void add_tool_section(Keys& k, const std::string& at) {
  k.add(at, table,
        "Nodes that let the tool conduct: it starts at `heat.temperature`, takes its share of the friction "
        "heat "
        "where it arises, and what passes through `heat.conductance`. Without it the tool stays at "
        "`heat.temperature`.");
  k.add(at + ".spacing", quantity, "Distance of neighbouring nodes away from refinements.")
      .unit(d::length)
      .in(positive)
      .required()
      .example("\"0.1 mm\"");
  add_refinements(k, at, " of the nodes of the tool, as it stands at time 0", false);
  k.add(at + ".held", texts,
        "Names of pieces of the outline that keep `heat.temperature`, as the far end of a tool in its holder "
        "does; the others are adiabatic but where they touch.")
      .example("[\"shank\"]");
  k.add(at + ".heat_capacity_factor", quantity,
        "On the heat capacity of the tool and its coating: less than 1 brings a steady temperature, which "
        "does "
        "not depend on it, about within a shorter cut.")
      .in({.low = 0.0, .high = 1.0, .low_open = true})
      .fallback("1.0");
  k.add(at + ".coating", table, "A layer on all faces, across which heat flows.");
  add_constants(k, at + ".coating", constant_texts<ToolCoating>(ToolCoating::parameters));
}

/// What bounds a tool in space.
void add_solid(Keys& k, const std::string& at) {
  k.add(at + "shape", choice,
        "What bounds the tool. `half-space`: a `plane`. `box`: between two corners. `extruded`: the outline "
        "(`start` and `path`, `rectangle`, `circle` or `drawing`), which lies across the z axis of the tool, "
        "along that axis. `revolved`: the outline, its x the distance from the z axis of the tool and its y "
        "along it, turned about the axis. `swept`: a `profile` goes along the outline. `stl`: triangles of a "
        "file. All but the first are placed by `place`.")
      .one_of({"half-space", "box", "extruded", "revolved", "swept", "stl"})
      .fallback("\"half-space\"");
  k.add(at + "plane", table, "A tool bounded by a plane, a wall or an anvil.")
      .required()
      .when("shape", {"half-space"});
  k.add(at + "plane.at", vector, "A point of the plane at time 0.").unit(d::length).required();
  k.add(at + "plane.normal", vector, "Out of the tool, towards the workpiece; of any length.").required();
  k.add(at + "box", table, "A box parallel to the axes of the tool.").required().when("shape", {"box"});
  k.add(at + "box.from", vector, "A corner.").unit(d::length).required().example("\"0 0 0 mm\"");
  k.add(at + "box.to", vector, "The opposite corner.").unit(d::length).required().example("\"20 10 5 mm\"");
  k.add(at + "extrude", table, "From where to where an outline is extruded, along the z axis of the tool.")
      .when("shape", {"extruded"});
  k.add(at + "extrude.from", quantity, "").unit(d::length).example("\"0 mm\"").computed("without end");
  k.add(at + "extrude.to", quantity, "").unit(d::length).example("\"10 mm\"").computed("without end");
  k.add(
       at + "extrude.edge_from", quantity,
       "Radius of the edge round the end `from`: a cutting edge. Convex corners of the outline need the same "
       "radius at least.")
      .unit(d::length)
      .in(not_negative)
      .fallback("\"0 mm\"");
  k.add(at + "extrude.edge_to", quantity, "The same at the end `to`.")
      .unit(d::length)
      .in(not_negative)
      .fallback("\"0 mm\"");
  k.add(at + "profile", table,
        "A section that goes along the outline: its x is the distance from the outline, positive outside of "
        "it, "
        "its y is along the z axis of the tool. A die is one to the right of x = 0, along the outline of its "
        "opening.")
      .required()
      .when("shape", {"swept"});
  add_outline(k, at + "profile", "the name of the tool");
  k.add(at + "stl", table, "Triangles, in text or binary, that close around the solid and face outwards.")
      .required()
      .when("shape", {"stl"});
  k.add(at + "stl.file", text, "Relative to the file of the case.").required().example("\"punch.stl\"");
  k.add(at + "stl.content", text, stl_content);
  k.add(at + "stl.unit", quantity, "Length of the file's unit.")
      .unit(d::length)
      .in(positive)
      .fallback("\"1 mm\"");
  k.add(at + "place", table,
        "Where the axes of the tool lie at time 0: without it they are those of the workpiece.");
  k.add(at + "place.at", vector, "Where its (0, 0, 0) comes to lie.")
      .unit(d::length)
      .example("\"0 0 5 mm\"")
      .computed("0");
  k.add(at + "place.axis", vector, "Where its z axis points, of any length.")
      .example("\"0 1 0\"")
      .computed("along z");
  k.add(at + "place.turn", quantity, "How far it is turned about its z axis first.")
      .unit(d::angle)
      .fallback("\"0 deg\"");
}

} // namespace

void add_tools(Keys& k) {
  const std::string at = "tools.*.";
  k.add("tools", named_tables, "Rigid tools.");
  k.add("tools.*", table,
        "A rigid tool, solid inside its outline: either `start` and `path`, or `rectangle`, or `circle`; in "
        "three-dimensional analyses of a `shape`.");
  add_outline(k, "tools.*", "the name of the tool");
  add_solid(k, at);
  k.add(at + "velocity", vector_function,
        "Prescribed translation; constant, ramped or over time. With `spring` that of its mount.")
      .unit(d::velocity)
      .example("\"0 -11 m/s\"")
      .computed("0 without `mass`");
  add_drive(k, at);
  k.add(at + "equal_areas", boolean,
        "Edges of the workpiece lie as much inside the tool as outside: nodes stay off its arcs, else "
        "they lie on them and chords inside; and where a corner falls between two nodes the face beside "
        "it presses on what it covers of the edge, else it bears as if it reached to the next node.")
      .fallback("false");
  add_friction(k, at + "friction", "Friction on the workpiece.");
  add_friction_by_material(k, at + "friction");
  const std::vector<LawText> responses = law_texts(contact::Responses{});
  k.add(at + "response", table,
        "What keeps the workpiece out of the tool. All but `\"exact\"` let nodes in first, and corners "
        "between "
        "nodes: they are there to compare with what others compute.")
      .always();
  add_law_choice(k, at + "response", responses)
      .example("\"exact\"")
      .computed(
          "`\"exact\"`; with `contact.scheme = \"central-difference\"` `\"penalty\"` with a `scale` of 2");
  add_law_constants(k, at + "response", responses);
  k.add(at + "heat", table, "Thermal side of the tool; without it the contact is insulated.");
  add_constants(k, at + "heat", constant_texts<contact::ToolThermal>(contact::ToolThermal::parameters));
  add_constants(k, at + "heat", constant_texts<contact::ToolMetal>(contact::ToolMetal::parameters));
  add_constants(k, at + "heat", list_texts<HeatCurves>());
  add_tool_section(k, at + "heat.section");
}

void add_contact(Keys& k) {
  k.add("contact", table, "Contact of parts of the workpiece with each other.").always();
  k.add(
       "contact.scheme", choice,
       "What keeps the workpiece out of tools without a `response` of their own. `kinematic`: exact, "
       "positions "
       "and speeds are corrected so that nothing enters. `central-difference`: paper 000's, f_n = 2 m g/Δt² "
       "on "
       "nodes of mass m at a depth g, and along the face m v/Δt, at most the bound of friction. Parts of the "
       "workpiece meet each other by the first in any case.")
      .one_of({"kinematic", "central-difference"})
      .fallback("\"kinematic\"");
  k.add(
       "contact.deformable", boolean,
       "Faces of the workpiece do not pass through each other: parts that cracks divide, and one part with "
       "itself; in space also images a period away (`periodic`). Bonded interfaces and periodic sides are no "
       "such faces.")
      .fallback("false");
  k.add("contact.conductance", quantity,
        "Of faces of the workpiece while they are pressed on each other: heat that passes, per area and "
        "difference of temperature.")
      .unit(d::heat_transfer)
      .in(not_negative)
      .fallback("\"0 W/(m2 K)\"");
  add_friction(k, "contact.friction", "Friction between parts; its heat is shared by their effusivities.");
}

} // namespace cnem::input
