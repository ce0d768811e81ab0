// Numbers of a calibration with their units, and what was measured of cuts.
#include "study/calibration_reader_parts.hpp"

#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace cnem::study {

using input::Mistake;

std::optional<WrittenNumber> read_number(TableReader& reader, const input::Value& table,
                                         const std::string& path, const std::string& key,
                                         std::optional<input::Dimension> dimension,
                                         input::Diagnostics& diagnostics) {
  const input::Member* member = table.find(key);
  if (!member) return std::nullopt;
  WrittenNumber written;
  double value = 0.0;
  if (!split_number(member->value, value, written.unit_text)) {
    reader.wrong(key, member->value, "a number with its unit such as \"250 MPa\", or a plain one");
    return std::nullopt;
  }
  if (!written.unit_text.empty()) written.unit = input::parse_unit(written.unit_text);
  written.si = written.unit.to_si(value);
  if (dimension && written.unit.dimension != *dimension) {
    const input::DimensionText text = input::describe(*dimension);
    diagnostics.add(Mistake::unit, member->value.where, path + key,
                    fmt::format("found {}, expected {} such as {}", member->value.show(), text.name,
                                dimension->dimensionless() ? text.example : "\"" + text.example + "\""));
    return std::nullopt;
  }
  return written;
}

std::optional<CutTarget> read_cut(TableReader& reader, const input::Value& table, const std::string& path,
                                  bool closed_form, input::Diagnostics& diagnostics) {
  using What = MeasuredNumber::What;
  namespace d = input::dimension;
  CutTarget cut;
  cut.closed_form = closed_form;
  bool any = false;
  for (const auto& [key, what, of, per] : {std::tuple{"Fc", What::Fc, d::force, d::force_per_length},
                                           {"Ft", What::Ft, d::force, d::force_per_length},
                                           {"chip_thickness", What::chip_thickness, d::length, d::length}}) {
    const std::string error_key = std::string(key) + "_error";
    const input::Member* error = table.find(error_key);
    if (!table.find(key)) {
      if (error)
        diagnostics.add(Mistake::conflict, error->where, path + error_key,
                        fmt::format("found without {}, expected it beside the number", key));
      continue;
    }
    any = true;
    const auto written = read_number(reader, table, path, key, std::nullopt, diagnostics);
    if (!written) continue;
    const input::Dimension dimension = written->unit.dimension;
    if (dimension != of && dimension != per) {
      reader.wrong(key, table.find(key)->value,
                   what == What::chip_thickness ? "a length such as \"0.5 mm\""
                                                : "a force such as \"800 N\", also per width");
      continue;
    }
    constexpr double usual = 0.02;
    MeasuredNumber& measured = cut.measured.emplace_back();
    measured = {what, written->si, dimension == per && what != What::chip_thickness,
                usual * std::abs(written->si), false};
    if (what == What::Fc && !(measured.value > 0.0))
      reader.wrong(key, table.find(key)->value, "a force above 0: it is that on the tool, along the cut");
    if (what == What::chip_thickness && !(measured.value > 0.0))
      reader.wrong(key, table.find(key)->value, "a thickness above 0");
    if (!error && measured.value == 0.0)
      reader.wrong(key, table.find(key)->value, "a number that is not 0, or its " + error_key);
    if (!error) continue;
    const auto given = read_number(reader, table, path, error_key, std::nullopt, diagnostics);
    if (!given) continue;
    const bool share = given->unit.dimension.dimensionless();
    measured.error = share ? given->si * std::abs(measured.value) : given->si;
    measured.error_known = true;
    if ((!share && given->unit.dimension != dimension) || !(measured.error > 0.0))
      reader.wrong(error_key, error->value,
                   "a standard error above 0: in the unit of the number, or \"2 %\" of it");
  }
  return any ? std::optional(cut) : std::nullopt;
}

} // namespace cnem::study
