// What a run is evaluated for: tools that cut, springback.
#include "core/index.hpp"
#include "input/case_parts.hpp"
#include "input/schema/nearest.hpp"
#include "input/schema/units.hpp"
#include "input/usual_tools.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::input {
namespace {

bool tied(const Case& input) { return !input.domain.interfaces.empty() || !input.periodic.empty(); }

void read_blanking(Setting& root, Case& result, Diagnostics& diagnostics) {
  const auto punch_index =
      read_leading_tool(root, result, "report.blanking", {"punch", "punch"}, diagnostics);
  if (!punch_index) return;
  const std::vector<std::string> names = tool_names(result);
  const std::string punch_name = names[*punch_index];
  if (const auto usual = usual_dies(result.tools, punch_name); !usual.empty())
    root.set_default("report.blanking.die", usual);
  else if (!root.find("report.blanking.die"))
    return diagnostics.add(
        Mistake::missing_key, root.find("report.blanking")->where, "report.blanking.die",
        "missing, expected the names of the tools that the punch cuts against: no other one is at rest");
  const Setting& dies = *root.find("report.blanking.die");
  BlankingReport report;
  report.punch = *punch_index;
  for (const std::string& name : std::get<std::vector<std::string>>(dies.value)) {
    if (name == punch_name)
      diagnostics.add(Mistake::conflict, dies.where, dies.path,
                      fmt::format("found the punch '{}', expected another tool", name));
    else if (const auto index = index_of_tool(dies, name, names, diagnostics))
      report.dies.push_back(*index);
  }
  report.parallel = root.get<double>("report.blanking.parallel");
  report.smoothing = root.find("report.blanking")->maybe<double>("smoothing");
  if (result.domain.in_space()) {
    report.sections = static_cast<int>(root.get<std::int64_t>("report.blanking.sections"));
    if (root.find("report.blanking.centre")) report.centre = root.find("report.blanking")->vector("centre");
  }
  read_measured_faces(root, report, diagnostics);
  result.report.blanking = std::move(report);
}

} // namespace

std::vector<std::string> tool_names(const Case& input) {
  std::vector<std::string> names;
  names.reserve(input.tools.size());
  for (const Tool& tool : input.tools) names.push_back(tool.name);
  return names;
}

std::optional<std::size_t> index_of_tool(const Setting& key, const std::string& name,
                                         const std::vector<std::string>& tools, Diagnostics& diagnostics) {
  const auto found = std::find(tools.begin(), tools.end(), name);
  if (found != tools.end()) return index_of(found - tools.begin());
  diagnostics.add(Mistake::reference, key.where, key.path,
                  fmt::format("found '{}', expected the name of a tool{}", name, did_you_mean(name, tools)));
  return std::nullopt;
}

std::optional<std::size_t> read_leading_tool(Setting& root, const Case& input, const std::string& table,
                                             const LeadingTool& tool, Diagnostics& diagnostics) {
  const std::vector<std::string> names = tool_names(input);
  const Location where = root.find(table)->where;
  if (names.empty()) {
    diagnostics.add(Mistake::conflict, where, table, "found without tools, expected [tools.NAME] that cut");
    return std::nullopt;
  }
  const std::string path = fmt::format("{}.{}", table, tool.key);
  if (const auto usual = usual_leader(input.tools, tool.usual)) root.set_default(path, *usual);
  const Setting* key = root.find(path);
  if (!key) {
    diagnostics.add(Mistake::missing_key, where, path,
                    fmt::format("missing, expected one of the tools \"{}\": not one alone moves",
                                fmt::join(names, "\", \"")));
    return std::nullopt;
  }
  return index_of_tool(*key, std::get<std::string>(key->value), names, diagnostics);
}

void read_shown_units(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const Setting* key = root.find("report.units");
  if (!key) return;
  std::vector<Unit> known;
  for (const std::string& text : std::get<std::vector<std::string>>(key->value)) {
    const auto wrong = [&](const std::string& words) {
      diagnostics.add(Mistake::unit, key->where, key->path, words);
    };
    try {
      const Unit unit = parse_unit(text);
      for (std::size_t k = 0; k < known.size(); ++k)
        if (const std::string& other = result.report.units[k];
            known[k].dimension == unit.dimension && is_energy(text) == is_energy(other))
          wrong(fmt::format("found '{}' and '{}', expected one unit for each dimension", other, text));
      known.push_back(unit);
      result.report.units.push_back(text);
    } catch (const UnitError& error) {
      wrong(fmt::format("{}, expected units such as \"kN/mm\", \"J\", \"MPa\", \"degC\"", error.what()));
    }
  }
}

void read_report(Setting& root, Case& result, Diagnostics& diagnostics) {
  if (!result.domain.in_space()) {
    root.set_default("report.springback", root.find("report.blanking") != nullptr && !tied(result));
    result.report.springback = root.get<bool>("report.springback");
  }
  if (root.find("report.blanking")) read_blanking(root, result, diagnostics);
  if (root.find("report.cutting")) read_cutting_report(root, result, diagnostics);
  read_experiments(root, result, diagnostics);
}

} // namespace cnem::input
