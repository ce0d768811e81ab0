#include "input/case_reader.hpp"

#include "input/case_parts.hpp"
#include "input/cutting.hpp"
#include "input/drawings/outlines.hpp"
#include "input/included_files.hpp"
#include "input/law_file.hpp"
#include "input/library.hpp"
#include "input/local_origin.hpp"
#include "input/schema/nearest.hpp"
#include "input/temperature_ramps.hpp"
#include "input/variables.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace cnem::input {

std::string name_after(const std::string& path, const std::string& generic) {
  const std::filesystem::path file = std::filesystem::absolute(path).lexically_normal();
  const std::string name = file.filename().string().starts_with(generic + ".")
                               ? file.parent_path().filename().string()
                               : file.stem().string();
  if (name.empty() || name == "." || name == "..")
    throw InputError(
        fmt::format("{}: found the name '{}', expected one that a folder of results can have", path, name));
  return name;
}

namespace {

/// Defaults that depend on other keys.
void compute_defaults(Setting& root) {
  const bool statics = root.get<std::string>("analysis.type") == "static";
  if (statics) root.set_default("time.end", 1.0);
  const double end = root.get<double>("time.end"), temperature = root.get<double>("initial.temperature");
  const Setting* materials = root.find("materials");
  const Setting* material = materials->find(root.get<std::string>("domain.material"));
  root.set_default("analysis.thermal", material && material->find("heat") && !statics);
  const bool round = root.get<std::string>("analysis.kinematics") == "axisymmetric";
  root.set_default("method.stabilisation",
                   round ? 0.2 : 0.05); // the axis has a weak mode of its own: docs/theory.md
  if (root.get<std::string>("analysis.type") != "static")
    root.set_default("time.quasi_static", root.find("time.mass_scaling") || root.find("report.blanking"));
  root.set_default("output.history_every", end / 400.0);
  root.set_default("output.fields_every", end / 24.0);
  const bool space = root.get<std::string>("analysis.kinematics") == "three-dimensional";
  root.set_default("method.gauss_points", std::int64_t{space ? 1 : 2});
  if (space)
    root.set_default("initial.velocity", Vec3(0, 0, 0));
  else
    root.set_default("initial.velocity", Vec2(0, 0));
  if (space && root.find("domain.block.radius")) root.set_default("domain.block.centre", Vec3(0, 0, 0));
  using Names = std::vector<std::string>;
  root.set_default("output.pictures", std::vector<double>{end});
  root.set_default("output.picture_fields",
                   statics && space
                       ? Names{"equivalent_stress", "displacement_x", "displacement_y", "displacement_z"}
                   : statics ? Names{"equivalent_stress", "displacement_x", "displacement_y"}
                   : !root.get<bool>("analysis.mechanical") ? Names{"temperature"}
                   : root.get<bool>("analysis.thermal") ? Names{"plastic_strain", "temperature", "pressure"}
                                                        : Names{"plastic_strain", "pressure"});
  set_material_defaults(root, temperature);
  for (const Setting& entry : root.entries("domain.regions")) {
    root.set_default(entry.path + ".material", root.get<std::string>("domain.material"));
    root.set_default(entry.path + ".temperature", temperature);
    root.set_default(entry.path + ".velocity", root.get<Vec2>("initial.velocity"));
  }
  const bool springs = root.get<std::string>("contact.scheme") == "central-difference";
  for (const Setting& entry : root.entries("tools")) {
    if (springs && !entry.find("response.law")) root.set_default(entry.path + ".response.scale", 2.0);
    root.set_default(entry.path + ".response.law", std::string(springs ? "penalty" : "exact"));
    if (entry.find("heat")) root.set_default(entry.path + ".heat.temperature", temperature);
    if (!entry.find("mass")) {
      VectorFunction rest{TimeTable(0.0), TimeTable(0.0)};
      if (space) rest[2] = TimeTable(0.0);
      root.set_default(entry.path + ".velocity", std::move(rest));
    } else if (round)
      root.set_default(entry.path + ".direction", Vec2(0.0, 1.0));
  }
}

void read_time(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const Setting& step = *root.find("time.step");
  result.time = {
      root.get<double>("time.end"),
      step.get<double>("safety"),
      step.maybe<double>("max"),
      step.maybe<double>("fixed"),
      static_cast<int>(step.get<std::int64_t>("check_every")),
      step.maybe<double>("min"),
      root.maybe<std::int64_t>("time.max_steps"),
      {.on = step.get<bool>("local"), .levels = static_cast<int>(step.get<std::int64_t>("levels"))},
      {}};
  read_mass_scaling(root, result, diagnostics);
  result.time.quasi_static = root.maybe<bool>("time.quasi_static").value_or(false);
  if (const Setting* fixed = step.find("fixed"); fixed && result.time.max_step)
    diagnostics.add(Mistake::conflict, fixed->where, fixed->path,
                    "found a fixed step and a largest step, expected one of them");
  if (const Setting* least = step.find("min"); least && result.time.fixed)
    diagnostics.add(Mistake::conflict, least->where, least->path,
                    "found a fixed step and a least step, expected one of them");
}

void read_zone(Setting& root, Case& result, Diagnostics& diagnostics) {
  if (result.cloud.spacing > 0.0) root.set_default("method.zone_spacing", 0.75 * result.cloud.spacing);
  const Setting& table = *root.find("method");
  if (const auto spacing = table.maybe<double>("zone_spacing"))
    result.method.options.zone_spacing = *spacing;
  else
    diagnostics.add(Mistake::missing_key, table.where, "method.zone_spacing",
                    "missing, expected " + find_key("method.zone_spacing")->expectation() +
                        ": a list of nodes has no cloud.spacing to take it from");
}

void read_method(Setting& root, Case& result, Diagnostics& diagnostics) {
  if (root.get<std::string>("method.name") == "hybrid") read_zone(root, result, diagnostics);
  const Setting& table = *root.find("method");
  Method& method = result.method;
  method.name = table.get<std::string>("name");
  method.options.least_squares = table.get<std::string>("functions") == "mls";
  if (!method.options.least_squares) method.options.functions = table.choice<scni::Functions>("functions");
  method.options.support = table.get<double>("support");
  method.options.gauss_points = static_cast<int>(table.get<std::int64_t>("gauss_points"));
  if (table.find("cells")) {
    method.options.cells = table.choice<scni::CellKind>("cells");
    method.options.points_on_facets = method.options.gauss_points == 1 ? 1 : 3;
  }
  if (table.find("kernel")) {
    method.options.kernel = table.choice<methods::Kernel>("kernel");
    method.options.smoothing = table.get<double>("smoothing");
  }
  method.options.space = result.analysis.space();
  method.stabilisation = table.get<double>("stabilisation");
  method.pressure_exchange = table.get<double>("pressure_exchange");
  method.stress_annealing = table.get<double>("stress_annealing");
  method.lagrangian = table.choice<Method::Lagrangian>("lagrangian");
  method.rereference_every = static_cast<int>(table.get<std::int64_t>("rereference.every"));
  method.rereference_strain = table.get<double>("rereference.strain");
  method.viscosity_linear = table.get<double>("bulk_viscosity.linear");
  method.viscosity_quadratic = table.get<double>("bulk_viscosity.quadratic");
  method.energy_tolerance = table.get<double>("energy_tolerance");
}

CheckpointControl read_checkpoint(const Setting& root) {
  const Setting& checkpoint = *root.find("output.checkpoint");
  return {checkpoint.get<std::int64_t>("every_steps"), checkpoint.get<double>("every_time"),
          checkpoint.get<double>("every_wall"), static_cast<int>(checkpoint.get<std::int64_t>("keep"))};
}

void read_output(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const Setting& table = *root.find("output");
  constexpr double most_rows = 1e7;
  for (const char* name : {"history_every", "fields_every"}) {
    const Setting& every = *table.find(name);
    const double interval = std::get<double>(every.value);
    if (interval > 0.0 && interval < result.time.end / most_rows)
      diagnostics.add(
          Mistake::range, every.where, every.path,
          fmt::format("found {:g} s, expected 0 s or at least {:g} s, a ten-millionth of time.end", interval,
                      result.time.end / most_rows));
  }
  Output& output = result.output;
  output.history_every = table.get<double>("history_every");
  output.fields_every = table.get<double>("fields_every");
  if (table.find("surface")) output.surface = table.get<bool>("surface");
  if (table.find("polyhedra")) output.polyhedra = table.get<bool>("polyhedra");
  read_pictures(table, result, diagnostics);
  output.checkpoint = read_checkpoint(root);
  for (const Setting& probe : table.entries("probes"))
    output.probes.push_back({probe.name, probe.vector("at"), probe.get<std::vector<std::string>>("fields")});
  for (const Setting& line : table.entries("lines"))
    output.lines.push_back({line.name, line.vector("from"), line.vector("to"),
                            static_cast<int>(line.get<std::int64_t>("samples")),
                            line.get<std::vector<std::string>>("fields")});
}

void collect_locations(const Setting& setting, std::map<std::string, std::string>& location) {
  if (setting.given) location[setting.path] = setting.where.text();
  for (const Setting& member : setting.members) collect_locations(member, location);
}

/// What to say of a change that makes a tool, a material, … beside one of nearly its name: a slip, which
/// shows in keys that the new one lacks. Empty otherwise.
std::string made_beside(const Value& document, const Override& change) {
  const std::size_t first = change.key.find('.');
  if (first == std::string::npos) return "";
  const Member* table = document.find(change.key.substr(0, first));
  const std::string name = change.key.substr(first + 1, change.key.find('.', first + 1) - first - 1);
  if (!table || table->value.kind != Value::Kind::table || table->value.find(name)) return "";
  std::vector<std::string> there;
  for (const Member& member : table->value.members) {
    if (member.value.kind != Value::Kind::table) return "";
    there.push_back(member.key);
  }
  const std::string meant = did_you_mean(name, there);
  return meant.empty()
             ? ""
             : fmt::format("\n{}: the case has no {}.{}{}", change.where.text(), table->key, name, meant);
}

/// A case of milling or of structures, of settings that the schema has passed.
void read_milling(Setting& root, Case& result, Diagnostics& diagnostics) {
  read_structure(root, result, diagnostics);
  if (result.analysis.type == Analysis::Type::stability || result.analysis.type == Analysis::Type::milling)
    read_machining(root, result, diagnostics);
  result.output.checkpoint = read_checkpoint(root);
  read_shown_units(root, result, diagnostics);
  diagnostics.throw_if_any();
}

Case read_changed(Value document, const std::string& path, const std::vector<Override>& changes) {
  if (const Member* include = document.find("include"))
    throw InputError(fmt::format("{}: key 'include': goes into the file of a case, expected none beside it",
                                 include->where.text()));
  name_single_experiment(document);
  Diagnostics diagnostics;
  Case result;
  const Family family = family_of(document);
  const bool milling = family != Family::bodies;
  if (family == Family::milling) take_law_from_file(document, std::filesystem::path(path).parent_path());
  result.variables = apply_variables(document, changes, diagnostics, result.warnings);
  if (!milling) {
    take_from_library(document, diagnostics);
    take_from_drawings(document, std::filesystem::path(path).parent_path(), diagnostics);
    take_from_cutting(document, diagnostics);
    start_temperature_ramps(document);
  }
  diagnostics.throw_if_any();
  Setting root = apply_schema(document, diagnostics);
  const Member* time = document.find("time");
  const bool ended = time && time->value.find("end");
  if (const Setting* type = root.find("analysis.type");
      !milling && !ended && type && std::get<std::string>(type->value) != "static")
    diagnostics.add(Mistake::missing_key, time ? time->value.where : document.where, "time.end",
                    find_key("time.end")->missing());
  diagnostics.throw_if_any();

  result.path = path;
  result.name = name_after(path, "case");
  result.title = root.get<std::string>("title");
  const std::string header = fmt::format("Resolved from {}: SI units, defaults included.", path);
  if (milling) {
    result.analysis.type = root.choice<Analysis::Type>("analysis.type");
    collect_locations(root, result.location);
    read_milling(root, result, diagnostics);
    result.resolved = write_resolved(root, header);
    return result;
  }
  compute_defaults(root);
  result.analysis = {root.choice<Analysis::Type>("analysis.type"),
                     root.choice<Analysis::Kinematics>("analysis.kinematics"),
                     root.get<bool>("analysis.mechanical"), root.get<bool>("analysis.thermal")};
  collect_locations(root, result.location);
  read_time(root, result, diagnostics);
  read_materials(root, result, diagnostics);
  read_output(root, result, diagnostics);
  read_domain(root, result, diagnostics);
  read_cloud(root, result, diagnostics);
  read_tools(root, result, diagnostics);
  if (Setting* cutting = root.find("cutting")) result.cutting = read_cutting(*cutting, diagnostics);
  const bool plane = result.analysis.dimensions() == 2;
  if (plane) {
    read_windows(root, result, diagnostics);
    read_coolants(root, result, diagnostics);
  }
  read_contact(root, result, diagnostics);
  diagnostics.throw_if_any();
  read_regions(root, result, diagnostics);
  read_boundary(root, result, diagnostics);
  read_periodic(root, result, diagnostics);
  read_initial_and_loads(root, result, diagnostics);
  read_method(root, result, diagnostics);
  read_shown_units(root, result, diagnostics);
  read_adaptation(root, result, diagnostics);
  read_report(root, result, diagnostics);
  if (plane) {
    read_fracture(root, result, diagnostics);
    if (root.find("adapt.window")) read_moving_window(root, result, diagnostics);
  }
  check_promises(root, result, diagnostics);
  check_pairs(root, result, diagnostics);
  diagnostics.throw_if_any();
  result.resolved = write_resolved(root, header);
  use_local_origin(result);
  return result;
}

Case read(Value document, const std::string& path, const std::vector<Override>& changes) {
  document = with_included(std::move(document), std::filesystem::path(path).parent_path());
  std::string slips;
  for (const Override& change : changes) {
    check_variable_of(document, change);
    slips += made_beside(document, change);
    apply_override(document, change);
  }
  try {
    return read_changed(std::move(document), path, changes);
  } catch (const InputError& error) {
    if (slips.empty()) throw;
    throw InputError(error.what() + slips);
  }
}

std::vector<Override> parsed(const std::vector<std::string>& overrides) {
  std::vector<Override> list;
  for (const std::string& assignment : overrides) list.push_back(parse_override(assignment, "--set"));
  return list;
}

} // namespace

Case read_case(const std::string& path, const std::vector<std::string>& overrides) {
  return read(read_document(path), path, parsed(overrides));
}

Case read_case_with(const std::string& path, const std::vector<Override>& changes) {
  return read(read_document(path), path, changes);
}

Case read_case_text(std::string_view text, const std::string& source,
                    const std::vector<std::string>& overrides) {
  return read(parse_document(text, source), source, parsed(overrides));
}

Case read_case_document(Value document, const std::string& path, const std::vector<Override>& changes) {
  return read(std::move(document), path, changes);
}

} // namespace cnem::input
