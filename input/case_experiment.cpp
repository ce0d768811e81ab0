// What was measured: curves of forces, heights of sheared faces.
#include "input/case_parts.hpp"
#include "input/measured_file.hpp"
#include "input/schema/nearest.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace cnem::input {
namespace {

constexpr std::size_t most_points = 2000;
constexpr const char* experiments = "report.experiment";

/// Both of two keys, or neither: one is wanted.
void want_one(const Setting& table, const char* first, const char* second, Diagnostics& diagnostics) {
  const bool both = table.find(first) != nullptr;
  diagnostics.add(
      both ? Mistake::conflict : Mistake::missing_key, table.where, table.path,
      fmt::format("found {} of {} and {}, expected one of them", both ? "both" : "none", first, second));
}

/// What a file holds, put in place of its name.
void take_file(Setting& root, const std::string& path, Case& result, Diagnostics& diagnostics) {
  const Setting& table = *root.find(path);
  const Setting file = *table.find("file");
  for (const char* beside : {"stroke", "time", "force", "force_per_length"})
    if (const Setting* key = table.find(beside))
      return diagnostics.add(Mistake::conflict, key->where, key->path,
                             "found beside a file, expected one of them");
  MeasuredColumns columns;
  columns.expected = {std::vector{dimension::length, dimension::time},
                      std::vector{dimension::force, dimension::force_per_length}};
  for (const char* list : {"columns", "units"})
    if (const Setting* key = table.find(list)) {
      const auto& texts = std::get<std::vector<std::string>>(key->value);
      if (texts.size() != 2)
        return diagnostics.add(
            Mistake::type, key->where, key->path,
            fmt::format("found {} of them, expected two such as {}", texts.size(), key->key->example_text()));
      if (std::string_view(list) == "columns") {
        columns.names = texts;
        continue;
      }
      for (std::size_t c = 0; c < 2; ++c) {
        try {
          columns.units[c] = parse_unit(texts[c]);
        } catch (const UnitError& error) {
          return diagnostics.add(Mistake::unit, key->where_of(c), key->path, error.what());
        }
        const auto& expected = columns.expected[c];
        if (std::find(expected.begin(), expected.end(), columns.units[c]->dimension) == expected.end())
          return diagnostics.add(Mistake::unit, key->where_of(c), key->path,
                                 fmt::format("found \"{}\", expected {}", texts[c],
                                             c == 0 ? "a unit of stroke or time such as \"mm\" or \"ms\""
                                                    : "a unit of force such as \"kN\" or \"N/mm\""));
      }
    }
  const std::filesystem::path folder = std::filesystem::path(result.path).parent_path();
  const std::string name = (folder / std::get<std::string>(file.value)).string();
  MeasuredCurve curve;
  try {
    curve = read_measured(name, columns);
    const std::string gone =
        keep_growing(curve.x, curve.y, name, curve.dimension[0] == dimension::length ? "stroke" : "time");
    if (!gone.empty()) result.warnings.push_back(path + ": " + gone);
  } catch (const InputError& error) {
    return diagnostics.add(Mistake::reference, file.where, file.path, error.what());
  }
  average_over_parts(curve.x, curve.y, most_points);
  for (const char* gone : {".file", ".columns", ".units"}) root.erase(path + gone);
  const bool over_stroke = curve.dimension[0] == dimension::length;
  root.set_default(path + (over_stroke ? ".stroke" : ".time"), std::move(curve.x));
  root.set_default(path + (curve.dimension[1] == dimension::force ? ".force" : ".force_per_length"),
                   std::move(curve.y));
}

/// Points, corrected. False where they make no curve, which is told.
bool take_points(const Setting& table, Experiment& experiment, std::vector<std::string>& warnings,
                 Diagnostics& diagnostics) {
  const Setting *stroke = table.find("stroke"), *time = table.find("time"), *force = table.find("force"),
                *line = table.find("force_per_length");
  if (!stroke == !time) return want_one(table, "stroke", "time", diagnostics), false;
  if (!force == !line) return want_one(table, "force", "force_per_length", diagnostics), false;
  const Setting &x = stroke ? *stroke : *time, &y = force ? *force : *line;
  experiment.over_stroke = stroke != nullptr;
  experiment.per_length = line != nullptr;
  experiment.x = std::get<std::vector<double>>(x.value);
  experiment.force = std::get<std::vector<double>>(y.value);
  if (experiment.x.size() != experiment.force.size() || experiment.x.size() < 2) {
    diagnostics.add(Mistake::conflict, y.where, y.path,
                    fmt::format("found {} values for the {} of {}, expected as many, and at least two",
                                experiment.force.size(), experiment.x.size(), x.path));
    return false;
  }
  for (std::size_t k = 1; k < experiment.x.size(); ++k)
    if (!(experiment.x[k] > experiment.x[k - 1])) {
      diagnostics.add(Mistake::range, x.where_of(k), x.path,
                      fmt::format("found {:.6g} after {:.6g} (SI), expected values that increase",
                                  experiment.x[k], experiment.x[k - 1]));
      return false;
    }
  const double compliance = table.get<double>("compliance");
  if (compliance > 0.0 && (experiment.per_length || !experiment.over_stroke)) {
    const Setting& key = *table.find("compliance");
    diagnostics.add(Mistake::conflict, key.where, key.path,
                    fmt::format("found with {}, expected it with forces in N over a stroke: the whole force "
                                "bends the machine",
                                experiment.per_length ? "forces per length" : "times"));
    return false;
  }
  const double scale = table.get<double>("scale"),
               shift = table.get<double>(experiment.over_stroke ? "shift" : "delay");
  for (std::size_t k = 0; k < experiment.x.size(); ++k) {
    experiment.x[k] += shift - compliance * experiment.force[k] * scale;
    experiment.force[k] *= scale;
  }
  try {
    const std::string gone = keep_growing(experiment.x, experiment.force, "the curve",
                                          "stroke less what the machine gives (compliance)");
    if (!gone.empty()) warnings.push_back(table.path + ".compliance: " + gone);
  } catch (const InputError& error) {
    diagnostics.add(Mistake::range, table.where, table.path + ".compliance", error.what());
    return false;
  }
  if (!(*std::max_element(experiment.force.begin(), experiment.force.end()) > 0.0)) {
    diagnostics.add(
        Mistake::range, y.where, y.path,
        "found no force above 0, expected the force of the tool as positive: scale = -1 turns it");
    return false;
  }
  return true;
}

/// The length that the force is of, where measured and computed forces are not of the same.
bool take_length(const Setting& table, const Case& input, Experiment& experiment, Diagnostics& diagnostics) {
  experiment.cut_length = table.maybe<double>("cut_length");
  experiment.cuts = table.maybe<double>("cuts");
  const bool round = input.analysis.space() == Space::revolution;
  if (round == experiment.per_length && !experiment.cut_length) {
    diagnostics.add(
        Mistake::missing_key, table.where, table.path + ".cut_length",
        round ? "missing, expected the length of the cut: the measured force is per length, the computed "
                "one in N"
              : "missing, expected the length of the cut, the perimeter of the blank say: the measured "
                "force is in N, the computed one in N per thickness");
    return false;
  }
  return true;
}

void read_experiment(Setting& root, const std::string& path, Case& result, Diagnostics& diagnostics) {
  const Report& report = result.report;
  const std::string usual = report.blanking  ? result.tools[report.blanking->punch].name
                            : report.cutting ? result.tools[report.cutting->tool].name
                                             : "punch";
  const auto tool = read_leading_tool(root, result, path, {"tool", usual.c_str()}, diagnostics);
  if (!tool) return;
  if (root.find(path + ".file")) {
    const bool clean = diagnostics.empty();
    take_file(root, path, result, diagnostics);
    if (clean && !diagnostics.empty()) return;
  }
  if (report.cutting && *tool == report.cutting->tool)
    root.set_default(path + ".cut_length", report.cutting->width);
  const Setting& table = *root.find(path);
  Experiment experiment;
  experiment.name = table.name;
  experiment.tool = *tool;
  experiment.component = table.choice<Experiment::Component>("component");
  if (take_points(table, experiment, result.warnings, diagnostics) &&
      take_length(table, result, experiment, diagnostics))
    result.report.experiments.push_back(std::move(experiment));
}

} // namespace

