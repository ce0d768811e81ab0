#include "results/shown_units.hpp"

#include "core/error.hpp"
#include "input/case_output.hpp"
#include "input/schema/document.hpp"

#include <cmath>

namespace cnem::results {
ShownUnits::ShownUnits(const std::vector<std::string>& units) {
  for (const std::string& text : units) {
    try {
      const input::Unit unit = input::parse_unit(text);
      choices_.push_back({unit.dimension,
                          input::is_energy(text),
                          {unit.factor * std::pow(10.0, unit.power), printed_unit(text), unit.offset}});
    } catch (const input::UnitError& error) { throw InputError(error.what()); }
  }
}

ShownUnits ShownUnits::otherwise(const std::vector<std::string>& units) const {
  ShownUnits all = *this;
  const ShownUnits others(units);
  all.choices_.insert(all.choices_.end(), others.choices_.begin(), others.choices_.end());
  return all;
}

ShownUnits ShownUnits::of_case(const std::string& resolved) {
  const input::Value root = input::parse_document(resolved, "case.resolved.toml");
  const input::Member* report = root.find("report");
  const input::Member* units = report ? report->value.find("units") : nullptr;
  if (!units) return {};
  std::vector<std::string> texts;
  for (const input::Value& unit : units->value.elements) texts.push_back(unit.text);
  return ShownUnits(texts);
}

std::optional<DisplayUnit> ShownUnits::chosen(std::string_view unit) const {
  if (choices_.empty() || unit.empty()) return {};
  input::Dimension dimension;
  try {
    dimension = input::parse_unit(unit).dimension;
  } catch (const input::UnitError&) { return {}; } // a number of nodes, per cent
  for (const Choice& choice : choices_)
    if (choice.dimension == dimension && choice.energy == input::is_energy(unit)) return choice.unit;
  return {};
}

DisplayUnit ShownUnits::of(double magnitude, std::string_view unit) const {
  if (std::optional<DisplayUnit> wanted = chosen(unit)) return *wanted;
  return display_unit(magnitude, unit);
}

std::string ShownUnits::format(double value, std::string_view unit, int digits) const {
  return format_in(of(value, unit), value, digits);
}

} // namespace cnem::results
