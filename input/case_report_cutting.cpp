// What a cut is evaluated with.
#include "input/case_parts.hpp"
#include "input/constants.hpp"
#include "input/cutting_tool.hpp"

#include <fmt/format.h>

namespace cnem::input {

void read_cutting_report(Setting& root, Case& result, Diagnostics& diagnostics) {
  const std::string at = "report.cutting";
  if (result.analysis.space() == Space::revolution)
    return diagnostics.add(Mistake::conflict, root.find(at)->where, at,
                           "found in an axisymmetric analysis, expected it with analysis.kinematics = "
                           "\"plane strain\": an orthogonal cut is straight");
  const auto tool = read_leading_tool(root, result, at, {"tool", "cutter"}, diagnostics);
  if (!tool) return;
  CuttingReport report;
  report.tool = *tool;
  try {
    root.set_default(at + ".feed", cutting_tool(result, *tool).depth);
  } catch (const InputError& error) {
    const Setting& key = *root.find(at + ".tool");
    return diagnostics.add(Mistake::conflict, key.where, key.path, error.what());
  }
  report.feed = root.get<double>(at + ".feed");
  report.width = root.get<double>(at + ".width");
  root.set_default(at + ".filter", 0.2 * report.feed);
  report.filter = root.get<double>(at + ".filter");
  root.set_default(at + ".clear", report.feed);
  report.clear = root.get<double>(at + ".clear");
  report.steady_feeds = root.get<double>(at + ".steady.feeds");
  report.steady_tolerance = root.get<double>(at + ".steady.tolerance");
  if (const Setting* isotherms = root.find(at + ".isotherms")) {
    report.isotherms = std::get<std::vector<double>>(isotherms->value);
    if (!result.tools[*tool].section)
      diagnostics.add(Mistake::conflict, isotherms->where, isotherms->path,
                      fmt::format("found isotherms of a tool that does not conduct, expected "
                                  "tools.{}.heat.section beside them",
                                  result.tools[*tool].name));
  }
  if (const Setting* wear = root.find(at + ".wear"))
    read_constants(UsuiWear::parameters, *wear, report.wear.emplace());
  result.report.cutting = report;
}

} // namespace cnem::input
