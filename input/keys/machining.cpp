// Keys of milling analyses, and which keys belong to them and which to analyses of bodies.
#include "input/constants.hpp"
#include "machining/laws/list.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>
#include <tuple>

namespace cnem::input {
namespace {

namespace d = dimension;
using enum Type;

/// Keys that both kinds of analyses have; of tables each member is looked at by itself.
constexpr std::array shared{"title",
                            "include",
                            "let",
                            "analysis",
                            "analysis.type",
                            "cutting",
                            "report",
                            "report.units",
                            "output",
                            "output.checkpoint",
                            "output.checkpoint.every_steps",
                            "output.checkpoint.every_time",
                            "output.checkpoint.every_wall",
                            "output.checkpoint.keep"};
/// Tables of milling, of structures whose modes are sought, and of both, with all that lies below them.
constexpr std::array structure_tables{"shaft", "removal"};
constexpr std::array common_tables{"part"};
constexpr std::array milling_tables{"cutter",  "cutting.law", "cutting.forces", "cutting.flank",
                                    "milling", "modes",       "stability",      "dexels"};

constexpr Range steep{.low = -60.0 * std::numbers::pi / 180.0, .high = 60.0 * std::numbers::pi / 180.0};

void add_cutter(Keys& k) {
  k.add("cutter", table, "The milling cutter.").required();
  k.add("cutter.diameter", quantity, "").unit(d::length).in(positive).required().example("\"12 mm\"");
  k.add("cutter.teeth", integer, "").in({.low = 1, .high = 64}).required().example("3");
  k.add("cutter.pitch", quantities,
        "Angles from each tooth to the one that cuts after it, as many as teeth; a whole turn together.")
      .unit(d::angle)
      .in(positive)
      .example("\"110 125 125 deg\"")
      .computed("equal angles");
  k.add("cutter.helix", quantity, "Of the edges: positive ones lag behind with their height over the tip.")
      .unit(d::angle)
      .in(steep)
      .fallback("\"0 deg\"");
  k.add(
       "cutter.rake", quantity,
       "Of the edges, normal to them: of laws over several rakes, and to be held against the range of a law.")
      .unit(d::angle)
      .in(steep)
      .example("\"10 deg\"");
  k.add("cutter.end", choice, "How the cutter ends; a bull end has a `corner` radius.")
      .one_of({"flat", "bull", "ball"})
      .fallback("\"flat\"");
  k.add("cutter.corner", quantity, "Radius between end and side of a bull end.")
      .unit(d::length)
      .in(positive)
      .example("\"2 mm\"");
  k.add(
      "cutter.rake_face", table,
      "In place of `end`, `corner`, `helix` and `rake`: the rake face of a tooth from an "
      "STL file, in axes of the cutter (z up along its axis, 0 at the tip; the tooth as it stands at first, "
      "seen from +z clockwise from +y). The other teeth follow at their `pitch`. The edge is the outer side "
      "of the face; its radius, length and angles are those of the triangles.");
  add_stl(k, "cutter.rake_face", "\"rake.stl\"").of_space();
  k.add("cutter.run_out", quantity, "Distance from the axis of the spindle to that of the cutter.")
      .unit(d::length)
      .in(not_negative)
      .fallback("\"0 m\"");
  k.add("cutter.run_out_angle", quantity, "From the first tooth to the direction of the run-out.")
      .unit(d::angle)
      .fallback("\"0 deg\"");
}

void add_law(Keys& k) {
  const std::vector<LawText> laws = law_texts(machining::CuttingLaws{});
  k.add("cutting.law", text,
        "A file with a cutting law, seen from the folder of the case, such as `cnem coefficients` writes "
        "(docs/milling.md): its values become those of `cutting.forces`. What the case gives there itself "
        "stands before them; `cutting.forces.law` chooses among the laws of the file.")
      .example("\"law.toml\"");
  k.add(
       "cutting.forces", table,
       "Forces on an edge per length along the axis of the cutter, over the chip thickness h: tangential "
       "against its motion, radial towards the axis, axial along it. Where nothing is cut there is no force.")
      .required();
  add_law_choice(k, "cutting.forces", laws).required();
  add_law_constants(k, "cutting.forces", laws);
  k.add("cutting.forces.range", table, "From where to where the law holds: beyond, there are warnings.");
  for (const auto& [name, dimension, meaning, example] :
       {std::tuple{"thickness", d::length, "Of the chip, smallest and largest.", "\"0.02 0.2 mm\""},
        {"speed", d::velocity, "Of the edge.", "\"1 5 m/s\""},
        {"rake", d::angle, "Of the edge, held against `cutter.rake`.", "\"0 10 deg\""}})
    k.add(std::string("cutting.forces.range.") + name, quantities, meaning).unit(dimension).example(example);
}

void add_flank(Keys& k) {
  k.add("cutting.flank", table,
        "A land behind the edge that ploughs: it is part of a circle about the axis of the cutter, and what "
        "it presses of the surface that the edge has just made makes a force. Vibrations are damped by it. "
        "Without it flanks are free.");
  k.add("cutting.flank.land", quantity,
        "Width of the land, along the way of the edge; at most half the radius of the cutter.")
      .unit(d::length)
      .in(positive)
      .required()
      .example("\"80 um\"");
  k.add("cutting.flank.clearance", quantity, "By which the land leaves the circle. 0: it is worn.")
      .unit(d::angle)
      .in({.low = 0.0, .high = std::numbers::pi / 4.0})
      .fallback("\"0 deg\"");
  k.add("cutting.flank.recovery", quantity,
        "By how much the surface springs back behind the edge: as deep a steady land presses, and as much "
        "has to be left of the contact for vibrations to be damped both ways.")
      .unit(d::length)
      .in(not_negative)
      .fallback("\"0 m\"");
  k.add("cutting.flank.specific_force", quantity,
        "Force normal to the land per volume that is pressed in (Wu 1989).")
      .unit(d::force_per_volume)
      .in(positive)
      .required()
      .example("\"40 kN/mm^3\"");
  k.add("cutting.flank.friction", quantity, "Of that force, against the motion of the edge.")
      .in(not_negative)
      .fallback("0.3");
}

void add_passes(Keys& k) {
  const std::string pass = "milling.passes[].", blank = "milling.workpiece.";
  k.add(
      "milling.passes", table_list,
      "In the time domain: ways of the cutter's axis through `milling.workpiece`, one after the other; each "
      "cuts what those before it have left. The machined side is on the left of the way in up-milling, on "
      "its right in down-milling. `milling.start` is `outside` then, or `hole`. The surface is told of the "
      "last one.");
  k.add(pass + "start", vector, "Of the axis.").unit(d::length).required().example("\"-8 0 mm\"");
  k.add(
       pass + "tip", quantity,
       "Height of the tip of the cutter over the bottom of the workpiece, the same all along the pass: it is "
       "lifted between passes. Ramps and plunges, on which its end cuts, are not known.")
      .unit(d::length)
      .in(not_negative)
      .fallback("\"0 m\"");
  k.add(pass + "path", table_list, "Straight pieces and arcs, one behind the other.").required();
  k.add(pass + "path[].to", vector, "End of the piece; it begins where the one before ends.")
      .unit(d::length)
      .required()
      .example("\"40 0 mm\"");
  add_arc(k, pass + "path[]");
  k.add("milling.workpiece", table,
        "Of `milling.passes`: what there is before the first. Heights count from 0, where tips are "
        "that are given no other place.");
  k.add(blank + "height", quantity,
        "Of a block; of other workpieces as far as they are looked at. Edges, but those of a "
        "`cutter.rake_face`, are as long as it takes.")
      .unit(d::length)
      .in(positive)
      .example("\"6 mm\"")
      .computed("`milling.axial_depth` over the highest `tip` of a pass");
  k.add(blank + "from", vector, "A corner of a block.").unit(d::length).example("\"0 0 mm\"");
  k.add(blank + "to", vector, "The opposite corner.").unit(d::length).example("\"40 20 mm\"");
  k.add(blank + "run", text,
        "In place of a block: the folder of an earlier run of `milling.passes`, seen from the folder of the "
        "case. The workpiece is what it has left, in the same axes; the cutter goes on turning from where it "
        "was.")
      .example("\"../roughing/results\"");
  k.add(blank + "content", text,
        "Checksum of what that run has left, in resolved cases; another one is refused.");
  k.add(blank + "stl", table, "A closed surface from an STL file, in place of a block.");
  add_stl(k, blank + "stl", "\"blank.stl\"").of_space();
}

void add_milling(Keys& k) {
  k.add("milling", table, "The cut. The feed is along +x, the cutter turns clockwise seen from +z.")
      .required();
  k.add("milling.speed", function, "Of the spindle, > 0. In the time domain it may change with time.")
      .unit(d::angular_velocity)
      .required()
      .example("\"8000 rpm\"");
  k.add("milling.feed", function,
        "Per tooth, the mean of a turn, > 0. In the time domain it may change with time.")
      .unit(d::length)
      .required()
      .example("\"0.1 mm\"");
  k.add("milling.axial_depth", quantity,
        "Along the axis of the cutter. With `milling.passes` what a pass cuts follows from them and the "
        "workpiece.")
      .unit(d::length)
      .in(positive)
      .required()
      .example("\"2 mm\"");
  k.add("milling.radial_depth", quantity, "Across axis and feed, at most the diameter, which is a slot.")
      .unit(d::length)
      .in(positive)
      .example("\"3 mm\"")
      .computed("`cutter.diameter`");
  k.add("milling.side", choice,
        "`up`: chips begin thin, the cut lies from the +y side of the cutter inwards; `down`: they end thin, "
        "it lies from the −y side inwards.")
      .one_of({"up", "down"})
      .fallback("\"down\"");
  k.add("milling.length", quantity, "In the time domain: how far the axis of the cutter goes.")
      .unit(d::length)
      .in(positive)
      .example("\"20 mm\"")
      .computed("twelve turns");
  k.add("milling.dwell", quantity, "In the time domain: turns at the end of the path, without feed.")
      .in(not_negative)
      .fallback("0");
  k.add(
       "milling.start", choice,
       "In the time domain: `inside`: the cutter begins in the middle of a cut; `hole`: in a hole of its own "
       "size; `outside`: beside the workpiece, which ends at x = 0.")
      .one_of({"inside", "hole", "outside"})
      .fallback("\"inside\"");
  add_passes(k);
  k.add("dexels", table, "How matter and motion are resolved in the time domain.").always();
  k.add("dexels.pitch", quantity,
        "Distance of the dexels: where the surface is told. Chips do not depend on it.")
      .unit(d::length)
      .in(positive)
      .example("\"10 um\"")
      .computed("a tenth of `milling.feed`");
  k.add(
       "dexels.layers", integer,
       "Along the axis of the cutter, in `milling.axial_depth`: equally thick, but those of rounded ends and "
       "of rake faces are thin where angles of their edges change much. Higher workpieces have as many more; "
       "each `tip` of a pass lies between two.")
      .in({.low = 1, .high = 2000})
      .example("20")
      .computed(
          "edges of a layer enter and leave at most a step, 0.5 to 1 deg, after those below; of rounded "
          "ends and rake faces their normal leans by 4.5 deg less at most, and it is a twentieth of the "
          "depth at most");
  k.add("dexels.steps", integer, "In a turn.").in({.low = 36, .high = 1e6}).fallback("720");
}

void add_modes(Keys& k) {
  k.add(
      "modes", named_tables,
      "Modes of vibration of tool and part, as a tap test gives them. Stability needs one; without any a cut "
      "in the time domain is rigid.");
  k.add("modes.*", table, "A mode.");
  k.add("modes.*.of", choice, "What vibrates.").one_of({"tool", "part"}).fallback("\"tool\"");
  k.add("modes.*.frequency", quantity, "Without damping.")
      .unit(d::rate)
      .in(positive)
      .required()
      .example("\"922 Hz\"");
  k.add("modes.*.damping", quantity, "ζ, the share of critical damping.")
      .in({.low = 0.0, .high = 1.0, .low_open = true, .high_open = true})
      .required()
      .example("0.011");
  k.add("modes.*.stiffness", quantity, "Modal, of the direction where the cutter cuts.")
      .unit(d::force_per_length)
      .in(positive)
      .example("\"1.34 N/um\"")
      .computed("(2π frequency)² `mass`");
  k.add("modes.*.mass", quantity, "Modal, in place of `stiffness`.")
      .unit(d::mass)
      .in(positive)
      .example("\"0.04 kg\"");
  k.add("modes.*.direction", vector, "Along which it moves where the cutter cuts, of any length.")
      .of_space()
      .required()
      .example("\"1 0 0\"");
}

void add_shapes(Keys& k) {
  k.add("modes.*.along", quantities,
        "In the time domain, and for `stability.places`: places of the cutter's axis along x, increasing, "
        "for `shape_along`.")
      .unit(d::length)
      .example("\"0 50 100 mm\"");
  k.add("modes.*.shape_along", quantities,
        "How the mode changes along the path, as shares of where `stiffness` is taken.")
      .example("\"1 0.8 1\"");
  k.add("modes.*.frequency_along", quantities,
        "In charts of `stability.places`: how the frequency changes with `along`, as shares of `frequency`; "
        "the "
        "modal mass stays. A wall that gets thinner.")
      .example("\"1 0.9 0.8\"");
  k.add("modes.*.height", quantities,
        "In the time domain: heights, increasing, for `shape_over_height`; of a tool over its tip, of a part "
        "over 0, where tips are that are given no other place.")
      .unit(d::length)
      .example("\"0 18 mm\"");
  k.add("modes.*.shape_over_height", quantities,
        "How the mode changes over the height, as shares of where `stiffness` is taken.")
      .example("\"0.4 1\"");
}

void add_stability(Keys& k) {
  k.add("stability", table,
        "The chart of `analysis.type = \"stability\"`: spectral radius over speed of the spindle and axial "
        "depth.")
      .always();
  k.add("stability.speed_from", quantity, "")
      .unit(d::angular_velocity)
      .in(positive)
      .example("\"5000 rpm\"")
      .computed("half of `milling.speed`");
  k.add("stability.speed_to", quantity, "")
      .unit(d::angular_velocity)
      .in(positive)
      .example("\"10000 rpm\"")
      .computed("1.5 `milling.speed`");
  k.add("stability.speeds", integer, "").in({.low = 2, .high = 2000}).fallback("200");
  k.add("stability.depth_to", quantity, "The chart begins at 0.")
      .unit(d::length)
      .in(positive)
      .example("\"5 mm\"")
      .computed("six times the smallest limit of zero order, and beyond `milling.axial_depth`");
  k.add("stability.places", quantities,
        "Places of the cutter's axis along x, increasing, at which limits over the speed are charted, of "
        "modes that change "
        "along the path (`along`, `shape_along`, `frequency_along`), and of `part` where the cutter is that "
        "has gone on so far along `part.feed` from `part.cutter`, at up to 25 depths. The lobes are those "
        "of the "
        "weakest place at `milling.speed` then.")
      .unit(d::length)
      .example("\"0 25 50 75 100 mm\"");
  k.add("stability.takes", text,
        "A zone of `part.zones` that the cutter takes on its way: at each of `places` what lies behind the "
        "cutter is gone (D 0.999).")
      .example("\"stock\"");
  k.add("stability.edge_forces", boolean,
        "Whether edge forces (`Kte`, `Kre`: those of a chip without thickness) count. They push the tool off "
        "and change nothing, but where an edge comes to the cut, or leaves it, with a chip of no thickness: "
        "where that happens moves with the vibration.")
      .fallback("false");
  k.add("stability.depths", integer, "").in({.low = 2, .high = 2000}).fallback("100");
}

} // namespace

void add_machining(Keys& k) {
  add_cutter(k);
  add_law(k);
  add_flank(k);
  add_milling(k);
  add_modes(k);
  add_shapes(k);
  add_stability(k);
}

void mark_families(Keys& k) {
  const auto in = [](const auto& list, const auto& matches) {
    return std::any_of(list.begin(), list.end(), matches);
  };
  for (Key& key : k.all) {
    if (in(shared, [&](const char* path) { return key.path == path; })) continue;
    const auto stands_below = [&](const char* path) { return below(key.path, path); };
    key.family = in(milling_tables, stands_below)     ? Family::milling
                 : in(structure_tables, stands_below) ? Family::structures
                 : in(common_tables, stands_below)    ? Family::machining
                                                      : Family::bodies;
  }
}

} // namespace cnem::input
