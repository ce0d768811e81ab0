// Keys of structures: parts and shafts whose modes are sought.
#include "input/keys/keys.hpp"

#include <string>

namespace cnem::input {
namespace {

namespace d = dimension;
using enum Type;

constexpr Dimension moment = Dimension::of(2, 1, -2), moment_rate = Dimension::of(2, 1, -1),
                    force_rate = Dimension::of(0, 1, -1);
constexpr Range share{.low = 0.0, .high = 1.0};
constexpr Range poisson_range{.low = -1.0, .high = 0.5, .low_open = true, .high_open = true};

void add_elasticity_of(Keys& k, const std::string& at) {
  k.add(at + ".young", quantity, "Young's modulus.")
      .unit(d::pressure)
      .in(positive)
      .required()
      .example("\"210 GPa\"");
  k.add(at + ".poisson", quantity, "Poisson's ratio.").in(poisson_range).fallback("0.3");
  k.add(at + ".density", quantity, "").unit(d::density).in(positive).required().example("\"7800 kg/m3\"");
}

/// Of a piece: what it has in place of the whole's.
void add_other_solid(Keys& k, const std::string& at, const std::string& whole) {
  const auto as_whole = [&](const char* name) { return "`" + whole + "." + name + "`"; };
  k.add(at + ".young", quantity, "")
      .unit(d::pressure)
      .in(positive)
      .example("\"70 GPa\"")
      .computed(as_whole("young"));
  k.add(at + ".poisson", quantity, "").in(poisson_range).example("0.3").computed(as_whole("poisson"));
  k.add(at + ".density", quantity, "")
      .unit(d::density)
      .in(positive)
      .example("\"2700 kg/m3\"")
      .computed(as_whole("density"));
}

void add_part(Keys& k) {
  const std::vector<std::string> faces{"x0", "x1", "y0", "y1", "z0", "z1"};
  k.add("part", table,
        "A part that vibrates: a box from (0, 0, 0), with zones that have another material or are gone. "
        "Stability "
        "takes its modes beside those of `modes`.");
  k.add("part.size", vector, "Of the box; the thickness of plates is along z.")
      .of_space()
      .unit(d::length)
      .required()
      .example("\"100 40 4 mm\"");
  add_elasticity_of(k, "part");
  k.add("part.element", choice,
        "`hexahedron_27`: triquadratic, does not lock; `plate_8`: Mindlin's plate, cells over each other are "
        "its "
        "layers, with an offset where they lie beside half the height of the box; `hexahedron_8`: trilinear, "
        "fully integrated: it locks in bending, and is there to compare with.")
      .one_of({"hexahedron_27", "hexahedron_8", "plate_8"})
      .fallback("\"hexahedron_27\"");
  k.add("part.cells", vector, "Along x, y and z, at least; the ends of zones divide more.")
      .of_space()
      .example("\"20 8 1\"")
      .computed(
          "20 along the longest side, of `hexahedron_27` 30 where that makes at most 1000, as long along the "
          "others; of `hexahedron_27` thin ones too on both sides of steps and beside clamped faces, and "
          "fewer "
          "along the longest side, down to 10, where they are more than 3000 then");
  k.add("part.clamped", choices, "Faces of the box that are held, `x0` where x is 0.")
      .one_of(faces)
      .example("[\"y0\"]");
  k.add("part.supported", choices, "Faces of the box, of plates, that are held but turn about their edge.")
      .one_of({"x0", "x1", "y0", "y1"})
      .example("[\"x0\", \"x1\"]");
  k.add("part.count", integer, "Modes that are sought.").in({.low = 1, .high = 200}).fallback("6");
  k.add("part.damping", quantity, "ζ, of each mode. Stability needs it, or `part.rayleigh`.")
      .in({.low = 0.0, .high = 1.0, .high_open = true})
      .example("0.005");
  k.add("part.rayleigh", table, "Damping α M + β K, in place of `damping`.");
  k.add("part.rayleigh.mass", quantity, "α.").unit(d::rate).in(not_negative).fallback("\"0 /s\"");
  k.add("part.rayleigh.stiffness", quantity, "β.").unit(d::time).in(not_negative).fallback("\"0 s\"");
  k.add("part.cutter", vector, "Where the cutter cuts: what stability takes the modes' motion of.")
      .of_space()
      .unit(d::length)
      .example("\"50 31 4 mm\"");
  k.add("part.feed", vector, "Direction of the feed, +x of the cutter, in the part.")
      .of_space()
      .fallback("\"1 0 0\"");
  k.add("part.axis", vector, "Direction of the cutter's axis, its +z, in the part.")
      .of_space()
      .fallback("\"0 0 1\"");
  k.add(
       "part.mapping", choice,
       "In the time domain: `point`: the part moves as a whole, as its modes do at `cutter`; `hexahedra`: it "
       "deforms, and the dexels lie in its undeformed state. `cutter` is then where the cutter is at first, "
       "on "
       "the machined side at the height of its tip, or of `milling.passes` their point (0, 0) "
       "([more](structures.md#in-the-time-domain)).")
      .one_of({"point", "hexahedra"})
      .fallback("\"point\"");
  k.add("part.hexahedra", vector, "How many there are over the workpiece along x, y and z of the cut.")
      .of_space()
      .when("mapping", {"hexahedra"})
      .example("\"1 1 1\"")
      .computed("none longer than the cutter's radius");
  k.add("part.integration", choice,
        "`modes`: `count` of them, exactly under the mean force of each step; `newmark`: all unknowns, "
        "damped by "
        "`rayleigh`.")
      .one_of({"modes", "newmark"})
      .when("mapping", {"hexahedra"})
      .fallback("\"modes\"");
  k.add("part.removal", table,
        "The part loses what the tool takes: D of its cells is that of a rigid run of the cut, which is made "
        "first. "
        "With `integration = \"newmark\"`.");
  k.add("part.removal.interval", integer,
        "Steps from one factor of K̂ to the next: between them it is interpolated.")
      .in({.low = 1, .high = 1e9})
      .fallback("200");
  k.add("part.removal.most", quantity, "D of what is gone.")
      .in({.low = 0.0, .high = 1.0, .low_open = true, .high_open = true})
      .fallback("0.999");
  k.add("part.zones", named_tables, "Boxes within the part; where they overlap the last one counts.");
  k.add("part.zones.*", table, "A box.");
  for (const char* corner : {".from", ".to"})
    k.add("part.zones.*" + std::string(corner), vector, "")
        .of_space()
        .unit(d::length)
        .required()
        .example("\"0 16 2 mm\"");
  k.add("part.zones.*.taken", quantity,
        "D, the share of it that is gone: E (1 − D) and ρ (1 − D); 1: there are no cells.")
      .in(share)
      .fallback("0");
  add_other_solid(k, "part.zones.*", "part");
  k.add("part.points", named_tables, "Places that are looked at, and loaded.");
  k.add("part.points.*", table, "A place.");
  k.add("part.points.*.at", vector, "A point of the part.")
      .of_space()
      .unit(d::length)
      .example("\"100 40 0 mm\"");
  k.add("part.points.*.face", choice, "In place of `at`: the mean over a face of the box.")
      .one_of(faces)
      .example("\"y1\"");
  k.add("part.points.*.force", vector, "On it; static displacements are those under all forces together.")
      .of_space()
      .unit(d::force)
      .fallback("\"0 0 0 N\"");
}

void add_shaft(Keys& k) {
  k.add(
      "shaft", table,
      "Shank, holder and spindle as Timoshenko beams along z that turn, on bearings. Vibrations are those of "
      "bending.");
  add_elasticity_of(k, "shaft");
  k.add("shaft.speed", quantity, "At which it turns.").unit(d::angular_velocity).fallback("\"0 rpm\"");
  k.add("shaft.count", integer, "Modes that are sought: twice each where it stands still.")
      .in({.low = 1, .high = 200})
      .fallback("8");
  k.add("shaft.element", quantity, "Length of elements, at most.")
      .unit(d::length)
      .in(positive)
      .example("\"10 mm\"")
      .computed("a fortieth of the shaft");
  k.add("shaft.sections", named_tables, "Pieces, which go on where the one before ends.").required();
  k.add("shaft.sections.*", table, "A cylinder or a tube.");
  k.add("shaft.sections.*.from", quantity, "").unit(d::length).required().example("\"0 mm\"");
  k.add("shaft.sections.*.to", quantity, "").unit(d::length).required().example("\"60 mm\"");
  k.add("shaft.sections.*.diameter", quantity, "")
      .unit(d::length)
      .in(positive)
      .required()
      .example("\"50 mm\"");
  k.add("shaft.sections.*.bore", quantity, "Inner diameter.")
      .unit(d::length)
      .in(not_negative)
      .fallback("\"0 mm\"");
  k.add("shaft.sections.*.shear_correction", quantity, "κ of the cross-section.")
      .in({.low = 0.0, .high = 1.0, .low_open = true})
      .example("0.886")
      .computed("Cowper's");
  add_other_solid(k, "shaft.sections.*", "shaft");
  k.add("shaft.bearings", named_tables, "What holds it, the same in all directions across z.").required();
  k.add("shaft.bearings.*", table, "A bearing.");
  k.add("shaft.bearings.*.at", quantity, "").unit(d::length).required().example("\"150 mm\"");
  k.add("shaft.bearings.*.kind", choice,
        "`spring`: by its stiffness; `pinned`: its place; `clamped`: its slope too.")
      .one_of({"spring", "pinned", "clamped"})
      .fallback("\"spring\"");
  const auto add = [&](const char* name, const Dimension& dimension, const char* doc) -> KeyDraft {
    KeyDraft draft = k.add(std::string("shaft.bearings.*.") + name, quantity, doc);
    draft.unit(dimension).in(not_negative).when("kind", {"spring"});
    return draft;
  };
  add("stiffness", d::force_per_length, "").required().example("\"200 N/um\"");
  add("damping", force_rate, "").fallback("\"0 N s/m\"");
  add("tilt_stiffness", moment, "Moment per angle.").fallback("\"0 N m\"");
  add("tilt_damping", moment_rate, "Moment per rate of angle.").fallback("\"0 N m s\"");
  k.add("shaft.points", named_tables, "Places that are looked at, and loaded.");
  k.add("shaft.points.*", table, "A place.");
  k.add("shaft.points.*.at", quantity, "").unit(d::length).required().example("\"0 mm\"");
  k.add("shaft.points.*.force", quantity,
        "Along x; static displacements are those under all forces together.")
      .unit(d::force)
      .fallback("\"0 N\"");
}

void add_removal(Keys& k) {
  k.add("removal", table,
        "What a tool takes of `part` with `analysis.type = \"removal\"`: the box that it has gone through. "
        "Cells "
        "keep E (1 − D) and ρ (1 − D), D = `most` times the share of them that is taken.");
  for (const auto& [corner, meaning] :
       {std::pair{"from", "Corner of all that is taken."}, {"to", "The opposite corner."}})
    k.add(std::string("removal.") + corner, vector, meaning)
        .of_space()
        .unit(d::length)
        .required()
        .example("\"0 16 2 mm\"");
  k.add("removal.along", choice, "Along which axis of the part the tool goes, through the box.")
      .one_of({"x", "-x", "y", "-y", "z", "-z"})
      .fallback("\"x\"");
  k.add("removal.speed", quantity, "Of the tool, which is at the begin of the box at first.")
      .unit(d::velocity)
      .in(positive)
      .required()
      .example("\"1 m/s\"");
  k.add("removal.most", quantity,
        "D of what is gone: 0.95, the paper's, leaves frequencies 10% too high, 0.999 half of a per cent.")
      .in({.low = 0.0, .high = 1.0, .low_open = true, .high_open = true})
      .fallback("0.999");
  k.add("removal.step", quantity, "Of Newmark's scheme.")
      .unit(d::time)
      .in(positive)
      .required()
      .example("\"10 us\"");
  k.add("removal.duration", quantity, "")
      .unit(d::time)
      .in(positive)
      .example("\"0.1 s\"")
      .computed("until the tool is at the end of the box");
  k.add("removal.inverse", choice,
        "How K̂(t) is inverted between its factors: `conjugate-gradients` to 10⁻¹⁰ with the factor at hand; "
        "`interpolated` between the factors of both ends of an interval, each with its own M and C in Q̄; "
        "`interpolated-common` as paper 004 prints it, with the present M and C for both: it diverges where "
        "intervals are long; `factored` in each step.")
      .one_of({"conjugate-gradients", "interpolated", "interpolated-common", "factored"})
      .fallback("\"conjugate-gradients\"");
  k.add("removal.interval", integer, "Steps from one factor to the next.")
      .in({.low = 1, .high = 1e9})
      .fallback("100");
  k.add("removal.reference", boolean,
        "Go beside it with K̂(t) itself, to 10⁻¹⁰, and tell how far the points of the part are from there.")
      .fallback("false");
  k.add("removal.force", table, "A force on the part, beside those on `part.points`, which stay.");
  k.add("removal.force.at", vector, "Where it acts at first.")
      .of_space()
      .unit(d::length)
      .required()
      .example("\"0 40 0 mm\"");
  k.add("removal.force.follows", boolean, "It goes with the tool.").fallback("true");
  k.add("removal.force.amplitude", vector, "").of_space().unit(d::force).required().example("\"0 0 1 N\"");
  k.add("removal.force.frequency", quantity, "f of amplitude · cos(2π f t).")
      .unit(d::rate)
      .in(not_negative)
      .fallback("\"0 Hz\"")
      .example("\"3343 Hz\"");
}

} // namespace

void add_structure(Keys& k) {
  add_part(k);
  add_shaft(k);
  add_removal(k);
}

} // namespace cnem::input
