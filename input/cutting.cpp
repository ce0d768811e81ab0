#include "input/cutting.hpp"

#include "input/schema/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::input {
namespace {

constexpr double pi = std::numbers::pi;

/// Sizes in feeds; docs/cutting.md says why.
namespace feeds {
constexpr double below = 5.0;          ///< matter under the cut
constexpr double ahead = 8.0;          ///< and beyond its end, up to the support
constexpr double beyond = 4.0;         ///< way of the tool after it has left
constexpr double faces = 10.0;         ///< of the tool, on top of the length of cut
constexpr double window = 12.0;        ///< matter ahead of the tip in a window that moves
constexpr double behind = 8.0;         ///< and behind it: surfaces are measured up to six feeds from the tip
constexpr double chip = 15.0;          ///< chip kept in it: measured over ten feeds beyond the shear zone
constexpr double layer = 0.5;          ///< depth of fine cells under the cut
constexpr double coarse = 0.5;         ///< spacing away from the cut
constexpr double fine = 0.2;           ///< spacing of what becomes the chip
constexpr double finest = 0.05;        ///< spacing where it flows, by the indicator
constexpr double surface = 1.0 / 17.0; ///< spacing of free surfaces that flow
constexpr double cell = 0.02;          ///< width of cells whose step finer ones take, heavier than they are
constexpr double a_row = 0.05;         ///< way of the tool between rows of the history
} // namespace feeds

/// Spacing of what has flowed and rests, over that of the cloud there.
constexpr double rest_factor = 1.5;

/// Spacing whose step cells at the edge take, over their own, at most: they grow heavier by the square of it.
constexpr double heaviest = 4.0;

/// Radius at the ends of a land over its width, unless it is given.
constexpr double sharpest = 0.2;

/// The outline of the tool at t = 0, before its edges are rounded: flank, edge, land, rake face.
struct ToolCorners {
  Vec2 back{0, 0}, edge{0, 0}, top{0, 0};
  std::optional<Vec2> land_end;
};

double rake_at_edge(const CuttingSetup& cut) { return cut.rake - (cut.chamfer ? cut.chamfer->angle : 0.0); }

/// m, spacing at the edge: what chords cut off its arc, and with it the work that goes into pushing metal out
/// of the arc as they grow, is the same share of the feed whatever the radius. Under friction metal stretches
/// less around the arc and the work is larger: cells may be wider, as far as they still show the arc.
double edge_spacing(const CuttingSetup& cut) {
  constexpr double rubbed = 0.5; // as far as it was measured
  const double smooth = std::sqrt(cut.edge_radius * cut.feed) / 30.0;
  const double rough = smooth * (1.0 + 2.0 * std::min(cut.friction, rubbed));
  return std::max(smooth, std::min(rough, 0.5 * cut.edge_radius));
}

/// Along a face from the edge upwards.
Vec2 face(double rake) { return {-std::sin(rake), std::cos(rake)}; }
Vec2 flank(double clearance) { return {-std::cos(clearance), std::sin(clearance)}; }

/// Centre of the arc of radius r that rounds a corner with these sides.
Vec2 rounding_centre(const Vec2& corner, const Vec2& side, const Vec2& other, double r) {
  const Vec2 middle = (side + other).normalized();
  return corner + r / std::abs(cross(middle, side)) * middle;
}

/// The lowest point lies at y = 0; what of the tool is no higher than the uncut surface touches x = 0.
ToolCorners tool_corners(const CuttingSetup& cut) {
  const double cut_before = cut.window ? std::min(cut.length, feeds::chip * cut.feed) : cut.length;
  const double length = cut_before + feeds::faces * cut.feed, r = cut.edge_radius;
  const Vec2 first = face(rake_at_edge(cut)), rake = face(cut.rake);
  ToolCorners corners;
  corners.back = length * flank(cut.clearance);
  if (cut.chamfer) corners.land_end = cut.chamfer->width * first;
  const Vec2 below_rake = corners.land_end.value_or(corners.edge);
  corners.top = below_rake + length * rake;

  const Vec2 centre = rounding_centre(corners.edge, flank(cut.clearance), first, r);
  const double lowest = centre.y() - r;
  double furthest = below_rake.x() + (lowest + cut.feed - below_rake.y()) / rake.y() * rake.x();
  if (rake_at_edge(cut) >= 0.0) furthest = std::max(furthest, centre.x() + r);
  if (corners.land_end && rake_at_edge(cut) < 0.0 && cut.rake >= 0.0)
    furthest = std::max(furthest, rounding_centre(*corners.land_end, -first, rake, r).x() + r);
  const Vec2 shift(-furthest, -lowest);
  for (Vec2* x : {&corners.back, &corners.edge, &corners.top}) *x += shift;
  if (corners.land_end) *corners.land_end += shift;
  return corners;
}

std::string point(const Vec2& x) {
  return fmt::format("\"{} {} m\"", format_number(x.x()), format_number(x.y()));
}

std::string tool_text(const CuttingSetup& cut) {
  const ToolCorners corners = tool_corners(cut);
  const std::string fillet = fmt::format("fillet = \"{} m\"", format_number(cut.edge_radius));
  std::string path = fmt::format("{{ to = {}, {} }}", point(corners.edge), fillet);
  if (corners.land_end) path += fmt::format(", {{ to = {}, {} }}", point(*corners.land_end), fillet);
  path += fmt::format(", {{ to = {} }}", point(corners.top));
  return fmt::format("[tools.{}]\nstart = {}\npath = [{}]\nvelocity = {{ x = \"{} m/s\", y = \"0 m/s\" "
                     "}}\nequal_areas = true\n",
                     cut.tool, point(corners.back), path, format_number(cut.speed));
}

/// What is left out where other keys of the case leave no place for it.
struct Parts {
  bool window = true;     ///< of the pictures, at the end of the cut in a workpiece of ours
  bool resampling = true; ///< and what needs it
  bool report = true;     ///< [report.cutting], of a tool of ours or where it is asked for
};

/// What follows from a cut, as a case would say it.
std::string case_text(const CuttingSetup& cut, const Parts& parts) {
  const double f = cut.feed;
  const auto length = [](double x) { return fmt::format("\"{} m\"", format_number(x)); };
  const double end = cut.window ? feeds::window * f : cut.length + (cut.exit ? 0.0 : feeds::ahead * f);
  // What is held at its foot alone must be sturdy, or it topples before the tool.
  const double below = std::min(feeds::below * f, cut.exit ? 0.5 * cut.length : feeds::below * f);
  const double way = cut.length + (cut.exit ? feeds::beyond * f : 0.0), duration = way / cut.speed;
  const double seen = cut.window ? 0.0 : way; // where the tool is in the window of the pictures
  const auto time = [](double t) { return fmt::format("\"{} s\"", format_number(t)); };
  std::string text =
      fmt::format("[time]\nend = {}\n[time.mass_scaling]\ncell = {}\n", time(duration),
                  length(std::min(feeds::cell * f, heaviest * edge_spacing(cut)))) +
      fmt::format("[domain.outer.rectangle]\nfrom = {}\nto = {}\n", point({0.0, -below}), point({end, f})) +
      fmt::format("[cloud]\nspacing = {}\n[cloud.refine.layer]\nbox = [{}, {}]\nspacing = {}\n",
                  length(feeds::coarse * f), point({0.0, -feeds::layer * f}), point({end, f}),
                  length(feeds::fine * f)) +
      fmt::format("[boundary.bed]\npieces = [\"bottom\"{}]\nvelocity = \"0 0 m/s\"\n",
                  cut.exit ? "" : ", \"right\"") +
      tool_text(cut) + "[contact]\ndeformable = true\n" +
      fmt::format("[output]\nhistory_every = {}\npictures = [{}, {}, {}]\n",
                  time(std::min(duration / 400.0, feeds::a_row * f / cut.speed)), time(duration / 3.0),
                  time(duration / 1.5), time(duration));
  if (parts.report)
    text += fmt::format("[report.cutting]\ntool = \"{}\"\nfeed = {}\nwidth = {}\n", cut.tool, length(f),
                        length(cut.width));
  if (parts.window)
    text += fmt::format("[output.windows.tool]\nbox = [{}, {}]\n{}", point({seen - 6.0 * f, -2.0 * f}),
                        point({seen + 4.0 * f, 6.0 * f}),
                        cut.window ? fmt::format("follow = \"{}\"\n", cut.tool) : "");
  if (parts.resampling)
    text +=
        "[method]\npressure_exchange = 2.0\nstress_annealing = 1.0\n"
        "[method.rereference]\nevery = 400\nstrain = 0.25\n" +
        fmt::format("[adapt]\nresample = true\ntool_spacing = {}\nsurface_spacing = {}\nrest_factor = {}\n",
                    length(edge_spacing(cut)), length(feeds::surface * f), format_number(rest_factor)) +
        fmt::format("[adapt.indicator]\nfield = \"plastic_power\"\nh_min = {}\nh_max = {}\n",
                    length(feeds::finest * f), length(feeds::fine * f));
  if (parts.resampling && cut.window)
    text += fmt::format("[adapt.window]\nfollow = \"{}\"\nahead = {}\nbehind = {}\n{}", cut.tool,
                        length(feeds::window * f), length(feeds::behind * f),
                        parts.report ? fmt::format("chip = {}\n", length(feeds::chip * f)) : "");
  return text;
}

/// Members of which one leaves no room for the others.
constexpr std::array<std::array<const char*, 5>, 4> rivals{{{"start", "path", "close", "rectangle", "circle"},
                                                            {"box", "points", "tips"},
                                                            {"spacing", "factor"},
                                                            {"cell", "factor", "step"}}};

bool has_rival(const Value& table, const std::string& key) {
  return std::any_of(rivals.begin(), rivals.end(), [&](const auto& group) {
    const auto is = [&](const char* name) { return name && key == name; };
    return std::any_of(group.begin(), group.end(), is) &&
           std::any_of(group.begin(), group.end(),
                       [&](const char* name) { return name && table.find(name); });
  });
}

/// Adds what a table lacks. One that names its law is whole: constants of another would not fit.
void complete(Value& table, const Value& derived) {
  if (table.kind != Value::Kind::table || table.find("law")) return;
  const Value written = table;
  for (const Member& member : derived.members) {
    if (Member* own = table.find(member.key)) {
      if (member.value.kind == Value::Kind::table) complete(own->value, member.value);
    } else if (!has_rival(written, member.key))
      table.members.push_back(member);
  }
}

/// The value at a key of a table of the document; nullptr where there is none.
const Value* value_at(const Value& document, std::string_view table, std::string_view key) {
  const Member* outer = document.find(table);
  const Member* inner = outer ? outer->value.find(key) : nullptr;
  return inner ? &inner->value : nullptr;
}

bool resampling_refused(const Value& document) {
  const Value* resample = value_at(document, "adapt", "resample");
  return resample && resample->kind == Value::Kind::boolean && !resample->boolean;
}

/// Whether a tool of the document has an outline of its own.
bool has_outline(const Value& document, const std::string& tool) {
  const Value* given = value_at(document, "tools", tool);
  return given && given->kind == Value::Kind::table && has_rival(*given, "path");
}

/// What is wrong with the angles and the edge together.
void check_edge(const Setting& table, const CuttingSetup& cut, Diagnostics& diagnostics) {
  const auto deg = [](double angle) { return angle * 180.0 / pi; };
  const auto add = [&](const char* name, const std::string& message) {
    const Setting& key = table.find(name) ? *table.find(name) : table;
    diagnostics.add(Mistake::range, key.where, table.path + "." + name, message);
  };
  const double first = rake_at_edge(cut);
  if (cut.rake + cut.clearance >= 0.5 * pi)
    return add("rake",
               fmt::format("found {:g} deg beside a clearance of {:g} deg, expected less than 90 deg in "
                           "all: nothing is left of the tool between its faces",
                           deg(cut.rake), deg(cut.clearance)));
  if (first <= -0.5 * pi)
    return add("chamfer", fmt::format("found an angle of {:g} deg beside a rake of {:g} deg, expected a land "
                                      "that does not face the machined surface: less than {:g} deg",
                                      deg(cut.chamfer->angle), deg(cut.rake), deg(cut.rake) + 90.0));
  constexpr double bluntest = 3.0; // the least chip thickness is a fifth to two fifths of the radius
  if (cut.edge_radius > bluntest * cut.feed)
    add("edge_radius", fmt::format("found {:g} m beside a feed of {:g} m, expected at most {:g} times it: "
                                   "such an edge ploughs and makes no chip",
                                   cut.edge_radius, cut.feed, bluntest));
  if (!cut.chamfer) return;
  const double rounded = cut.edge_radius * (std::tan(0.25 * pi + 0.5 * (cut.clearance + first)) +
                                            std::tan(0.5 * cut.chamfer->angle));
  if (rounded > cut.chamfer->width)
    add("edge_radius",
        fmt::format("found {:g} m, which rounds {:g} m of a land of {:g} m, expected less: at most {:.3g} m",
                    cut.edge_radius, rounded, cut.chamfer->width,
                    cut.edge_radius * cut.chamfer->width / rounded));
}

} // namespace

