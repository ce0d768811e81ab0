// Keys of what a run is evaluated for.
#include "input/keys.hpp"

namespace cnem::input {

void add_report(Keys& k) {
  using enum Type;
  namespace d = dimension;
  k.add("report", table, "What is evaluated at the end of an explicit run (docs/blanking.md).").always();
  k.add("report.springback", boolean,
        "The bodies are let go: field `springback` in the last frame of `fields.pvd`, largest displacement "
        "and "
        "change of shape of each body in `status.json`. Planes of symmetry stay, tools, loads and other "
        "supports are taken away.")
      .computed("true where `report.blanking` is given and no nodes are tied");
  k.add("report.blanking", table,
        "Sheared faces of slug and skeleton (rollover, burnish, fracture, burr), largest forces, work. The "
        "cuts "
        "are where a side of the punch passes an edge of the die; the cutting direction is that of the punch "
        "against the die.");
  k.add("report.blanking.punch", text, "A tool.")
      .example("\"punch\"")
      .computed("the tool named `punch`, else the only one that moves");
  k.add("report.blanking.die", texts, "One or several tools.")
      .example("\"die\"")
      .computed("the tools whose names begin with `die`, else those at rest");
  k.add("report.blanking.parallel", quantity,
        "The drawn-in edge ends where the face is parallel to the cutting direction within this angle.")
      .unit(d::angle)
      .in({.low = 0.0, .high = 0.7853981633974483, .low_open = true})
      .fallback("\"10 deg\"");
  k.add("report.blanking.smoothing", quantity,
        "Length of the chords that directions of the face are taken from; what is smaller is roughness.")
      .unit(d::length)
      .in(positive)
      .example("\"0.05 mm\"")
      .computed("a fiftieth of the thickness");
}

} // namespace cnem::input
