#include "app/profile.hpp"

#include <fmt/format.h>

namespace cnem::app {

std::string profile_table(const results::RunStatus& status) {
  double total = 0.0;
  for (const auto& [phase, seconds] : status.wall_s)
    if (phase == "total") total = seconds;
  std::string table =
      fmt::format("{:<16} {:>10} {:>8} {:>12}\n", "phase", "seconds", "share", "ns/node-step");
  for (const auto& [phase, seconds] : status.wall_s) {
    if (seconds == 0.0) continue;
    const std::size_t dot = phase.find('.');
    const std::string name = dot == std::string::npos ? phase : "  " + phase.substr(dot + 1);
    const std::string each =
        status.node_steps > 0 ? fmt::format("{:.2f}", 1e9 * seconds / static_cast<double>(status.node_steps))
                              : "-";
    table += fmt::format("{:<16} {:>10.4f} {:>7.1f}% {:>12}\n", name, seconds,
                         total > 0.0 ? 100.0 * seconds / total : 0.0, each);
  }
  return table;
}

} // namespace cnem::app
