// Reads parts and shafts.
#include "input/case_structure.hpp"

#include "core/index.hpp"
#include "input/case_parts.hpp"
#include "input/part_cells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <set>
#include <string_view>

namespace cnem::input {
namespace {

machining::ElasticSolid read_solid(const Setting& table) {
  return {table.get<double>("young"), table.get<double>("poisson"), table.get<double>("density")};
}

/// Of a piece of a whole, which has what it does not say.
machining::ElasticSolid read_solid(const Setting& table, const machining::ElasticSolid& whole) {
  return {table.maybe<double>("young").value_or(whole.young),
          table.maybe<double>("poisson").value_or(whole.poisson),
          table.maybe<double>("density").value_or(whole.density)};
}

machining::PartSupport face_of(const std::string& name) {
  return {.axis = name[0] - 'x', .far = name[1] == '1'};
}

void read_zones(const Setting& part, machining::PartShape& shape, Diagnostics& diagnostics) {
  for (const Setting& table : part.entries("zones")) {
    machining::PartZone zone{.low = table.get<Vec3>("from"),
                             .high = table.get<Vec3>("to"),
                             .material = shape.materials.size(),
                             .taken = table.get<double>("taken")};
    if (!((zone.high - zone.low).array() > 0.0).all())
      diagnostics.add(Mistake::range, table.where, table.path + ".to",
                      "found a corner that is not beyond `from` along x, y and z, expected the opposite one");
    else if (((zone.low.array() >= shape.size.array()) || (zone.high.array() <= 0.0)).any())
      diagnostics.add(Mistake::range, table.where, table.path,
                      "lies beside the part, expected a box within it");
    shape.materials.push_back(read_solid(table, shape.materials.front()));
    shape.zones.push_back(std::move(zone));
  }
}

void read_supports(const Setting& table, PartCase& part, Diagnostics& diagnostics) {
  const auto add = [&](const char* key, bool turns) {
    const Setting* faces = table.find(key);
    if (!faces) return;
    for (const std::string& name : std::get<std::vector<std::string>>(faces->value)) {
      machining::PartSupport support = face_of(name);
      support.turns = turns;
      if (part.element == machining::PartElement::plate_8 && support.axis == 2)
        diagnostics.add(Mistake::conflict, faces->where, faces->path,
                        "found " + name +
                            ", expected an edge: x0, x1, y0, y1: the faces of a plate are not apart");
      part.supports.push_back(support);
    }
    if (turns && part.element != machining::PartElement::plate_8)
      diagnostics.add(
          Mistake::conflict, faces->where, faces->path,
          "found with hexahedra, expected it with part.element = \"plate_8\" only: what holds all points "
          "of a face does not let it turn");
  };
  add("clamped", false);
  add("supported", true);
  if (part.supports.empty())
    diagnostics.add(
        Mistake::missing_key, table.where, table.path + ".clamped",
        "missing, expected faces that are held, such as [\"y0\"]: a part that nothing holds has no "
        "stiffness against moving as a whole");
}

void read_damping(const Setting& table, PartCase& part, Diagnostics& diagnostics) {
  part.damping = table.maybe<double>("damping");
  if (const Setting* rayleigh = table.find("rayleigh")) {
    part.rayleigh = {rayleigh->get<double>("mass"), rayleigh->get<double>("stiffness")};
    if (part.damping)
      diagnostics.add(Mistake::conflict, rayleigh->where, rayleigh->path,
                      "found part.damping too, expected one of them");
  }
}

void read_directions(const Setting& table, PartCase& part, Diagnostics& diagnostics) {
  part.cutter = table.maybe<Vec3>("cutter");
  const Vec3 feed = table.get<Vec3>("feed"), axis = table.get<Vec3>("axis");
  constexpr double square = 1e-6;
  const Setting& where = *table.find("axis");
  if (!(feed.norm() > 0.0) || !(axis.norm() > 0.0) ||
      std::abs(feed.normalized().dot(axis.normalized())) > square) {
    diagnostics.add(Mistake::range, where.where, where.path,
                    "found a direction that is not square to part.feed, expected one across it");
    return;
  }
  part.to_cutter.row(0) = feed.normalized().transpose();
  part.to_cutter.row(2) = axis.normalized().transpose();
  part.to_cutter.row(1) = axis.normalized().cross(feed.normalized()).transpose();
}

void read_mapping(const Setting& table, Analysis::Type type, PartCase& part, Diagnostics& diagnostics) {
  enum class Mapping { point, hexahedra };
  const Setting& mapping = *table.find("mapping");
  part.mapped = table.choice<Mapping>("mapping") == Mapping::hexahedra;
  if (part.mapped && type != Analysis::Type::milling)
    diagnostics.add(Mistake::conflict, mapping.where, mapping.path,
                    "found hexahedra that follow the part, expected them with analysis.type = \"milling\" "
                    "only: nothing else has dexels in it");
  enum class Integration { modes, newmark };
  if (const Setting* integration = table.find("integration")) {
    part.newmark = table.choice<Integration>("integration") == Integration::newmark;
    if (part.newmark && part.damping)
      diagnostics.add(Mistake::conflict, integration->where, integration->path,
                      "found with part.damping, which is of modes, expected [part.rayleigh]");
  }
  if (const Setting* removal = table.find("removal")) {
    if (!part.newmark)
      diagnostics.add(
          Mistake::conflict, removal->where, removal->path,
          "found without part.integration = \"newmark\" (and part.mapping = \"hexahedra\"), expected "
          "it there only: modes change as matter goes");
    part.taking = {removal->get<std::int64_t>("interval"), removal->get<double>("most")};
  }
  constexpr double most = 200.0;
  if (const Setting* hexahedra = table.find("hexahedra"))
    part.hexahedra = whole_numbers(*hexahedra, "hexahedra", most, diagnostics);
  constexpr double most_together = 2e4; // whose nodes answer to each other
  if (part.hexahedra)
    if (const auto [x, y, z] = *part.hexahedra; 1.0 * x * y * z > most_together)
      diagnostics.add(
          Mistake::range, table.find("hexahedra")->where, table.find("hexahedra")->path,
          fmt::format("found {:g} hexahedra, expected at most {:g}", 1.0 * x * y * z, most_together));
}

PartCase read_part(const Setting& table, Analysis::Type type, Diagnostics& diagnostics) {
  PartCase part;
  part.shape.size = table.get<Vec3>("size");
  if (const Setting& size = *table.find("size"); !(part.shape.size.array() > 0.0).all()) {
    diagnostics.add(Mistake::range, size.where, size.path,
                    "found a side without length, expected three > 0 m");
    return part;
  }
  part.element = table.choice<machining::PartElement>("element");
  part.shape.materials = {read_solid(table)};
  read_zones(table, part.shape, diagnostics);
  read_supports(table, part, diagnostics);
  read_cells(table, part.element, part.supports, part.shape, diagnostics);
  read_damping(table, part, diagnostics);
  read_directions(table, part, diagnostics);
  read_mapping(table, type, part, diagnostics);
  part.count = static_cast<int>(table.get<std::int64_t>("count"));
  for (const Setting& point : table.entries("points")) {
    PartPlace place{.name = point.name, .at = point.maybe<Vec3>("at"), .force = point.get<Vec3>("force")};
    const Setting* face = point.find("face");
    if (static_cast<bool>(face) == place.at.has_value())
      diagnostics.add(Mistake::conflict, point.where, point.path,
                      face ? "found a point and a face, expected one of them"
                           : "missing, expected a point, `at`, or a `face`");
    else if (face) {
      const machining::PartSupport of = face_of(std::get<std::string>(face->value));
      place.axis = of.axis;
      place.far = of.far;
      if (part.element == machining::PartElement::plate_8 && of.axis == 2)
        diagnostics.add(Mistake::conflict, face->where, face->path,
                        "found a face of a plate, expected one of its edges: x0, x1, y0, y1");
    }
    part.places.push_back(std::move(place));
  }
  return part;
}

machining::Bearing read_bearing(const Setting& table) {
  enum class Kind { spring, pinned, clamped };
  constexpr double rigid = std::numeric_limits<double>::infinity();
  machining::Bearing bearing{.at = table.get<double>("at")};
  const auto kind = table.choice<Kind>("kind");
  if (kind == Kind::spring) {
    bearing.stiffness = table.get<double>("stiffness");
    bearing.damping = table.get<double>("damping");
    bearing.tilt_stiffness = table.get<double>("tilt_stiffness");
    bearing.tilt_damping = table.get<double>("tilt_damping");
  } else
    bearing.stiffness = rigid;
  if (kind == Kind::clamped) bearing.tilt_stiffness = rigid;
  return bearing;
}

/// Sections follow each other; bearings and points stand along them.
void check_places(const Setting& table, const ShaftCase& shaft, Diagnostics& diagnostics) {
  if (std::any_of(shaft.sections.begin(), shaft.sections.end(),
                  [](const machining::ShaftSection& section) { return section.to <= section.from; }))
    return; // it has been told
  const std::vector<Setting>& tables = table.entries("sections");
  std::vector<std::size_t> order(tables.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return shaft.sections[a].from < shaft.sections[b].from; });
  if (order.empty()) return;
  const double begin = shaft.sections[order.front()].from, end = shaft.sections[order.back()].to,
               same = 1e-9 * (end - begin);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const double before = shaft.sections[order[k - 1]].to;
    if (const Setting& from = *tables[order[k]].find("from");
        std::abs(shaft.sections[order[k]].from - before) > same)
      diagnostics.add(Mistake::range, from.where, from.path,
                      fmt::format("found {:g} m, expected {:g} m, where {} ends",
                                  shaft.sections[order[k]].from, before, tables[order[k - 1]].path));
  }
  for (const char* list : {"bearings", "points"})
    for (const Setting& entry : table.entries(list))
      if (const Setting& at = *entry.find("at");
          entry.get<double>("at") < begin - same || entry.get<double>("at") > end + same)
        diagnostics.add(Mistake::range, at.where, at.path,
                        fmt::format("found {:g} m, expected from {:g} to {:g} m, along the shaft",
                                    entry.get<double>("at"), begin, end));
}

