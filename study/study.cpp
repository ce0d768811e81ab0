#include "study/study.hpp"

#include "core/error.hpp"
#include "input/case_reader.hpp"
#include "input/schema/nearest.hpp"
#include "input/schema/units.hpp"
#include "results/output_folder.hpp"
#include "study/study_parts.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace cnem::study {
namespace fs = std::filesystem;
namespace {

using Kind = input::Value::Kind;

/// Values of a key along an axis: numbers of one unit. Variables have values of their own.
void check_axis(const Study& study, const StudyChart& chart, input::Diagnostics& diagnostics) {
  if (is_variable(chart.x)) return;
  std::string first_unit;
  bool first = true;
  for (const StudyRun& run : study.runs) {
    const input::Value* value = run.find(chart.x);
    double number = 0.0;
    std::string unit;
    if (!value) continue;
    if (split_number(*value, number, unit) && (first || unit == first_unit)) {
      first_unit = unit;
      first = false;
      continue;
    }
    diagnostics.add(input::Mistake::type, value->where, chart.x,
                    fmt::format("found {}, expected {}, because charts.x names this key", value->show(),
                                first ? "a number" : fmt::format("a number with unit '{}'", first_unit)));
    return;
  }
}

/// Columns over time, or over another: "energy.elastic", { x = "punch.stroke", y = "punch.force_y" }.
void read_history(const input::Value& list, Study& study, input::Diagnostics& diagnostics) {
  for (const input::Value& entry : list.elements) {
    if (entry.kind == Kind::text) {
      study.history.push_back({"time", entry.text});
      continue;
    }
    if (entry.kind != Kind::table) {
      diagnostics.add(
          input::Mistake::type, entry.where, "history",
          fmt::format("found {}, expected texts in the list, or tables with x and y", entry.show()));
      continue;
    }
    TableReader table(entry, "history.", {"x", "y"}, diagnostics);
    for (const char* key : {"x", "y"}) table.require(key, Kind::text, "a column of history.csv");
    study.history.push_back({table.text("x"), table.text("y")});
  }
}

void read_charts(const input::Value& list, Study& study, input::Diagnostics& diagnostics) {
  for (const input::Value& entry : list.elements) {
    if (entry.kind != Kind::table) {
      diagnostics.add(input::Mistake::type, entry.where, "charts",
                      fmt::format("found {}, expected tables with x and y", entry.show()));
      continue;
    }
    TableReader table(entry, "charts.", {"x", "y", "extrapolate"}, diagnostics);
    StudyChart chart;
    chart.where = entry.where;
    if (table.require("x", Kind::text, "a key of the grid or a column")) chart.x = table.text("x");
    if (const StudyAxis* axis = study.axis_of(chart.x)) chart.x = axis->of(chart.x);
    if (table.require("y", Kind::array, "a list of columns")) chart.y = table.texts("y");
    if (const input::Value* value = table.find("extrapolate", Kind::boolean, "true or false"))
      chart.extrapolate = value->boolean;
    if (!chart.x.empty() && !is_variable(chart.x))
      check_column(chart.x, entry.where, "charts.x", study.keys, diagnostics);
    for (const std::string& column : chart.y) check_column(column, entry.where, "charts.y", {}, diagnostics);
    check_axis(study, chart, diagnostics);
    study.charts.push_back(std::move(chart));
  }
}

} // namespace

void check_column(const std::string& name, const input::Location& where, const std::string& key,
                  std::vector<std::string> also, input::Diagnostics& diagnostics) {
  if ((name.starts_with("metrics.") && name.size() > 8) || (name.starts_with("wall_s.") && name.size() > 7))
    return;
  also.insert(also.end(), {"nodes", "points", "steps", "node_steps", "time", "energy_residual", "cpu_s",
                           "peak_rss_bytes", "metrics.NAME", "wall_s.NAME"});
  if (std::find(also.begin(), also.end(), name) != also.end() && !name.ends_with(".NAME")) return;
  diagnostics.add(input::Mistake::reference, where, key,
                  fmt::format("found '{}', expected a number of status.json such as nodes or "
                              "metrics.strain_energy{}",
                              name, input::did_you_mean(name, also)));
}

