// Every key of a case file, in the order of the case reference; those of larger tables are in files of their
// own.
#include "input/keys/keys.hpp"
#include "input/case.hpp"
#include "input/constants.hpp"

#include <fmt/format.h>

namespace cnem::input {
namespace {

namespace d = dimension;
using enum Type;

void add_general(Keys& k) {
  k.add("title", text, "One line for the report.").fallback("\"\"");
  k.add("include", texts,
        "Files whose tables are part of the case ([more](user_guide.md#files-that-cases-share)).")
      .example("[\"materials.toml\"]");
  k.add("let", variables,
        "Names of quantities that others are calculated from ([more](user_guide.md#variables)).");
  k.add("analysis", table, "What is computed.").always();
  k.add("analysis.type", choice,
        "`explicit`: explicit dynamics; `static`: linear elasticity at small strain, one solution; "
        "`stability`: "
        "which depths a milling cut bears without chatter; `milling`: the cut in the time domain "
        "(docs/milling.md); `modes`: how a part or a shaft vibrates and bends; `removal`: the "
        "motion of a part while a tool takes matter from it (docs/structures.md).")
      .one_of({"explicit", "static", "stability", "milling", "modes", "removal"})
      .fallback("\"explicit\"");
  k.add("analysis.kinematics", choice,
        "Per unit thickness: no strain out of the plane, or no stress. `axisymmetric`: "
        "a body of revolution about x = 0, x the radius and y the axial coordinate; nodes on the axis stay "
        "on it, "
        "and masses, forces and energies are those of the whole body. `three-dimensional`: whole bodies as "
        "well, vectors have three components (docs/user_guide.md).")
      .one_of({"plane strain", "plane stress", "axisymmetric", "three-dimensional"})
      .fallback("\"plane strain\"");
  k.add(
       "analysis.mechanical", boolean,
       "Solve for motion. Without, nothing moves and heat alone is conducted, in steps as long as it allows.")
      .fallback("true");
  k.add("analysis.thermal", boolean,
        "Solve for temperatures: heat of plastic work and friction, conduction. Without, the temperature "
        "stays at `initial.temperature`.")
      .example("true")
      .computed("true when the domain's material has a `heat` table and the analysis is explicit");
  k.add("time", table, "Duration and step.").always();
  k.add("time.end", quantity,
        "End of the run, which starts at 0; required in explicit analyses. In static ones the time at which "
        "loads and displacements are taken.")
      .unit(d::time)
      .in(positive)
      .or_from_cutting()
      .computed("1 s in static analyses");
  k.add("time.step", table, "Size of the explicit step.").always();
  k.add("time.step.safety", quantity, "Factor on the stable step.")
      .in({.low = 0.0, .high = 1.0, .low_open = true})
      .fallback("0.9");
  k.add("time.step.max", quantity, "Largest step allowed; with local steps of the coarsest nodes.")
      .unit(d::time)
      .in(positive);
  k.add("time.step.min", quantity,
        "The run has diverged when the stable step (with local steps the finest one) falls below this.")
      .unit(d::time)
      .in(positive)
      .example("\"0.01 ns\"")
      .computed("a thousandth of the first stable step");
  k.add("time.step.fixed", quantity, "This step, without an estimate of the stable one.")
      .unit(d::time)
      .in(positive);
  k.add("time.step.check_every", integer,
        "Steps (with local steps the finest ones) between estimates of the stable step; one that "
        "viscosity has made too long is estimated at once.")
      .in({.low = 1, .high = 1e6})
      .fallback("10");
  k.add("time.step.local", boolean,
        "Local time steps: nodes step at power-of-two fractions of the largest step that their cells allow, "
        "so "
        "that a refined band does not slow the rest (docs/theory.md). A step of the run is then one of the "
        "coarsest; output, checkpoints and new references come between those.")
      .fallback("false");
  k.add("time.step.levels", integer,
        "With local steps: at most so many different ones, the largest being 2^(levels − 1) times the "
        "smallest.")
      .in({.low = 2, .high = 8})
      .fallback("5");
  k.add("time.max_steps", integer,
        "The run ends after this many steps, when it has not reached `time.end` before.")
      .in({.low = 1, .high = 1e15})
      .example("1000");
  k.add("time.quasi_static", boolean,
        "Whether inertia is not meant to act: then a run whose kinetic energy is more than 5% of that of the "
        "deformation on average warns of it.")
      .example("true")
      .computed("true with `time.mass_scaling` or `report.blanking`");
  add_mass_scaling(k);
}

void add_conditions(Keys& k) {
  const std::string at = "boundary.*.";
  k.add("boundary", named_tables, "Conditions on boundary pieces.");
  k.add("boundary.*", table, "A set of conditions; pieces without any are free and insulated.");
  k.add(at + "pieces", texts, "Names of boundary pieces, or `all`.").example("[\"left\"]");
  k.add(
       at + "points", vectors,
       "Instead of or beside `pieces`: the nodes nearest to these points, for `velocity` and `displacement`.")
      .unit(d::length)
      .example("[\"0 0 mm\"]");
  k.add(at + "symmetry", boolean, "No velocity normal to the piece, which must be straight (in space plane).")
      .fallback("false");
  k.add(at + "velocity", vector_function, "Prescribed velocity; one component alone leaves the other free.")
      .unit(d::velocity)
      .example("{ x = \"0 m/s\" }");
  k.add(at + "displacement", vector_function, "Prescribed displacement from the initial position.")
      .unit(d::length)
      .example("{ y = { value = \"1 mm\", ramp = \"10 us\" } }");
  k.add(at + "traction", vector_function, "Force per initial area.")
      .unit(d::pressure)
      .example("\"0 10 MPa\"");
  k.add(at + "pressure", function, "Pushes against the body, on the present area and normal.")
      .unit(d::pressure);
  k.add(at + "temperature", function,
        "Fixed temperature; a `ramp` starts from `initial.temperature`, or from `from`.")
      .unit(d::temperature)
      .in(temperature_range);
  k.add(at + "heat_flux", function, "Heat flux into the body.").unit(d::heat_flux);
  k.add(at + "convection", table, "Heat flux coefficient (ambient − T).");
  k.add(at + "convection.coefficient", quantity, "").unit(d::heat_transfer).in(not_negative).required();
  k.add(at + "convection.ambient", function, "A `ramp` starts from `initial.temperature`.")
      .unit(d::temperature)
      .in(temperature_range)
      .required();
  k.add("coolants", named_tables,
        "Coolants: heat flux `coefficient` (`temperature` − T) wherever the boundary touches neither a tool "
        "nor "
        "itself, on faces that a cut makes, too.");
  k.add("coolants.*", table, "A coolant.");
  k.add("coolants.*.coefficient", quantity, "").unit(d::heat_transfer).in(not_negative).required();
  k.add("coolants.*.temperature", function, "A `ramp` starts from `initial.temperature`.")
      .unit(d::temperature)
      .in(temperature_range)
      .required();
  k.add("coolants.*.box", vectors, "Two opposite corners of what it reaches.")
      .unit(d::length)
      .example("[\"-2 -0.1 mm\", \"0 0.1 mm\"]")
      .computed("everywhere");
  k.add("coolants.*.follow", text, "A tool that `box` moves with; `box` is where it begins.")
      .example("\"cutter\"");
  k.add("initial", table, "The state at time 0, without stress and plastic strain.").always();
  k.add("initial.temperature", quantity, "")
      .unit(d::temperature)
      .in(temperature_range)
      .fallback("\"293.15 K\"");
  k.add("initial.velocity", vector, "").unit(d::velocity).computed("0");
  k.add("initial.spin", table, "Adds a rotation to the velocity.");
  k.add("initial.spin.rate", quantity, "Counter-clockwise.").unit(d::angular_velocity).required();
  k.add("initial.spin.centre", vector, "").unit(d::length).fallback("\"0 0 m\"");
  k.add("initial.velocity_gradient", table, "Adds ∂v/∂X (X − centre) to the velocity.");
  for (const char* component : {"xx", "xy", "yx", "yy"})
    k.add(fmt::format("initial.velocity_gradient.{}", component), quantity,
          fmt::format("∂v_{}/∂{}.", component[0], component[1]))
        .unit(d::rate)
        .fallback("\"0 1/s\"");
  k.add("initial.velocity_gradient.centre", vector, "").unit(d::length).fallback("\"0 0 m\"");
  k.add("initial.imperfections", named_tables, "Places with a lower yield stress, to start bands and necks.");
  k.add("initial.imperfections.*", table,
        "Lowers the yield stress by `reduction` exp(−(d/width)²) of itself, d the distance to `points`.");
  k.add("initial.imperfections.*.points", vectors, "A point, or the corners of a polyline.")
      .unit(d::length)
      .required()
      .example("[\"0 5 mm\", \"10 5 mm\"]");
  k.add("initial.imperfections.*.width", quantity, "")
      .unit(d::length)
      .in(positive)
      .required()
      .example("\"20 um\"");
  k.add("initial.imperfections.*.reduction", quantity, "")
      .in({.low = 0.0, .high = 1.0, .high_open = true})
      .required()
      .example("0.02");
  k.add("periodic", named_tables, "Pairs of boundary pieces of which one continues at the other.");
  k.add("periodic.*", table, "Nodes of both pieces move alike and have the same temperature.");
  k.add("periodic.*.pieces", texts,
        "Two boundary pieces, one a shifted copy of the other; in space two parallel planes. Each piece "
        "continues at one other.")
      .required()
      .example("[\"left\", \"right\"]");
  k.add("loads", table, "Loads on the whole body.").always();
  k.add("loads.body_force", vector_function, "Force per unit mass.")
      .unit(d::acceleration)
      .example("\"0 -9.81 m/s2\"");
}

void add_fracture(Keys& k) {
  k.add("fracture", table, "Crack tips (static analyses).").always();
  k.add("fracture.enrichment", boolean,
        "Functions that carry the √r field near tips, for `method.name = \"cnem\"`.")
      .fallback("true");
  k.add("fracture.enrichment_radius", quantity, "Nodes within this distance of a tip are enriched.")
      .unit(d::length)
      .in(positive)
      .computed("0.3 of the half-length of the crack, at least 2.5 spacings there");
  k.add("fracture.integral", table, "Domain of the interaction integral.").always();
  k.add("fracture.integral.inner", quantity, "Its weight is 1 within this distance of the tip.")
      .unit(d::length)
      .in(positive)
      .computed("half of `outer`");
  k.add("fracture.integral.outer", quantity, "Its weight is 0 beyond this distance.")
      .unit(d::length)
      .in(positive)
      .computed(
          "0.7 of the smallest of half-length, straight piece at the tip, and distance to other boundaries");
}

void add_output(Keys& k) {
  const std::vector<std::string> fields = field_names(2, false), fields_in_space = field_names(3, false);
  k.add("output", table, "What is written.").always();
  k.add("output.history_every", quantity, "Time between rows of `history.csv`; 0: every step.")
      .unit(d::time)
      .in(not_negative)
      .example("\"0.1 us\"")
      .computed("`time.end`/400");
  k.add("output.surface", boolean,
        "Each frame of `fields.pvd` has the surface of the body as triangles, too.")
      .fallback("false");
  k.add("output.polyhedra", boolean,
        "Each frame of `fields.pvd` has the cells of the nodes as polyhedra, too, beside the tetrahedra "
        "between "
        "nodes.")
      .fallback("false");
  k.add("output.fields_every", quantity, "Time between `.vtu` files; 0: none but first and last.")
      .unit(d::time)
      .in(not_negative)
      .example("\"1 us\"")
      .computed("`time.end`/24");
  k.add("output.checkpoint", table,
        "When `checkpoint.h5` is written, from which `cnem restart` goes on: at step 0 and whenever one of "
        "these is "
        "due.")
      .always();
  k.add("output.checkpoint.every_steps", integer, "Steps from one to the next; 0: not by steps.")
      .in({.low = 0, .high = 1e15})
      .fallback("0");
  k.add("output.checkpoint.every_time", quantity, "Simulated time from one to the next; 0: not by it.")
      .unit(d::time)
      .in(not_negative)
      .fallback("\"0 s\"");
  k.add("output.checkpoint.every_wall", quantity, "Wall-clock time from one to the next; 0: not by it.")
      .unit(d::time)
      .in(not_negative)
      .fallback("\"10 min\"");
  k.add("output.checkpoint.keep", integer,
        "Checkpoints kept: `checkpoint.h5`, then `checkpoint.1.h5` and so on.")
      .in({.low = 1, .high = 1000})
      .fallback("2");
  add_pictures(k);
  k.add(
      "output.lines", named_tables,
      "Fields along straight lines at the end of the run, in `lines/NAME.csv`: distance and position first.");
  k.add("output.lines.*", table, "A line.");
  k.add("output.lines.*.from", vector, "Its start.").unit(d::length).required().example("\"1.1 1 mm\"");
  k.add("output.lines.*.to", vector, "Its end.").unit(d::length).required().example("\"2 1 mm\"");
  k.add("output.lines.*.samples", integer, "Number of points, ends included.")
      .in({.low = 2, .high = 1e6})
      .fallback("101");
  k.add("output.lines.*.fields", choices, "Fields sampled.")
      .one_of(fields)
      .in_space_one_of(fields_in_space)
      .required()
      .example("[\"stress_yy\"]");
  k.add("output.notes", named_tables,
        "Words beside pictures in the report, as on what a paper shows there. Notes on what is not drawn are "
        "left out.");
  k.add("output.notes.*", table, "A note.");
  k.add("output.notes.*.at", quantity, "A time of `output.pictures`.")
      .unit(d::time)
      .in(not_negative)
      .required()
      .example("\"12 us\"");
  k.add("output.notes.*.field", choice, "A field of `output.picture_fields`.")
      .one_of(field_names(2))
      .computed("the first of `output.picture_fields`")
      .example("\"plastic_strain\"");
  k.add("output.notes.*.text", text, "What to say.").required().example("\"Figure 22: a band.\"");
  k.add("output.windows", named_tables, "Parts drawn enlarged, beside the whole.");
  k.add("output.windows.*", table, "A window.");
  k.add("output.windows.*.box", vectors, "Two opposite corners.")
      .unit(d::length)
      .required()
      .example("[\"4 0 mm\", \"6 10 mm\"]");
  k.add("output.windows.*.follow", text, "A tool that the window moves with; `box` is where it begins.")
      .example("\"cutter\"");
  k.add("output.probes", named_tables, "Histories at material points.");
  k.add("output.probes.*", table, "A probe: columns `probe.NAME.field` of `history.csv`.");
  k.add("output.probes.*.at", vector, "Initial position.").unit(d::length).required().example("\"5.1 5 mm\"");
  k.add("output.probes.*.fields", choices, "Fields recorded.")
      .one_of(fields)
      .in_space_one_of(fields_in_space)
      .required()
      .example("[\"temperature\", \"plastic_strain\"]");
}

} // namespace

const std::vector<Key>& schema() {
  static const std::vector<Key> keys = [] {
    Keys k;
    add_general(k);
    add_cutting(k);
    add_domain(k);
    add_block(k);
    add_parts(k);
    add_cloud(k);
    add_materials(k);
    add_conditions(k);
    add_tools(k);
    add_contact(k);
    add_method(k);
    add_adaptation(k);
    add_fracture(k);
    add_output(k);
    add_report(k);
    add_machining(k);
    add_structure(k);
    mark_scopes(k);
    mark_families(k);
    return std::move(k.all);
  }();
  return keys;
}

} // namespace cnem::input
