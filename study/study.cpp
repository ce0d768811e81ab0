#include "study/study.hpp"

#include "core/error.hpp"
#include "input/case_reader.hpp"
#include "input/schema/diagnostics.hpp"
#include "input/schema/nearest.hpp"
#include "results/output_folder.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace cnem::study {
namespace fs = std::filesystem;
namespace {

using Kind = input::Value::Kind;

/// Reads the members of one table and remembers what was wrong with them.
class TableReader {
public:
  TableReader(const input::Value& table, std::string path, std::vector<std::string> known,
              input::Diagnostics& diagnostics)
      : table_(table), path_(std::move(path)), diagnostics_(diagnostics) {
    for (const input::Member& member : table_.members)
      if (std::find(known.begin(), known.end(), member.key) == known.end())
        diagnostics_.add(input::Mistake::unknown_key, member.where, path_ + member.key,
                         fmt::format("unknown key, expected one of {}{}", fmt::join(known, ", "),
                                     input::did_you_mean(member.key, known)));
  }

  const input::Value* find(const std::string& key, Kind kind, const std::string& expected) {
    const input::Member* member = table_.find(key);
    if (!member) return nullptr;
    if (member->value.kind == kind) return &member->value;
    wrong(key, member->value, expected);
    return nullptr;
  }
  const input::Value* require(const std::string& key, Kind kind, const std::string& expected) {
    if (!table_.find(key))
      diagnostics_.add(input::Mistake::missing_key, table_.where, path_ + key,
                       "missing, expected " + expected);
    return find(key, kind, expected);
  }
  std::string text(const std::string& key) {
    const input::Value* value = find(key, Kind::text, "a text");
    return value ? value->text : "";
  }
  int count(const std::string& key, int fallback) {
    const input::Member* member = table_.find(key);
    if (!member) return fallback;
    const std::optional<std::int64_t> number = member->value.whole_number();
    if (number && *number >= 1 && *number <= 4096) return static_cast<int>(*number);
    wrong(key, member->value, "a whole number from 1 to 4096");
    return fallback;
  }
  std::vector<std::string> texts(const std::string& key) {
    std::vector<std::string> list;
    const input::Value* value = find(key, Kind::array, "a list of texts");
    if (!value) return list;
    for (const input::Value& element : value->elements) {
      if (element.kind == Kind::text)
        list.push_back(element.text);
      else
        wrong(key, element, "texts in the list");
    }
    return list;
  }
  void wrong(const std::string& key, const input::Value& value, const std::string& expected) {
    diagnostics_.add(input::Mistake::type, value.where, path_ + key,
                     fmt::format("found {}, expected {}", value.show(), expected));
  }

private:
  const input::Value& table_;
  std::string path_;
  input::Diagnostics& diagnostics_;
};

/// The part of each key that tells it from the others: "angle" for domain.cracks.main.rotate.angle.
std::vector<std::string> short_names(const std::vector<std::string>& keys) {
  const auto tail = [](const std::string& key, int parts) {
    std::size_t at = key.size();
    for (; parts > 0 && at != std::string::npos && at > 0; --parts) at = key.rfind('.', at - 1);
    return at == std::string::npos || at == 0 ? key : key.substr(at + 1);
  };
  std::vector<std::string> names;
  for (const std::string& key : keys) {
    int parts = 1;
    const auto shared = [&](const std::string& other) {
      return other != key && tail(other, parts) == tail(key, parts);
    };
    while (tail(key, parts) != key && std::any_of(keys.begin(), keys.end(), shared)) ++parts;
    names.push_back(tail(key, parts));
  }
  return names;
}

std::vector<input::Override> read_set(const input::Value& table, const std::string& path,
                                      input::Diagnostics& diagnostics) {
  std::vector<input::Override> list;
  for (const input::Member& member : table.members) {
    if (member.value.kind == Kind::table && member.key.find('.') == std::string::npos)
      diagnostics.add(
          input::Mistake::type, member.where, path + member.key,
          "found a table, expected a key of the case in quotes, such as \"cloud.spacing\" = \"0.1 mm\"");
    list.push_back({member.key, member.value, member.where});
  }
  return list;
}

struct GridAxis {
  const input::Member* member;
  std::string name;
};

/// Part of the name of a run.
std::string name_of(const GridAxis& axis, const input::Value& value) {
  return file_name(axis.name + "_" + plain_text(value));
}

/// Values that make one name for two runs: "0.1 mm" and "0.1_mm".
void check_values(const GridAxis& axis, input::Diagnostics& diagnostics) {
  std::map<std::string, const input::Value*> first;
  for (const input::Value& value : axis.member->value.elements)
    if (const auto [other, fresh] = first.emplace(name_of(axis, value), &value); !fresh)
      diagnostics.add(input::Mistake::conflict, value.where, "grid." + axis.member->key,
                      fmt::format("found {} after {} at {}, which makes two runs named '{}', expected "
                                  "different values",
                                  value.show(), other->second->show(), other->second->where.text(),
                                  other->first));
}

std::vector<StudyRun> expand_grid(const std::vector<GridAxis>& axes,
                                  const std::vector<input::Override>& common) {
  std::vector<StudyRun> runs(1);
  runs.front().common = common;
  for (const GridAxis& axis : axes) {
    std::vector<StudyRun> finer;
    for (const StudyRun& run : runs)
      for (const input::Value& value : axis.member->value.elements) {
        StudyRun next = run;
        if (!next.name.empty()) next.name += '-';
        next.name += name_of(axis, value);
        next.own.push_back({axis.member->key, value, value.where});
        next.where = value.where;
        finer.push_back(std::move(next));
      }
    runs = std::move(finer);
  }
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (runs[k].name.size() > input::longest_name)
      runs[k].name = fmt::format("{}_{}", runs[k].name.substr(0, input::longest_name), k + 1);
  return runs;
}

std::vector<StudyRun> read_grid(const input::Value& grid, const std::vector<input::Override>& common,
                                Study& study, input::Diagnostics& diagnostics) {
  constexpr std::size_t most_runs = 100000;
  std::vector<GridAxis> axes;
  std::size_t count = 1;
  for (const input::Member& member : grid.members) {
    if (member.value.kind != Kind::array || member.value.elements.empty())
      diagnostics.add(input::Mistake::type, member.where, "grid." + member.key,
                      fmt::format("found {}, expected a key of the case in quotes and a list of its values, "
                                  "such as \"cloud.spacing\" = [\"0.2 mm\", \"0.1 mm\"]",
                                  member.value.show()));
    count = std::min(most_runs + 1, count * std::max<std::size_t>(1, member.value.elements.size()));
    study.keys.push_back(member.key);
    axes.push_back({&member, ""});
  }
  if (axes.empty())
    diagnostics.add(input::Mistake::missing_key, grid.where, "grid", "empty, expected keys of the case");
  if (count > most_runs)
    diagnostics.add(input::Mistake::range, grid.where, "grid",
                    fmt::format("found more than {0} runs, expected at most {0}", most_runs));
  diagnostics.throw_if_any();
  const std::vector<std::string> names = short_names(study.keys);
  for (std::size_t k = 0; k < axes.size(); ++k) axes[k].name = names[k];
  for (const GridAxis& axis : axes) check_values(axis, diagnostics);
  diagnostics.throw_if_any();
  return expand_grid(axes, common);
}

std::vector<StudyRun> read_runs(const input::Value& list, const std::vector<input::Override>& common,
                                Study& study, input::Diagnostics& diagnostics) {
  std::vector<StudyRun> runs;
  for (const input::Value& entry : list.elements) {
    if (entry.kind != Kind::table) {
      diagnostics.add(input::Mistake::type, entry.where, "run",
                      fmt::format("found {}, expected a table [[run]]", entry.show()));
      continue;
    }
    TableReader table(entry, "run.", {"name", "set"}, diagnostics);
    StudyRun run{"", entry.where, common, {}};
    if (const input::Value* name = table.require("name", Kind::text, "a name for the folder of the run")) {
      run.name = name->text;
      run.where = name->where;
      if (run.name.empty() || run.name != file_name(run.name) || run.name.front() == '.' ||
          run.name.size() > input::longest_name)
        table.wrong("name", *name, "letters, digits and _ - + . only, as the name of a folder");
    }
    if (const input::Value* set = table.find("set", Kind::table, "a table of keys of the case in quotes"))
      run.own = read_set(*set, "run.set.", diagnostics);
    for (const input::Override& change : run.own)
      if (std::find(study.keys.begin(), study.keys.end(), change.key) == study.keys.end())
        study.keys.push_back(change.key);
    runs.push_back(std::move(run));
  }
  if (runs.empty())
    diagnostics.add(input::Mistake::missing_key, list.where, "run", "empty, expected tables [[run]]");
  return runs;
}

/// Runs of one name would share a folder, and files of the study lie beside the folders.
void check_names(const Study& study, const std::string& key, input::Diagnostics& diagnostics) {
  std::map<std::string_view, const StudyRun*> first;
  for (const StudyRun& run : study.runs) {
    for (const char* own : {".csv", ".html", ".json", ".log"})
      if (run.name.ends_with(own))
        diagnostics.add(
            input::Mistake::conflict, run.where, key,
            fmt::format("found a run named '{}', expected a name that does not end with {}: files of "
                        "the study do",
                        run.name, own));
    if (const auto [other, fresh] = first.emplace(run.name, &run); !fresh)
      diagnostics.add(input::Mistake::conflict, run.where, key,
                      fmt::format("found two runs named '{}', the other one at {}, expected different ones",
                                  run.name, other->second->where.text()));
  }
}

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

/// Values of a key along an axis: numbers of one unit.
void check_axis(const Study& study, const StudyChart& chart, input::Diagnostics& diagnostics) {
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
    if (table.require("y", Kind::array, "a list of columns")) chart.y = table.texts("y");
    if (const input::Value* value = table.find("extrapolate", Kind::boolean, "true or false"))
      chart.extrapolate = value->boolean;
    if (!chart.x.empty()) check_column(chart.x, entry.where, "charts.x", study.keys, diagnostics);
    for (const std::string& column : chart.y) check_column(column, entry.where, "charts.y", {}, diagnostics);
    check_axis(study, chart, diagnostics);
    study.charts.push_back(std::move(chart));
  }
}

} // namespace

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

