// Coolants of the case reader.
#include "input/case_parts.hpp"

namespace cnem::input {

void read_coolants(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const std::vector<std::string> tools = tool_names(result);
  for (const Setting& table : root.entries("coolants")) {
    Coolant coolant;
    coolant.name = table.name;
    coolant.coefficient = TimeTable(table.get<double>("coefficient"));
    coolant.ambient = table.get<TimeTable>("temperature");
    const Setting *box = table.find("box"), *follow = table.find("follow");
    if (box) coolant.box = read_box(*box, diagnostics);
    if (follow) {
      coolant.follow = index_of_tool(*follow, std::get<std::string>(follow->value), tools, diagnostics);
      if (!box)
        diagnostics.add(Mistake::missing_key, follow->where, table.path + ".box",
                        "missing, expected a box that moves with the tool");
    }
    if (!result.analysis.thermal)
      diagnostics.add(Mistake::conflict, table.where, table.path,
                      "found a coolant, expected it with analysis.thermal = true only");
    result.coolants.push_back(std::move(coolant));
  }
}

} // namespace cnem::input