void name_single_experiment(Value& document) {
  Member* report = document.find("report");
  Member* found = report ? report->value.find("experiment") : nullptr;
  if (!found || found->value.kind != Value::Kind::table) return;
  const auto& members = found->value.members;
  if (std::all_of(members.begin(), members.end(),
                  [](const Member& member) { return member.value.kind == Value::Kind::table; }))
    return;
  Value named;
  named.kind = Value::Kind::table;
  named.where = found->value.where;
  named.members.push_back({"measured", found->where, std::move(found->value)});
  found->value = std::move(named);
}

void read_experiments(Setting& root, Case& result, Diagnostics& diagnostics) {
  std::vector<std::string> paths;
  for (const Setting& entry : root.entries(experiments)) paths.push_back(entry.path);
  for (const std::string& path : paths) read_experiment(root, path, result, diagnostics);
}

void read_measured_faces(const Setting& root, BlankingReport& report, Diagnostics& diagnostics) {
  const std::vector<std::string> bodies{"slug", "skeleton"};
  for (const Setting& table : root.entries("report.blanking.measured")) {
    if (std::find(bodies.begin(), bodies.end(), table.name) == bodies.end()) {
      diagnostics.add(Mistake::reference, table.where, table.path,
                      fmt::format("found '{}', expected 'slug' or 'skeleton'{}", table.name,
                                  did_you_mean(table.name, bodies)));
      continue;
    }
    const auto height = [&](const std::string& zone) -> std::optional<MeasuredHeight> {
      const Setting *length = table.find(zone), *share = table.find(zone + "_share");
      if (length && share)
        diagnostics.add(Mistake::conflict, share->where, share->path,
                        fmt::format("found beside {}, expected one of them", zone));
      if (length) return MeasuredHeight{std::get<double>(length->value), false};
      if (share) return MeasuredHeight{std::get<double>(share->value), true};
      return std::nullopt;
    };
    MeasuredFace face{.body = table.name,
                      .rollover = height("rollover"),
                      .burnish = height("burnish"),
                      .fracture = height("fracture"),
                      .burr = height("burr"),
                      .fracture_angle = table.maybe<double>("fracture_angle")};
    report.measured.push_back(std::move(face));
  }
}

} // namespace cnem::input