CuttingSetup read_cutting(Setting& table, Diagnostics& diagnostics) {
  if (const auto width = table.maybe<double>("chamfer.width"))
    table.set_default("edge_radius", sharpest * *width);
  CuttingSetup cut;
  for (const auto& [name, value] : {std::pair{"feed", &cut.feed},
                                    {"width", &cut.width},
                                    {"rake", &cut.rake},
                                    {"clearance", &cut.clearance},
                                    {"speed", &cut.speed},
                                    {"length", &cut.length}})
    *value = table.get<double>(name);
  cut.friction = table.maybe<double>("friction.coefficient").value_or(0.0);
  cut.tool = table.get<std::string>("tool");
  cut.exit = table.get<bool>("exit");
  cut.window = table.get<bool>("window");
  if (cut.exit && cut.window) {
    const Setting& window = *table.find("window");
    diagnostics.add(Mistake::conflict, window.where, window.path,
                    "found true beside exit = true, expected one of them: a workpiece that goes on ahead of "
                    "the tool has no end to leave through");
  }
  if (const Setting* land = table.find("chamfer"))
    cut.chamfer = {land->get<double>("width"), land->get<double>("angle")};
  if (!cut.chamfer && !table.find("edge_radius"))
    diagnostics.add(
        Mistake::missing_key, table.where, table.path + ".edge_radius",
        fmt::format("missing, expected {}, or a chamfer", find_key("cutting.edge_radius")->expectation()));
  cut.edge_radius = table.maybe<double>("edge_radius").value_or(0.0);
  if (!valid_name(cut.tool)) {
    const Setting& tool = *table.find("tool");
    diagnostics.add(Mistake::type, tool.where, tool.path,
                    fmt::format("found {}, expected a name of at most {} letters, digits, '_' and '-'",
                                toml_quoted(shortened(cut.tool)), longest_name));
  }
  if (cut.edge_radius > 0.0) check_edge(table, cut, diagnostics);
  return cut;
}