ShaftCase read_shaft(Setting& table, Diagnostics& diagnostics) {
  ShaftCase shaft;
  const machining::ElasticSolid solid = read_solid(table);
  for (const Setting& section : table.entries("sections")) {
    shaft.sections.push_back({.from = section.get<double>("from"),
                              .to = section.get<double>("to"),
                              .diameter = section.get<double>("diameter"),
                              .bore = section.get<double>("bore"),
                              .solid = read_solid(section, solid),
                              .shear_correction = section.maybe<double>("shear_correction")});
    const machining::ShaftSection& read = shaft.sections.back();
    if (const Setting& to = *section.find("to"); read.to <= read.from)
      diagnostics.add(Mistake::range, to.where, to.path,
                      fmt::format("found {:g} m, expected more than from = {:g} m", read.to, read.from));
    if (const Setting& bore = *section.find("bore"); read.bore >= read.diameter)
      diagnostics.add(
          Mistake::range, bore.where, bore.path,
          fmt::format("found {:g} m, expected less than the diameter, {:g} m", read.bore, read.diameter));
  }
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (const machining::ShaftSection& section : shaft.sections) {
    begin = std::min(begin, section.from);
    end = std::max(end, section.to);
  }
  constexpr double elements = 40.0, most = 400.0;
  table.set_default("element", (end - begin) / elements);
  shaft.element = table.get<double>("element");
  if (const Setting& element = *table.find("element"); (end - begin) / shaft.element > most)
    diagnostics.add(Mistake::range, element.where, element.path,
                    fmt::format("found {:g} m, expected at least {:g} m: {:g} elements", shaft.element,
                                (end - begin) / most, most));
  for (const Setting& bearing : table.entries("bearings")) shaft.bearings.push_back(read_bearing(bearing));
  std::set<double> held; // places
  bool clamped = false;
  for (const machining::Bearing& bearing : shaft.bearings) {
    if (bearing.stiffness > 0.0) held.insert(bearing.at);
    clamped = clamped || (bearing.stiffness > 0.0 && bearing.tilt_stiffness > 0.0);
  }
  if (!clamped && held.size() < 2)
    diagnostics.add(
        Mistake::conflict, table.find("bearings")->where, "shaft.bearings",
        "found bearings that let the shaft move as a whole, expected two places that are held, or one "
        "whose slope is held too");
  shaft.speed = table.get<double>("speed");
  shaft.count = static_cast<int>(table.get<std::int64_t>("count"));
  for (const Setting& point : table.entries("points"))
    shaft.places.push_back({point.name, point.get<double>("at"), point.get<double>("force")});
  check_places(table, shaft, diagnostics);
  return shaft;
}