std::vector<input::Override> StudyRun::changes() const {
  std::vector<input::Override> all = common;
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

const input::Value* StudyRun::find(const std::string& key) const {
  const auto found =
      std::find_if(own.begin(), own.end(), [&](const input::Override& o) { return o.key == key; });
  return found == own.end() ? nullptr : &found->value;
}

const std::string& StudyAxis::of(const std::string& name_or_key) const {
  return name_or_key == name ? keys.front() : name_or_key;
}

const StudyAxis* Study::axis_of(const std::string& name_or_key) const {
  const auto found = std::find_if(axes.begin(), axes.end(), [&](const StudyAxis& axis) {
    return axis.name == name_or_key ||
           std::find(axis.keys.begin(), axis.keys.end(), name_or_key) != axis.keys.end();
  });
  return found == axes.end() ? nullptr : &*found;
}

bool is_variable(std::string_view key) { return key.starts_with("let."); }

Study read_study_text(std::string_view text, const fs::path& path) {
  const input::Value root = input::parse_document(text, path.string());
  input::Diagnostics diagnostics;
  TableReader table(root, "",
                    {"title", "case", "set", "grid", "axis", "run", "processes", "threads", "columns",
                     "charts", "history", "laminate"},
                    diagnostics);
  Study study;
  study.name = input::name_after(path, "study");
  study.text = text;
  study.title = table.text("title");
  if (const input::Value* name = table.require("case", Kind::text, "the case file or its folder")) {
    study.case_file = (path.parent_path() / name->text).lexically_normal();
    if (fs::is_directory(study.case_file)) study.case_file /= "case.toml";
    if (!fs::exists(study.case_file))
      diagnostics.add(input::Mistake::reference, name->where, "case",
                      fmt::format("there is no file {}, expected a case file or its folder, seen from the "
                                  "folder of the study",
                                  study.case_file.string()));
  }
  study.processes = table.count("processes", 0);
  study.threads = table.count("threads", 1);
  study.columns = table.texts("columns");
  if (const input::Value* history = table.find("history", Kind::array, "a list of columns of histories"))
    read_history(*history, study, diagnostics);
  for (const std::string& column : study.columns)
    check_column(column, root.find("columns")->where, "columns", {}, diagnostics);
  read_runs(root, table, study, diagnostics);
  if (const input::Value* charts = table.find("charts", Kind::array, "a list of tables with x and y"))
    read_charts(*charts, study, diagnostics);
  if (const input::Value* laminate = table.find("laminate", Kind::table, "a table with angle and plies"))
    study.laminate = read_laminate(*laminate, study, diagnostics);
  diagnostics.throw_if_any();
  return study;
}

Study read_study(const fs::path& path) {
  const fs::path file = fs::is_directory(path) ? path / "study.toml" : path;
  if (!fs::exists(file))
    throw InputError(fmt::format("{}: no such file, expected a study such as study.toml", file.string()));
  return read_study_text(results::read_file(file), file);
}

std::string plain_text(const input::Value& value) {
  return value.kind == Kind::text ? value.text : input::toml_text(value);
}

std::string file_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '_' || c == '-' || c == '+' || c == '.';
    if (plain || name.empty() || name.back() != '_') name += plain ? c : '_';
  }
  while (name.size() > 1 && name.back() == '_') name.pop_back();
  return name;
}

bool split_number(const input::Value& value, double& number, std::string& unit) {
  unit.clear();
  if (value.kind == Kind::integer || value.kind == Kind::real) {
    number = value.kind == Kind::integer ? static_cast<double>(value.integer) : value.real;
    return true;
  }
  if (value.kind != Kind::text) return false;
  const char *from = value.text.data(), *end = from + value.text.size();
  if (from != end && *from == '+') ++from;
  const auto [rest, error] = std::from_chars(from, end, number);
  if (error != std::errc{}) return false;
  const std::string tail(rest, end);
  const auto first = tail.find_first_not_of(' ');
  if (first == std::string::npos) return true;
  unit = tail.substr(first);
  try {
    input::parse_unit(unit);
    return true;
  } catch (const input::UnitError&) { return false; } // "0 -11 m/s" is a vector, "2 * sheet" an expression
}

bool same_value(const input::Value& a, const input::Value& b) {
  if (plain_text(a) == plain_text(b)) return true;
  if (a.kind == Kind::array && b.kind == Kind::array)
    return std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end(), same_value);
  double x = 0.0, y = 0.0;
  std::string x_unit, y_unit;
  if (!split_number(a, x, x_unit) || !split_number(b, y, y_unit)) return false;
  const auto unit_of = [](const std::string& text) {
    return text.empty() ? input::Unit{} : input::parse_unit(text);
  };
  const input::Unit of_x = unit_of(x_unit), of_y = unit_of(y_unit);
  if (of_x.dimension != of_y.dimension) return false;
  constexpr double slack = 1e-12; // what conversions round
  x = of_x.to_si(x), y = of_y.to_si(y);
  return std::abs(x - y) <= slack * std::max(std::abs(x), std::abs(y));
}

} // namespace cnem::study
