// Keys of orthogonal cutting.
#include "input/keys/keys.hpp"

namespace cnem::input {

namespace d = dimension;
using enum Type;

namespace {

constexpr double degree = 0.017453292519943295;

} // namespace

void add_cutting(Keys& k) {
  const std::string at = "cutting.";
  k.add(
      "cutting", table,
      "Orthogonal cutting: makes workpiece, tool, supports, nodes, adaptation, times and pictures of what a "
      "machinist says of a cut, for all of these keys that the case does not give itself (docs/cutting.md). "
      "The tool moves along +x; y = 0 is the surface that it leaves behind, x = 0 where it begins.");
  k.add(at + "feed", quantity, "Uncut chip thickness.")
      .unit(d::length)
      .in(positive)
      .required()
      .example("\"0.4 mm\"");
  k.add(at + "width", quantity, "Of cut, out of the plane.")
      .unit(d::length)
      .in(positive)
      .required()
      .example("\"4 mm\"");
  k.add(at + "rake", quantity, "Of the face that the chip slides on; negative where it leans forward.")
      .unit(d::angle)
      .in({.low = -60.0 * degree, .high = 60.0 * degree})
      .required()
      .example("\"17.5 deg\"");
  k.add(at + "clearance", quantity, "Between flank and machined surface.")
      .unit(d::angle)
      .in({.low = 0.0, .high = 45.0 * degree})
      .required()
      .example("\"7 deg\"");
  k.add(at + "edge_radius", quantity,
        "Of the cutting edge; with a chamfer of both ends of its land. Required without one.")
      .unit(d::length)
      .in(positive)
      .example("\"20 um\"")
      .computed("a fifth of `chamfer.width`");
  k.add(at + "chamfer", table, "A land between flank and rake face.");
  k.add(at + "chamfer.width", quantity, "Of the land itself.")
      .unit(d::length)
      .in(positive)
      .required()
      .example("\"0.1 mm\"");
  k.add(at + "chamfer.angle", quantity, "From rake face to land, whose rake is that much less.")
      .unit(d::angle)
      .in({.low = 0.0, .high = 80.0 * degree, .low_open = true})
      .required()
      .example("\"20 deg\"");
  k.add(at + "speed", quantity, "Of the tool.")
      .unit(d::velocity)
      .in(positive)
      .required()
      .example("\"800 m/min\"");
  k.add(at + "length", quantity, "Of cut.").unit(d::length).in(positive).required().example("\"10 mm\"");
  k.add(at + "exit", boolean, "The far end is free and lies at `length`: the tool leaves through it.")
      .fallback("false");
  k.add(at + "window", boolean,
        "The workpiece is a window that goes with the tool (`adapt.window`): 12 feeds ahead of it, 8 behind, "
        "15 "
        "of chip, whatever `length` is.")
      .fallback("false");
  k.add(at + "tool", text, "What the tool is called.").fallback("\"cutter\"");
  add_friction(k, at + "friction", "Friction of the tool on the workpiece.");
  add_friction_by_material(k, at + "friction");
}

} // namespace cnem::input