void check_box(const Setting& table, const RemovalCase& removal, const Vec3& size, Diagnostics& diagnostics) {
  const Setting& to = *table.find("to");
  if (!((removal.high - removal.low).array() > 0.0).all())
    diagnostics.add(Mistake::range, to.where, to.path,
                    "found a corner that is not beyond `from` along x, y and z, expected the opposite one");
  else if (((removal.low.array() >= size.array()) || (removal.high.array() <= 0.0)).any())
    diagnostics.add(Mistake::range, table.where, table.path,
                    "lies beside the part, expected a box of which some is within it");
}

/// What a tool takes of the part in analyses of removal.
void read_removal(Setting& root, Analysis::Type type, StructureCase& structure, Diagnostics& diagnostics) {
  Setting* found = root.find("removal");
  if (type != Analysis::Type::removal) {
    if (found && type == Analysis::Type::modes)
      diagnostics.add(Mistake::conflict, found->where, found->path,
                      "found in an analysis of modes, expected it with analysis.type = \"removal\" only");
    return;
  }
  if (const Setting* shaft = root.find("shaft"))
    diagnostics.add(Mistake::conflict, shaft->where, shaft->path,
                    "found in an analysis of removal, expected it with analysis.type = \"modes\" only: "
                    "nothing is taken of a shaft");
  for (const char* table : {"part", "removal"})
    if (!root.find(table))
      diagnostics.add(Mistake::missing_key, root.where, table,
                      table == std::string_view("part")
                          ? "missing, expected the [part] that is machined"
                          : "missing, expected what the tool takes of the part");
  if (!found || !structure.part) return;
  Setting& table = *found;
  RemovalCase& removal = structure.removal.emplace();
  removal.low = table.get<Vec3>("from");
  removal.high = table.get<Vec3>("to");
  check_box(table, removal, structure.part->shape.size, diagnostics);
  const auto& along = table.get<std::string>("along");
  removal.backward = along.front() == '-';
  removal.axis = along.back() - 'x';
  removal.speed = table.get<double>("speed");
  removal.most = table.get<double>("most");
  table.set_default("duration", (removal.high - removal.low)[removal.axis] / removal.speed);
  removal.duration = table.get<double>("duration");
  const double step = table.get<double>("step"), rounding = 1e-9;
  const double steps = std::ceil(removal.duration / step - rounding);
  if (constexpr double most = 1e8; !(steps <= most)) {
    const Setting& where = *table.find("step");
    diagnostics.add(Mistake::range, where.where, where.path,
                    fmt::format("found {:g} s, expected at least {:g} s: {:g} steps", step,
                                removal.duration / most, most));
    return;
  }
  removal.settings = {.dt = step,
                      .steps = static_cast<std::int64_t>(steps),
                      .interval = table.get<std::int64_t>("interval"),
                      .damping = structure.part->rayleigh.value_or(machining::Rayleigh{}),
                      .inverse = table.choice<machining::EffectiveInverse>("inverse")};
  if (const Setting* damping = root.find("part.damping"))
    diagnostics.add(Mistake::conflict, damping->where, damping->path,
                    "found in an analysis of removal, expected [part.rayleigh]: modes change as matter goes");
  removal.reference = table.get<bool>("reference");
  if (removal.reference && structure.part->places.empty())
    diagnostics.add(Mistake::missing_key, root.find("part")->where, "part.points",
                    "missing, expected a point at which the motions are compared");
  if (const Setting* force = table.find("force"))
    removal.force = {force->get<Vec3>("at"), force->get<Vec3>("amplitude"), force->get<double>("frequency"),
                     force->get<bool>("follows")};
}

} // namespace

void read_structure(Setting& root, Case& result, Diagnostics& diagnostics) {
  const auto made = std::make_shared<StructureCase>();
  result.structure = made;
  if (const Setting* part = root.find("part"))
    made->part = read_part(*part, result.analysis.type, diagnostics);
  if (Setting* shaft = root.find("shaft")) made->shaft = read_shaft(*shaft, diagnostics);
  if (result.analysis.type == Analysis::Type::modes && !made->part && !made->shaft)
    diagnostics.add(Mistake::missing_key, root.where, "part",
                    "missing, expected a [part] or a [shaft] that vibrates");
  read_removal(root, result.analysis.type, *made, diagnostics);
}

} // namespace cnem::input
