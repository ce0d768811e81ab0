#include "input/usual_tools.hpp"

#include <algorithm>

namespace cnem::input {

namespace {

bool moves(const Tool& tool) { return tool.drive || input::moves(tool.velocity); }

} // namespace

std::optional<std::string> usual_leader(const std::vector<Tool>& tools, const std::string& usual) {
  std::vector<std::string> moving;
  for (const Tool& one : tools) {
    if (one.name == usual) return usual;
    if (moves(one)) moving.push_back(one.name);
  }
  if (moving.size() != 1) return std::nullopt;
  return moving.front();
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

std::optional<BlankingReport> usual_blanking(const Case& input) {
  const auto punch = usual_leader(input.tools, "punch");
  if (!punch) return std::nullopt;
  const std::vector<std::string> dies = usual_dies(input.tools, *punch);
  if (dies.empty()) return std::nullopt;
  BlankingReport report;
  for (std::size_t k = 0; k < input.tools.size(); ++k) {
    if (input.tools[k].name == *punch) report.punch = k;
    if (std::find(dies.begin(), dies.end(), input.tools[k].name) != dies.end()) report.dies.push_back(k);
  }
  return report;
}

} // namespace cnem::input
