#include "report/materials.hpp"

#include "results/si_format.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::report {
namespace {

using input::LibraryMaterial;
using input::Setting;
using Texts = std::vector<std::string>;

/// A table of constants and what it is called.
struct Group {
  const char* key; ///< "": the material itself
  const char* title;
};
constexpr Group groups[] = {
    {"", "General"},        {"elastic", "Elastic"}, {"plastic", "Plastic"}, {"anisotropy", "Anisotropy"},
    {"failure", "Failure"}, {"damage", "Damage"},   {"heat", "Heat"}};

const std::string& text_at(const Setting& table, const char* key) {
  static const std::string none;
  const Setting* setting = table.find(key);
  return setting ? std::get<std::string>(setting->value) : none;
}

Texts texts_at(const Setting& table, const char* key) { return table.maybe<Texts>(key).value_or(Texts{}); }

std::string unit_of(const Setting& constant) {
  const input::Dimension& dimension = constant.key->dimension;
  return dimension.dimensionless() ? "" : input::describe(dimension).si_unit;
}

/// "1, 1.2, 1.4", with the unit behind.
std::string list_text(const Setting& list) {
  std::string text;
  for (const double value : std::get<std::vector<double>>(list.value))
    text += fmt::format("{}{}", text.empty() ? "" : ", ", results::number_format(value, 6));
  const std::string unit = unit_of(list);
  return unit.empty() ? text : text + " " + unit;
}

std::string value_text(const Setting& constant) {
  return results::si_format(std::get<double>(constant.value), unit_of(constant), 6);
}

/// Constants of a table that its file has, name and value.
std::vector<std::pair<std::string, std::string>> constants_of(const Setting& table) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const Setting& member : table.members) {
    if (!member.given) continue;
    if (member.key->type == input::Type::quantity) rows.emplace_back(member.name, value_text(member));
    if (member.key->type == input::Type::quantities) rows.emplace_back(member.name, list_text(member));
    if (member.key->type == input::Type::choice)
      rows.emplace_back(member.name, std::get<std::string>(member.value));
  }
  return rows;
}

/// What is stated of the range, "0.001 to 1000 1/s", and by whom.
std::vector<std::pair<std::string, std::string>> range_of(const Setting& material) {
  const Setting* range = material.find("plastic.range");
  std::vector<std::pair<std::string, std::string>> rows;
  const auto add = [&](const char* key, const char* name, const char* unit) {
    const auto limits = range ? range->maybe<std::vector<double>>(key) : std::nullopt;
    if (limits)
      rows.emplace_back(name, fmt::format("{} to {}{}", results::number_format((*limits)[0]),
                                          results::number_format((*limits)[1]), unit));
  };
  add("strain", "plastic strain", "");
  add("rate", "plastic strain rate", " 1/s");
  add("temperature", "temperature", " K");
  if (rows.empty()) rows.emplace_back("range", "not stated");
  if (range) rows.emplace_back("stated by", text_at(*range, "source"));
  return rows;
}

/// f(title, rows) for each table of constants, its sources at the end, and for the measured range.
template<class F> void for_each_group(const LibraryMaterial& material, const F& f) {
  for (const Group& group : groups) {
    const Setting* table = material.settings.find(group.key);
    if (!table) continue;
    auto rows = constants_of(*table);
    for (const std::string& source : texts_at(*table, "source")) rows.emplace_back("source", source);
    f(group.title, rows);
  }
  f("Where the plastic constants were measured", range_of(material.settings));
}

std::string calibration_of(const LibraryMaterial& material) {
  const Setting* damage = material.settings.find("damage");
  return damage ? text_at(*damage, "calibration") : "–";
}

std::string short_range(const LibraryMaterial& material) {
  std::string text;
  for (const auto& [name, limits] : range_of(material.settings))
    if (name != "stated by") text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, limits);
  return text;
}

std::vector<LibraryMaterial> all_materials() {
  std::vector<LibraryMaterial> list;
  for (const std::string& name : input::library_names()) list.push_back(input::library_material(name));
  return list;
}

/// Values inside the stated range; where none is stated, of the range of sheets and blanks that are cut.
std::vector<double> rates_of(const plasticity::MeasuredRange& measured) {
  std::vector<double> rates;
  for (const double rate : {1.0, 100.0, 1e4})
    if (measured.rate.contains(rate)) rates.push_back(rate);
  if (rates.empty()) rates = {measured.rate.low, measured.rate.high};
  return rates;
}

std::vector<double> temperatures_of(const plasticity::Material& material) {
  const Range& range = material.measured.temperature;
  const double melting = material.hardening->melting_temperature();
  const double low = range.bounded() ? range.low : 293.15;
  const double high = std::min({range.high, 0.75 * melting, low + 600.0});
  return {low, 0.5 * (low + high), high};
}