void take_from_cutting(Value& document, Diagnostics& diagnostics) {
  const Member* found = document.find("cutting");
  if (!found) return;
  const Member cutting = *found;
  for (const auto& [key, expected] : {std::pair{"type", "explicit"}, {"kinematics", "plane strain"}})
    if (const Value* given = value_at(document, "analysis", key);
        given && given->kind == Value::Kind::text && given->text != expected) {
      diagnostics.add(
          Mistake::conflict, cutting.where, "cutting",
          fmt::format("found with analysis.{} = {}, expected \"{}\": a cut is a motion in plane strain", key,
                      given->show(), expected));
      return;
    }
  if (cutting.value.kind != Value::Kind::table) return; // the schema tells
  Setting table = apply_schema(cutting.value, "cutting", "cutting", diagnostics);
  if (!diagnostics.empty()) return;
  const CuttingSetup cut = read_cutting(table, diagnostics);
  if (!diagnostics.empty()) return;

  const Location from{cutting.where.text() + ", from [cutting]", 0, 0};
  const Parts parts{.window = !value_at(document, "domain", "outer"),
                    .resampling = !resampling_refused(document),
                    .report = value_at(document, "report", "cutting") || !has_outline(document, cut.tool)};
  Value derived = parse_document(case_text(cut, parts), from.source);
  relocate(derived, from);
  if (const Member* friction = cutting.value.find("friction"))
    derived.find("tools")->value.find(cut.tool)->value.members.push_back(*friction);
  complete(document, derived);
}

} // namespace cnem::input