Study read_study_text(std::string_view text, const fs::path& path) {
  const input::Value root = input::parse_document(text, path.string());
  input::Diagnostics diagnostics;
  TableReader table(
      root, "",
      {"title", "case", "set", "grid", "run", "processes", "threads", "columns", "charts", "history"},
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
  std::vector<input::Override> common;
  if (const input::Value* set = table.find("set", Kind::table, "a table of keys of the case in quotes"))
    common = read_set(*set, "set.", diagnostics);
  const input::Value* grid = table.find("grid", Kind::table, "a table of keys of the case in quotes");
  const input::Value* runs = table.find("run", Kind::array, "tables [[run]]");
  study.processes = table.count("processes", 0);
  study.threads = table.count("threads", 1);
  study.columns = table.texts("columns");
  study.history = table.texts("history");
  for (const std::string& column : study.columns)
    check_column(column, root.find("columns")->where, "columns", {}, diagnostics);
  if (grid && runs)
    diagnostics.add(input::Mistake::conflict, runs->where, "run",
                    "found [grid] and [[run]], expected one of them");
  if (!root.find("grid") && !root.find("run"))
    diagnostics.add(input::Mistake::missing_key, root.where, "grid", "missing, expected [grid] or [[run]]");
  diagnostics.throw_if_any();
  study.runs =
      grid ? read_grid(*grid, common, study, diagnostics) : read_runs(*runs, common, study, diagnostics);
  check_names(study, grid ? "grid" : "run.name", diagnostics);
  if (const input::Value* charts = table.find("charts", Kind::array, "a list of tables with x and y"))
    read_charts(*charts, study, diagnostics);
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
  if (first != std::string::npos) unit = tail.substr(first);
  return unit.find_first_of("0123456789+-.") != 0; // "0 -11 m/s" is a vector
}

} // namespace cnem::study
