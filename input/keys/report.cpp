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
        "punch against the die. In space sections round the punch are evaluated, with mean and spread.");
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
  k.add("report.blanking.sections", integer,
        "How many radial sections are evaluated round the punch, in the middle of equal angles of where it "
        "cuts.")
      .in({.low = 1.0, .high = 360.0})
      .fallback("8");
  k.add("report.blanking.centre", vector,
        "A place on the axis along the cutting direction that sections go through.")
      .unit(d::length)
      .example("\"0 0 0 mm\"")
      .computed("the middle of the punch");
  k.add("report.blanking.measured", named_tables,
        "Heights of the faces of `slug` and `skeleton` of an experiment, beside which the computed ones "
        "stand.");
  k.add("report.blanking.measured.*", table,
        "What was measured of one body: lengths, or shares of the thickness.");
  for (const char* zone : {"rollover", "burnish", "fracture", "burr"}) {
    const std::string at = std::string("report.blanking.measured.*.") + zone;
    k.add(at, quantity, "Height.").unit(d::length).in(not_negative).example("\"0.3 mm\"");
    k.add(at + "_share", quantity, "The same as a share of the thickness.")
        .in({.low = 0.0, .high = 2.0})
        .example("\"15 %\"");
  }
  k.add("report.blanking.measured.*.fracture_angle", quantity,
        "Angle of the fracture zone to the cutting direction.")
      .unit(d::angle)
      .in({.low = -1.5707963267948966, .high = 1.5707963267948966})
      .example("\"8 deg\"");
}

void add_experiments(Keys& k) {
  k.add("report.experiment", named_tables,
        "Measured curves. Keys of a single one may stand in [report.experiment] itself.")
      .or_alone();
  const std::string at = "report.experiment.*";
  k.add(at, table,
        "A measured curve that the force of a tool is compared with (docs/experiments.md): drawn over the "
        "computed one, differences of peak, work and root mean square in `status.json`. Keys of a single "
        "curve may stand in [report.experiment] itself; it is named `measured` then.");
  k.add(at + ".file", text,
        "CSV file with a column for the stroke, or the time, and one for the force, seen from the folder of "
        "the case. Columns stand between `;`, tabs or commas; lines that begin with # are comments; beside "
        "`;` and tabs numbers may have decimal commas. Its numbers are put into the resolved case.")
      .example("\"press.csv\"");
  k.add(at + ".columns", texts,
        "Names of the two columns in the header, or their numbers: first that of stroke or time, then that "
        "of the force.")
      .example("[\"stroke\", \"force\"]")
      .computed("the only two");
  k.add(at + ".units", texts, "Units of the two columns.")
      .example("[\"mm\", \"kN\"]")
      .computed("those of the header, `force[kN]` say");
  k.add(at + ".stroke", quantities, "Instead of a file: strokes, increasing.")
      .unit(d::length)
      .example("[\"0 mm\", \"0.5 mm\", \"1 mm\"]");
  k.add(at + ".time", quantities, "Instead of strokes: times, increasing.")
      .unit(d::time)
      .example("[\"0 us\", \"50 us\"]");
  k.add(at + ".force", quantities, "Instead of a file: forces, one for each stroke or time.")
      .unit(d::force)
      .example("[\"0 kN\", \"12 kN\", \"4 kN\"]");
  k.add(at + ".force_per_length", quantities, "The same per length of the cut.")
      .unit(d::force_per_length)
      .example("[\"0 N/mm\", \"700 N/mm\", \"200 N/mm\"]");
  k.add(at + ".tool", text, "Tool whose force it is.")
      .example("\"punch\"")
      .computed("the punch of `report.blanking`, the tool of `report.cutting`, the tool named `punch`, else "
                "the only one that moves");
  k.add(at + ".component", choice,
        "`along`: in the direction of the cut, or of the motion of the tool (F_c of a cut); `across`: at "
        "right angles to it (F_t); `x`, `y`. Forces count positive in the sense in which they are largest.")
      .one_of({"along", "across", "x", "y"})
      .fallback("\"along\"");
  k.add(at + ".cut_length", quantity,
        "Length of the cut in the experiment, perimeter of the blank say. In plane strain forces are per "
        "thickness: those in N are compared with the computed one times this length over `cuts`.")
      .unit(d::length)
      .in(positive)
      .example("\"80 mm\"")
      .computed("the width of `report.cutting` of a cut");
  k.add(at + ".cuts", quantity,
        "Of how many cuts the model carries the force: 1 of a half model, 2 where the punch cuts on both "
        "sides.")
      .in(positive)
      .example("2")
      .computed("those that `report.blanking` finds, else 1");
  k.add(at + ".scale", quantity, "Measured forces are multiplied by it; -1 turns a force that pushes.")
      .fallback("1");
  k.add(at + ".shift", quantity, "Is added to measured strokes: contact begins at the same stroke then.")
      .unit(d::length)
      .fallback("\"0 mm\"");
  k.add(at + ".delay", quantity, "Is added to measured times.").unit(d::time).fallback("\"0 s\"");
  k.add(at + ".compliance", quantity,
        "Of machine and tools that the measured stroke runs through: it times the measured force is taken "
        "off the stroke.")
      .unit(d::compliance)
      .in(not_negative)
      .fallback("\"0 mm/kN\"");
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
  k.add("report.cutting.clear", quantity,
        "So near to the tool, and to where the cut began, nothing of the machined surface is measured.")
      .unit(d::length)
      .in(positive)
      .example("\"20 um\"")
      .computed("the feed");
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
  add_experiments(k);
}

} // namespace cnem::input
