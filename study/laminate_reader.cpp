// [laminate] of a study.
#include "input/schema/units.hpp"
#include "study/study_parts.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

namespace cnem::study {
namespace {

using Kind = input::Value::Kind;

/// A quantity of a ply, which has to be there; none where it is wrong.
std::optional<double> read_quantity(TableReader& table, const std::string& key,
                                    const input::Dimension& dimension, input::Diagnostics& diagnostics) {
  const input::DimensionText text = input::describe(dimension);
  const input::Value* value =
      table.require(key, Kind::text, fmt::format("{} such as \"{}\"", text.name, text.example));
  if (!value) return {};
  try {
    return input::parse_quantity(value->text, dimension);
  } catch (const input::UnitError& error) {
    diagnostics.add(input::Mistake::unit, value->where, "laminate.plies." + key, error.what());
  }
  return {};
}

bool has_value(const std::vector<const input::Value*>& values, const input::Value& value) {
  return std::any_of(values.begin(), values.end(),
                     [&](const input::Value* one) { return same_value(*one, value); });
}

/// Keys whose values tell runs of one angle apart.
void check_chosen(const LaminatePly& ply, const Study& study, input::Diagnostics& diagnostics) {
  for (const input::Override& choice : ply.chosen) {
    const std::string key = "laminate.plies.set." + choice.key;
    const std::vector<std::string>& keys = study.keys;
    if (std::find(keys.begin(), keys.end(), choice.key) == keys.end()) {
      diagnostics.add(input::Mistake::reference, choice.where, key,
                      fmt::format("the runs of the study do not differ in it, expected a key of [grid], "
                                  "[[axis]] or [[run]]"));
      continue;
    }
    std::vector<const input::Value*> there;
    for (const StudyRun& run : study.runs)
      if (const input::Value* own = run.find(choice.key); own && !has_value(there, *own))
        there.push_back(own);
    if (has_value(there, choice.value)) continue;
    std::vector<std::string> shown;
    for (const input::Value* value : there) shown.push_back(value->show());
    diagnostics.add(input::Mistake::reference, choice.where, key,
                    fmt::format("found {}, expected a value that a run of the study has: {}",
                                choice.value.show(), fmt::join(shown, ", ")));
  }
}

LaminatePly read_ply(const input::Value& entry, std::size_t number, const Study& study,
                     input::Diagnostics& diagnostics) {
  TableReader table(entry, "laminate.plies.", {"name", "angle", "thickness", "set"}, diagnostics);
  LaminatePly ply;
  ply.where = entry.where;
  ply.name = table.text("name");
  if (ply.name.empty()) ply.name = fmt::format("{}", number);
  ply.angle = read_quantity(table, "angle", input::dimension::angle, diagnostics).value_or(0.0);
  const std::optional<double> thickness =
      read_quantity(table, "thickness", input::dimension::length, diagnostics);
  ply.thickness = thickness.value_or(0.0);
  if (thickness && !(*thickness > 0.0)) {
    const input::Value& found = entry.find("thickness")->value;
    diagnostics.add(input::Mistake::range, found.where, "laminate.plies.thickness",
                    fmt::format("found {}, expected a length > 0", found.show()));
  }
  if (const input::Value* set = table.find("set", Kind::table, "a table of keys of the study in quotes"))
    ply.chosen = read_set(*set, "laminate.plies.set.", diagnostics);
  check_chosen(ply, study, diagnostics);
  return ply;
}

} // namespace

Laminate read_laminate(const input::Value& value, const Study& study, input::Diagnostics& diagnostics) {
  TableReader table(value, "laminate.", {"angle", "columns", "plies"}, diagnostics);
  Laminate laminate;
  laminate.where = value.where;
  if (table.require("angle", Kind::text, "the variable or key of the fibres' angle, such as \"let.theta\""))
    laminate.angle = table.text("angle");
  laminate.columns = table.texts("columns");
  for (const std::string& column : laminate.columns)
    check_column(column, value.find("columns")->where, "laminate.columns", {}, diagnostics);
  const input::Value* plies = table.require("plies", Kind::array, "a list of plies");
  if (!plies) return laminate;
  for (const input::Value& entry : plies->elements)
    if (entry.kind == Kind::table)
      laminate.plies.push_back(read_ply(entry, laminate.plies.size() + 1, study, diagnostics));
    else
      table.wrong("plies", entry, "tables with angle and thickness in the list");
  if (plies->elements.empty())
    diagnostics.add(input::Mistake::missing_key, plies->where, "laminate.plies",
                    "empty, expected plies, such as { angle = \"45 deg\", thickness = \"0.25 mm\" }");
  return laminate;
}

} // namespace cnem::study
