// What a run is evaluated for: tools that cut, springback.
#include "core/index.hpp"
#include "input/case_parts.hpp"
#include "input/schema/nearest.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::input {
namespace {

bool moves(const Tool& tool) { return tool.drive || input::moves(tool.velocity); }

std::vector<std::string> names_of(const std::vector<Tool>& tools) {
  std::vector<std::string> names;
  names.reserve(tools.size());
  for (const Tool& tool : tools) names.push_back(tool.name);
  return names;
}

/// The tool named `punch`, else the only one that moves; none when that is not one.
std::optional<std::string> usual_punch(const std::vector<Tool>& tools) {
  std::vector<std::string> moving;
  for (const Tool& tool : tools) {
    if (tool.name == "punch") return tool.name;
    if (moves(tool)) moving.push_back(tool.name);
  }
  return moving.size() == 1 ? std::optional(moving.front()) : std::nullopt;
}

std::vector<std::string> usual_dies(const std::vector<Tool>& tools, const std::string& punch) {
  std::vector<std::string> named, resting;
  for (const Tool& tool : tools) {
    if (tool.name == punch) continue;
    if (tool.name.starts_with("die")) named.push_back(tool.name);
    if (!moves(tool)) resting.push_back(tool.name);
  }
  return named.empty() ? resting : named;
}

bool tied(const Case& input) { return !input.domain.interfaces.empty() || !input.periodic.empty(); }

} // namespace

void read_report(Setting& root, Case& result, Diagnostics& diagnostics) {
  root.set_default("report.springback", root.find("report.blanking") != nullptr && !tied(result));
  result.report.springback = root.get<bool>("report.springback");
  const Setting* blanking = root.find("report.blanking");
  if (!blanking) return;

  const std::vector<std::string> names = names_of(result.tools);
  if (names.empty())
    return diagnostics.add(Mistake::conflict, blanking->where, blanking->path,
                           "found without tools, expected [tools.NAME] that cut");
  if (const auto punch = usual_punch(result.tools)) root.set_default("report.blanking.punch", *punch);
  const Setting* punch = root.find("report.blanking.punch");
  if (!punch)
    return diagnostics.add(Mistake::missing_key, blanking->where, "report.blanking.punch",
                           fmt::format("missing, expected one of the tools \"{}\": not one alone moves",
                                       fmt::join(names, "\", \"")));
  const auto place_of = [&](const Setting& key, const std::string& name) -> std::optional<std::size_t> {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return index_of(found - names.begin());
    diagnostics.add(
        Mistake::reference, key.where, key.path,
        fmt::format("found '{}', expected the name of a tool{}", name, did_you_mean(name, names)));
    return std::nullopt;
  };
  const std::string punch_name = std::get<std::string>(punch->value);
  const auto punch_index = place_of(*punch, punch_name);
  if (!punch_index) return;
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
    else if (const auto index = place_of(dies, name))
      report.dies.push_back(*index);
  }
  report.parallel = root.get<double>("report.blanking.parallel");
  report.smoothing = root.find("report.blanking")->maybe<double>("smoothing");
  result.report.blanking = std::move(report);
}

} // namespace cnem::input