Chart flow_curves(const plasticity::Material& material, const std::vector<double>& rates,
                  const std::vector<double>& temperatures) {
  Chart chart;
  chart.x_label = "plastic strain";
  chart.x_unit = "";
  chart.y_label = "flow stress";
  chart.y_unit = "Pa";
  constexpr int samples = 120;
  const double end = material.measured.strain.bounded() ? material.measured.strain.high : 1.0;
  const double begin = std::max(0.0, material.measured.strain.low);
  for (const double rate : rates)
    for (const double temperature : temperatures) {
      ChartSeries curve;
      curve.label = rates.size() > 1 ? fmt::format("{} 1/s", results::number_format(rate))
                                     : fmt::format("{} K", results::number_format(temperature));
      curve.colour = static_cast<int>(chart.series.size());
      for (int k = 0; k <= samples; ++k) {
        // Denser at the beginning, where the curves are steep.
        const double s = static_cast<double>(k) / samples, strain = begin + s * s * (end - begin);
        curve.x.push_back(strain);
        curve.y.push_back(material.hardening->flow_stress(strain, rate, temperature));
      }
      chart.series.push_back(std::move(curve));
    }
  return chart;
}

} // namespace

std::string materials_list() {
  std::string text;
  for (const LibraryMaterial& material : all_materials())
    text += fmt::format("{:<16} {:<13} {:<8} damage {:<8}  {}\n{:16} {}\n", material.name,
                        text_at(material.settings, "plastic.law"),
                        material.settings.find("heat") ? "thermal" : "", calibration_of(material),
                        short_range(material), "", text_at(material.settings, "description"));
  return text;
}

std::string material_text(const LibraryMaterial& material) {
  std::string text = fmt::format("{}: {}\n", material.name, text_at(material.settings, "description"));
  for_each_group(material, [&](const std::string& title, const auto& rows) {
    text += fmt::format("\n{}\n", title);
    for (const auto& [name, value] : rows) text += fmt::format("  {:<20} {}\n", name, value);
  });
  const Texts notes = texts_at(material.settings, "notes");
  if (!notes.empty()) text += "\nNotes\n";
  for (const std::string& note : notes) text += fmt::format("  - {}\n", note);
  return text;
}

ReportData material_report(const LibraryMaterial& material, const std::string& version) {
  ReportData page;
  page.title = material.name;
  page.subtitle = fmt::format("cnem {}, library of materials", version);
  page.verdict = text_at(material.settings, "description");
  page.warnings = texts_at(material.settings, "notes");
  page.warnings_title = "Notes";
  page.charts_title = "Flow curves";
  page.case_title = fmt::format("materials/{}.toml", material.name);
  const plasticity::Material& metal = material.material;
  const std::vector<double> rates = rates_of(metal.measured), temperatures = temperatures_of(metal);
  page.charts.push_back(flow_curves(metal, rates, {temperatures.front()}));
  page.charts.back().title = fmt::format("Rates, at {} K", results::number_format(temperatures.front()));
  page.charts.push_back(flow_curves(metal, {rates.front()}, temperatures));
  page.charts.back().title = fmt::format("Temperatures, at {} 1/s", results::number_format(rates.front()));
  for (Chart& chart : page.charts) chart.note = "Isothermal. " + short_range(material) + ".";
  for_each_group(material, [&](const std::string& title, const auto& rows) {
    page.tables.push_back({title, rows});
  });
  for (const input::LibraryFile& file : input::library_files())
    if (file.name == material.name) page.case_text = file.text;
  return page;
}

std::string materials_reference() {
  std::string text = R"(# Materials

<!-- Generated from materials/*.toml by `cnem materials --markdown`. -->

A case takes these by name, `domain.material = "lib:304L"` ([user guide](user_guide.md#materials)). Constants come from what is named beside
them; where a source could not be read itself, the work that quotes it is named too. What a source does not state is left out. `generic` damage has
constants that no test stands behind. [materials/README.md](../materials/README.md) says which metals are missing and why, and how to add one.

| name | metal | law | thermal | damage | measured range |
| --- | --- | --- | --- | --- | --- |
)";
  const std::vector<LibraryMaterial> materials = all_materials();
  for (const LibraryMaterial& material : materials)
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", material.name,
                        text_at(material.settings, "description"), text_at(material.settings, "plastic.law"),
                        material.settings.find("heat") ? "yes" : "no", calibration_of(material),
                        short_range(material));
  for (const LibraryMaterial& material : materials) {
    text += fmt::format("\n## {}\n\n{}.\n", material.name, text_at(material.settings, "description"));
    for_each_group(material, [&](const std::string& title, const auto& rows) {
      text += fmt::format("\n{}:", title);
      std::string values, sources;
      for (const auto& [name, value] : rows) {
        if (name == "source" || name == "stated by")
          sources += fmt::format("- {}\n", value);
        else
          values += fmt::format("{} {} {}", values.empty() ? "" : ",", name, value);
      }
      text += fmt::format("{}.\n\n{}", values, sources);
    });
    const Texts notes = texts_at(material.settings, "notes");
    if (!notes.empty()) text += "\nNotes:\n\n";
    for (const std::string& note : notes) text += fmt::format("- {}\n", note);
  }
  return text;
}

} // namespace cnem::report
