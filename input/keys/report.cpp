// Keys of [report]: what runs are evaluated for.
#include "input/case_output.hpp"
#include "input/constants.hpp"

namespace cnem::input {
namespace {

namespace d = dimension;
using enum Type;

/// The tool that does what a report is about.
void add_leading_tool(Keys& k, const std::string& path, const std::string& usual) {
  k.add(path, text, "A tool.")
      .example("\"" + usual + "\"")
      .computed("the tool named `" + usual + "`, else the only one that moves");
}

void add_blanking(Keys& k) {
  k.add("report.blanking", table,
        "Sheared faces of slug and skeleton (rollover, burnish, fracture, burr), largest forces, work. The "
        "cuts are where a side of the punch passes an edge of the die; the cutting direction is that of the "
        "punch "
        "against the die.");
  add_leading_tool(k, "report.blanking.punch", "punch");
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

void add_cutting_report(Keys& k) {
  k.add(
      "report.cutting", table,
      "What machinists read of an orthogonal cut: forces and their steady part, chip, shear angle, stresses "
      "along the rake face, the surface left behind (docs/cutting.md). The tool moves through the "
      "workpiece; its rake face is the longest straight side that faces the cut.");
  add_leading_tool(k, "report.cutting.tool", "cutter");
  k.add("report.cutting.feed", quantity, "Uncut chip thickness.")
      .unit(d::length)
      .in(positive)
      .example("\"0.3 mm\"")
      .computed("how far the tool reaches below the highest point of the workpiece");
  k.add("report.cutting.width", quantity,
        "Width of cut, out of the plane: forces in N are those per width times it.")
      .unit(d::length)
      .in(positive)
      .fallback("\"1 mm\"");
  k.add("report.cutting.filter", quantity, "Length of cut that filtered forces are the centred mean over.")
      .unit(d::length)
      .in(positive)
      .example("\"0.06 mm\"")
      .computed("a fifth of the feed");
  k.add("report.cutting.steady", table, "When a part of the cut is steady.").always();
  k.add("report.cutting.steady.feeds", quantity, "It is at least so many feeds long.")
      .in({.low = 1.0, .high = 1e6})
      .fallback("3");
  k.add("report.cutting.steady.tolerance", quantity,
        "The means of its thirds differ from its mean by at most this share of the mean cutting force.")
      .in({.low = 0.0, .high = 1.0, .low_open = true})
      .fallback("0.05");
  k.add("report.cutting.isotherms", quantities,
        "Temperatures of the tool: how deep and how far along the rake face what is as warm reaches, at the "
        "end "
        "of the run.")
      .unit(d::temperature)
      .in(temperature_range)
      .example("\"500 700 900 K\"")
      .computed("whole hundreds, with `heat.section` of the tool");
  k.add("report.cutting.wear", table,
        "Usui's law of wear, to be told the rate at which the rake face wears.");
  add_constants(k, "report.cutting.wear", constant_texts<UsuiWear>(UsuiWear::parameters));
}

} // namespace

void add_report(Keys& k) {
  k.add("report", table,
        "What is evaluated at the end of an explicit run (docs/blanking.md, docs/cutting.md), and the units "
        "of pages.")
      .always();
  k.add("report.units", texts,
        "Units that pages and pictures show numbers in, one for each dimension: `degC`, `kN`, `N/mm`, `um`, "
        "`GPa`, `J/mm` (those of energies contain J). Others follow the size of the number: mm, N/mm, MPa, "
        "J/mm, "
        "K. Files stay in SI.")
      .example("[\"degC\", \"kN/mm\"]");
  k.add("report.springback", boolean,
        "The bodies are let go: field `springback` in the last frame of `fields.pvd`, largest displacement "
        "and change of shape of each body in `status.json`. Planes of symmetry stay, tools, loads and other "
        "supports are taken away.")
      .computed("true where `report.blanking` is given and no nodes are tied");
  add_blanking(k);
  add_cutting_report(k);
}

} // namespace cnem::input
