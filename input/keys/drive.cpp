// Keys of tools with a mass of their own, and of mass scaling.
#include "contact/springs/list.hpp"
#include "input/constants.hpp"

namespace cnem::input {

namespace d = dimension;
using enum Type;

void add_drive(Keys& k, const std::string& tool) {
  k.add(
       tool + "mass", quantity,
       "Instead of `velocity`: the tool is a rigid body of this mass that does not turn, moved by `force`, "
       "`spring`, `initial_velocity` and the workpiece. Of what is modelled: half of it in a symmetric half.")
      .unit(d::mass_per_length)
      .of_revolution(d::mass)
      .in(positive)
      .example("\"50 kg/m\"");
  k.add(tool + "force", vector_function,
        "On a tool with a mass, its weight included; per unit thickness, or of the whole body (of "
        "revolution, in space).")
      .unit(d::force_per_length)
      .of_revolution(d::force)
      .example("{ value = \"0 -2 MN/m\", ramp = \"1 ms\", smooth = true }");
  k.add(tool + "initial_velocity", vector, "Of a tool with a mass, at time 0.")
      .unit(d::velocity)
      .example("\"0 -5 m/s\"");
  k.add(tool + "direction", vector,
        "A tool with a mass moves along this line alone, of any length and either sense; guides take what "
        "pushes "
        "it aside. Without, it moves freely; in axisymmetric analyses it can only be \"0 1\".")
      .example("\"0 1\"")
      .computed("none; \"0 1\" in axisymmetric analyses");
  const std::vector<LawText> springs = law_texts(contact::Springs{});
  k.add(
      tool + "spring", table,
      "Between a tool with a mass and its mount: it pushes the tool along `direction`, in the sense of that. "
      "The travel s is how far the two have come closer since the start. The mount stands still (the spring "
      "of a blank holder), or moves with `velocity` (the slide of a press, whose frame is the spring): then "
      "`slide_stroke` stands in `history.csv` beside the `stroke` of the tool.");
  add_law_choice(k, tool + "spring", springs).fallback("\"linear\"");
  const std::size_t first = k.all.size();
  add_law_constants(k, tool + "spring", springs);
  for (std::size_t key = first; key < k.all.size(); ++key) // constants are declared per unit thickness
    if (const Dimension& plane = k.all[key].dimension; plane == d::force_per_length)
      KeyDraft(k.all[key]).of_revolution(d::force);
    else if (plane == parse_unit("N/m2").dimension)
      KeyDraft(k.all[key]).of_revolution(d::force_per_length);
  k.add(tool + "spring.ramp", quantity,
        "Time over which the spring is charged, smoothly, to its force: one that is there at once sets what "
        "it "
        "presses on swinging.")
      .unit(d::time)
      .in(positive)
      .example("\"20 us\"")
      .computed("0: it is charged");
  k.add(tool + "damping", quantity,
        "Of a tool with a mass: force over its speed relative to the mount, per unit thickness or of the "
        "whole "
        "body of revolution.")
      .unit(parse_unit("N s/m2").dimension)
      .of_revolution(parse_unit("N s/m").dimension)
      .in(not_negative)
      .example("\"100 kN s/m2\"")
      .computed("0");
}

void add_mass_scaling(Keys& k) {
  k.add(
      "time.mass_scaling", table,
      "More inertia, for longer steps in processes that are slow enough: `energy.kinetic` must stay a small "
      "part "
      "of the deformation energy (`kinetic_share` in `history.csv`). Heat capacity, body forces and reported "
      "masses stay as they are. One of `factor`, `step` and `cell`.");
  k.add("time.mass_scaling.factor", quantity, "On the inertia of all nodes; the step grows by its root.")
      .in({.low = 1.0})
      .example("100");
  k.add("time.mass_scaling.step", quantity,
        "Nodes with a shorter stable step get as much inertia as this step asks for, the others keep theirs; "
        "where adaptation changes the cloud, factors are chosen anew.")
      .unit(d::time)
      .in(positive)
      .example("\"20 ns\"");
  k.add("time.mass_scaling.cell", quantity,
        "Instead of `step`: that of square cells so wide, in the material with the fastest waves.")
      .unit(d::length)
      .in(positive)
      .example("\"10 um\"");
}

} // namespace cnem::input
