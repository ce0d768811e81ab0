// Keys that describe geometry and nodes: outlines, domain, cloud.
#include "input/constants.hpp"
#include "input/keys/keys.hpp"
#include "plasticity/cohesive.hpp"

namespace cnem::input {

namespace d = dimension;
using enum Type;

namespace {

/// The table that takes an outline from a file, or those of the domain.
void add_drawing(Keys& k, const std::string& at, const std::string& doc, const std::string& layers) {
  k.add(at, table, doc);
  k.add(at + ".file", text,
        "DXF (in text), gmsh's `.geo` or `.msh`, relative to the file that names it ([what is "
        "read](drawings.md)).")
      .required()
      .example("\"press.dxf\"");
  k.add(at + ".layers", texts,
        "Layers, or physical names of gmsh, whose curves make it; pieces are named after them.")
      .example("[\"punch\"]")
      .computed(layers);
  k.add(at + ".unit", text,
        "Of the drawing's lengths, in place of its own: a unit of length, `in`, `ft` or `mil`.")
      .example("\"mm\"")
      .computed("that of the file (`$INSUNITS`); files of gmsh have none");
  k.add(at + ".scale", quantity, "Factor on all lengths.").in(positive).fallback("1");
  k.add(at + ".mirror", choice, "Changes the sign of `x` or of `y`, before it is turned.").one_of({"x", "y"});
  k.add(at + ".rotate", quantity, "Turn about the drawing's (0, 0), counter-clockwise, before it is shifted.")
      .unit(d::angle)
      .fallback("\"0 deg\"");
  k.add(at + ".shift", vector, "Where the drawing's (0, 0) comes to lie.")
      .unit(d::length)
      .fallback("\"0 0 m\"")
      .example("\"0.1 0 mm\"");
  k.add(at + ".tolerance", quantity, "Distance at which ends of curves meet.")
      .unit(d::length)
      .in(positive)
      .computed("a hundred-thousandth of the drawing's diagonal");
  k.add(at + ".names", table_list, "Names of single pieces, where a layer has several.");
  k.add(at + ".names[].at", vector, "A place near the middle of the piece, as it reads in the drawing.")
      .unit(d::length)
      .required()
      .example("\"0 5 mm\"");
  k.add(at + ".names[].name", text, "").required().example("\"left\"");
  k.add(at + ".fillets", table_list, "Corners that are drawn sharp and shall be round.");
  k.add(at + ".fillets[].at", vector, "The corner, between two straight pieces, as it reads in the drawing.")
      .unit(d::length)
      .required()
      .example("\"10 5 mm\"");
  k.add(at + ".fillets[].radius", quantity, "").unit(d::length).in(positive).required();
}

} // namespace

void add_arc(Keys& k, const std::string& piece) {
  k.add(piece + ".centre", vector, "Makes the piece an arc about this point.").unit(d::length);
  k.add(piece + ".radius", quantity,
        "Makes the piece an arc of this radius, the shorter of the two; for longer ones give `centre`.")
      .unit(d::length)
      .in(positive);
  k.add(piece + ".clockwise", boolean, "Sense of travel of an arc.").fallback("false");
}

KeyDraft add_stl(Keys& k, const std::string& at, const std::string& example) {
  k.add(at + ".file", text, "In text or binary, relative to the case file.").required().example(example);
  k.add(at + ".content", text, stl_content);
  k.add(at + ".unit", quantity, "Length of the file's unit.")
      .unit(d::length)
      .in(positive)
      .fallback("\"1 mm\"");
  return k.add(at + ".shift", vector, "Where the file's (0, 0, 0) comes to lie.")
      .unit(d::length)
      .fallback("\"0 0 0 m\"")
      .example("\"0 0 1 mm\"");
}

void add_outline(Keys& k, const std::string& at, const std::string& rectangle_names) {
  k.add(at + ".start", vector, "First corner of a `path`.").unit(d::length).example("\"0 0 mm\"");
  k.add(at + ".path", table_list,
        "Straight pieces and arcs from corner to corner, in either sense. Closes by itself with a straight "
        "piece when the last `to` is not `start`.");
  k.add(at + ".path[].to", vector, "End of the piece; it begins where the one before ends.")
      .unit(d::length)
      .required()
      .example("\"20 0 mm\"");
  k.add(at + ".path[].name", text, "Name of the boundary piece; pieces may share one.")
      .example("\"bottom\"")
      .computed("the name of the curve (`outer` for the domain)");
  add_arc(k, at + ".path[]");
  k.add(at + ".path[].fillet", quantity,
        "Rounds the corner at `to`, between two straight pieces, by a tangent arc of this radius; 0 leaves "
        "it sharp.")
      .unit(d::length)
      .in(not_negative)
      .example("\"0.5 mm\"");
  k.add(at + ".path[].fillet_name", text, "Name of the arc made by `fillet`.")
      .computed("the name of the piece before it");
  k.add(at + ".close", text, "Name of the straight piece that closes the `path`.")
      .example("\"left\"")
      .computed("the name of the curve");
  k.add(at + ".rectangle", table, "A rectangle parallel to the axes, instead of `start` and `path`.");
  k.add(at + ".rectangle.from", vector, "A corner.").unit(d::length).required().example("\"0 0 mm\"");
  k.add(at + ".rectangle.to", vector, "The opposite corner.")
      .unit(d::length)
      .required()
      .example("\"20 10 mm\"");
  k.add(at + ".rectangle.fillet", quantity, "Radius of all four corners.").unit(d::length).in(not_negative);
  k.add(at + ".rectangle.names", table, "Names of the sides.");
  for (const char* side : {"bottom", "right", "top", "left"})
    k.add(at + ".rectangle.names." + side, text, std::string("Name of the ") + side + " side.")
        .computed(rectangle_names.empty() ? std::string("`") + side + "`" : rectangle_names);
  k.add(at + ".circle", table, "A circle, instead of `start` and `path`.");
  k.add(at + ".circle.centre", vector, "Its centre.").unit(d::length).required().example("\"10 5 mm\"");
  k.add(at + ".circle.radius", quantity, "Its radius.").unit(d::length).in(positive).required();
  k.add(at + ".circle.name", text, "Name of the boundary piece.").computed("the name of the curve");
  k.add(at + ".rotate", table, "Turns the whole curve.");
  k.add(at + ".rotate.angle", quantity, "Counter-clockwise.").unit(d::angle).required();
  k.add(at + ".rotate.centre", vector, "Centre of the turn.").unit(d::length).fallback("\"0 0 m\"");
  add_drawing(k, at + ".drawing", "The outline from a file, instead of `start` and `path`.",
              "the layer that is called as the curve (`outer`, the hole, the tool), else all that are shown");
}

void add_domain(Keys& k) {
  k.add("domain", table, "The workpiece at the start.").required();
  k.add("domain.material", text, "Name of one of `materials`.").required().example("\"304L\"");
  k.add("domain.outer", table,
        "Outline: either `start` and `path`, or `rectangle`, or `circle`, or `drawing`. Names of its pieces "
        "are for `boundary`.")
      .required()
      .or_from_drawing()
      .in_plane_only_required();
  add_drawing(k, "domain.drawing",
              "Outline and holes from a file, instead of `domain.outer`: the closed curve that holds all "
              "others is the "
              "outline, the others are holes, named after their layers.",
              "all that are shown");
  add_outline(k, "domain.outer", "");
  k.add("domain.holes", named_tables, "Holes.");
  k.add("domain.holes.*", table,
        "A hole: either `start` and `path`, or `rectangle`, or `circle`, or `drawing`.");
  add_outline(k, "domain.holes.*", "the name of the hole");
  k.add("domain.cracks", named_tables, "Cracks.");
  k.add("domain.cracks.*", table,
        "A crack with two faces: the boundary pieces `NAME+` (material on the left of the path) and `NAME-`; "
        "`NAME` stands for both.");
  k.add("domain.cracks.*.points", vectors,
        "Polyline inside the domain; its first or last point may lie on the boundary, then it is open there, "
        "and "
        "leaves the boundary at 5° or more.")
      .unit(d::length)
      .required()
      .example("[\"8 5 mm\", \"12 5 mm\"]");
  k.add("domain.cracks.*.tips", texts, "Names of the first and the last end, for results.")
      .example("[\"left\", \"right\"]")
      .computed("`left` and `right`, or `bottom` and `top`, from their positions; with several cracks "
                "`CRACK_left` and so on");
  k.add("domain.cracks.*.rotate", table, "Turns the crack.");
  k.add("domain.cracks.*.rotate.angle", quantity, "Counter-clockwise.").unit(d::angle).required();
  k.add("domain.cracks.*.rotate.centre", vector, "Centre of the turn.").unit(d::length).fallback("\"0 0 m\"");
}

void add_cohesive(Keys& k, const std::string& cohesive) {
  k.add(cohesive, table,
        "Its faces separate: traction K δ up to onset, (⟨t_n⟩/`strength`)² + (t_s/`shear_strength`)² = 1, "
        "then linear "
        "softening in √(⟨δn⟩² + δs²) until the fracture energy `energy` + (`shear_energy` − `energy`) "
        "β^`eta` is spent, "
        "β the share of δs² (paper 001, (25), (26); Benzeggagh and Kenane 1996). It has no thickness.");
  add_constants(k, cohesive, constant_texts<plasticity::CohesiveLaw>(plasticity::CohesiveLaw::parameters));
}

void add_fibres(Keys& k) {
  const std::string at = "domain.fibres.*";
  k.add("domain.fibres", named_tables, "Bundles of straight fibres in a matrix (explicit only).");
  k.add(
      at, table,
      "Parallel fibres that run from boundary to boundary. Number k is the region `NAMEk`, its faces are the "
      "interfaces `NAMEk_left` and `NAMEk_right`, seen along the fibres; they are counted from left to "
      "right.");
  k.add(at + ".material", text, "Of the fibres: name of one of `materials`. `domain.material` is the matrix.")
      .required()
      .example("\"flax\"");
  k.add(at + ".number", integer, "Of fibres.").required().in({.low = 1, .high = 1000}).example("4");
  k.add(at + ".width", quantity, "Of a fibre.").unit(d::length).required().in(positive).example("\"15 um\"");
  k.add(at + ".pitch", quantity, "From the middle of a fibre to that of the next.")
      .unit(d::length)
      .required()
      .in(positive)
      .example("\"33 um\"");
  k.add(at + ".centre", vector, "Middle of the bundle; between two fibres where their number is even.")
      .unit(d::length)
      .required()
      .example("\"130 16.5 um\"");
  k.add(at + ".angle", quantity, "Of the fibres from +x, counter-clockwise.")
      .unit(d::angle)
      .fallback("\"0 rad\"")
      .example("\"45 deg\"");
  add_cohesive(k, at + ".cohesive");
}

void add_parts(Keys& k) {
  k.add("domain.interfaces", named_tables, "Interfaces between parts of different material (explicit only).");
  k.add("domain.interfaces.*", table,
        "An interface: its two faces move as one, or under the tractions of `cohesive`. It divides the "
        "domain into "
        "parts for `regions`.");
  k.add("domain.interfaces.*.points", vectors, "Polyline whose two ends lie on the boundary.")
      .unit(d::length)
      .required()
      .example("[\"5 0 mm\", \"5 10 mm\"]");
  k.add("domain.interfaces.*.conductance", quantity,
        "Heat crosses in proportion to the jump of temperature; without it both faces have one temperature.")
      .unit(d::heat_transfer)
      .in(not_negative)
      .example("\"1e5 W/(m2 K)\"");
  const std::string cohesive = "domain.interfaces.*.cohesive";
  add_cohesive(k, cohesive);
  k.add(cohesive + ".open", vectors,
        "Two points, between whose nearest places on the interface it is broken at the start.")
      .unit(d::length)
      .example("[\"0 3 mm\", \"40 3 mm\"]");
  add_fibres(k);
  k.add("domain.regions", named_tables, "Parts with a material or an initial state of their own.");
  k.add(
      "domain.regions.*", table,
      "The part of the domain that holds a point; interfaces and cracks from boundary to boundary bound it.");
  k.add("domain.regions.*.at", vector, "A point inside.").unit(d::length).required().example("\"8 5 mm\"");
  k.add("domain.regions.*.material", text, "Name of one of `materials`.").computed("`domain.material`");
  k.add("domain.regions.*.temperature", quantity, "At time 0.")
      .unit(d::temperature)
      .in({.low = 0.0})
      .computed("`initial.temperature`");
  k.add("domain.regions.*.velocity", vector, "At time 0.").unit(d::velocity).computed("`initial.velocity`");
}

void add_refinements(Keys& k, const std::string& table, const std::string& of, bool of_cracks) {
  const std::string at = table + ".refine.*.";
  k.add(table + ".refine", named_tables, "Regions with a finer spacing" + of + ".");
  k.add(table + ".refine.*", Type::table,
        of_cracks
            ? "A region given by `box`, `points` or `tips`, with its `spacing` or `factor`; the finest one "
              "wins."
            : "A region given by `box` or `points`, with its `spacing` or `factor`; the finest one wins.");
  k.add(at + "box", vectors, "Two opposite corners.").unit(d::length).example("[\"4 0 mm\", \"6 10 mm\"]");
  k.add(at + "points", vectors, "A point, or the corners of a polyline.")
      .unit(d::length)
      .example("[\"5 0 mm\", \"5 10 mm\"]");
  if (of_cracks)
    k.add(at + "tips", texts, "Names of cracks, whose ends are refined, or `all`.").example("[\"all\"]");
  k.add(at + "spacing", quantity, "Spacing in the region.")
      .unit(d::length)
      .in(positive)
      .example("\"0.05 mm\"");
  k.add(at + "factor", quantity, "Spacing in the region over `" + table + ".spacing`.")
      .in({.low = 0.0, .high = 1.0, .low_open = true})
      .example("0.25");
  k.add(at + "growth", quantity, "Growth of the spacing per unit of distance outside.")
      .in({.low = 0.0, .high = 1.0, .low_open = true})
      .fallback("0.3");
}

void add_cloud(Keys& k) {
  k.add("cloud", table, "The nodes.").required().or_from_cutting();
  k.add("cloud.pattern", choice,
        "`hexagonal`: near-equilateral; `regular`: square grid, uniform spacing only; `jittered`: hexagonal "
        "with random offsets; `list`: the nodes given in `nodes` or `nodes_file`.")
      .one_of({"hexagonal", "regular", "jittered", "list"})
      .fallback("\"hexagonal\"");
  k.add("cloud.spacing", quantity,
        "Distance of neighbouring nodes away from refinements. Required except for pattern `list`.")
      .unit(d::length)
      .in(positive)
      .example("\"0.2 mm\"");
  k.add("cloud.jitter", quantity, "Pattern `jittered`: largest random offset over the spacing.")
      .in({.low = 0.0, .high = 0.4})
      .fallback("0.2");
  k.add("cloud.seed", integer, "Pattern `jittered`: seed of the random offsets.")
      .in({.low = 0, .high = 9e15})
      .fallback("1");
  k.add("cloud.nodes", vectors,
        "Pattern `list`: every node once, interior and boundary, with all corners of the domain among them.")
      .unit(d::length)
      .example("[\"0 0 mm\", \"1 0 mm\", \"0 1 mm\"]");
  k.add("cloud.nodes_file", text,
        "Pattern `list`: CSV file with a header such as `x[mm],y[mm]`, relative to the case file.")
      .example("\"cloud.csv\"");
  add_refinements(k, "cloud", "", true);
}

} // namespace cnem::input
