// The list of runs of a study.
#include "study/study_parts.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace cnem::study {
namespace {

using Kind = input::Value::Kind;

constexpr std::size_t most_runs = 100000;

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

/// Keys whose lists of values are gone through together.
struct ListedAxis {
  std::string path; ///< of the lists, for messages
  std::string name; ///< in names of runs
  std::vector<const input::Member*> lists;

  std::size_t size() const { return lists.front()->value.elements.size(); }
  const input::Value& leading(std::size_t k) const { return lists.front()->value.elements[k]; }
  /// Part of the name of a run.
  std::string name_of(std::size_t k) const { return file_name(name + "_" + plain_text(leading(k))); }
};

bool is_list(const input::Member& member, const std::string& path, input::Diagnostics& diagnostics) {
  if (member.value.kind == Kind::array && !member.value.elements.empty()) return true;
  diagnostics.add(input::Mistake::type, member.where, path + member.key,
                  fmt::format("found {}, expected a key of the case in quotes and a list of its values, "
                              "such as \"cloud.spacing\" = [\"0.2 mm\", \"0.1 mm\"]",
                              member.value.show()));
  return false;
}

/// Each key of [grid] on an axis of its own.
std::vector<ListedAxis> read_grid(const input::Value& grid, input::Diagnostics& diagnostics) {
  std::vector<ListedAxis> axes;
  std::vector<std::string> keys;
  for (const input::Member& member : grid.members) {
    if (is_list(member, "grid.", diagnostics)) axes.push_back({"grid." + member.key, "", {&member}});
    keys.push_back(member.key);
  }
  if (keys.empty())
    diagnostics.add(input::Mistake::missing_key, grid.where, "grid", "empty, expected keys of the case");
  diagnostics.throw_if_any();
  const std::vector<std::string> names = short_names(keys);
  for (std::size_t k = 0; k < axes.size(); ++k) axes[k].name = names[k];
  return axes;
}

/// The keys of an [[axis]] on one together.
ListedAxis read_axis(const input::Value& entry, input::Diagnostics& diagnostics) {
  ListedAxis axis{"axis.set", "", {}};
  if (entry.kind != Kind::table) {
    diagnostics.add(input::Mistake::type, entry.where, "axis",
                    fmt::format("found {}, expected a table [[axis]]", entry.show()));
    return axis;
  }
  TableReader table(entry, "axis.", {"name", "set"}, diagnostics);
  if (const input::Value* name = table.require("name", Kind::text, "a name of the axis")) {
    axis.name = name->text;
    if (axis.name.empty()) table.wrong("name", *name, "a name of the axis");
  }
  const input::Value* set = table.require("set", Kind::table, "a table of keys of the case and their values");
  if (!set) return axis;
  if (set->members.empty())
    diagnostics.add(input::Mistake::missing_key, set->where, "axis.set", "empty, expected keys of the case");
  for (const input::Member& member : set->members) {
    if (!is_list(member, "axis.set.", diagnostics)) continue;
    axis.lists.push_back(&member);
    if (member.value.elements.size() != axis.size())
      diagnostics.add(input::Mistake::conflict, member.value.where, "axis.set." + member.key,
                      fmt::format("found {} values, expected {} as of '{}', which changes with it",
                                  member.value.elements.size(), axis.size(), axis.lists.front()->key));
  }
  return axis;
}

/// Values that make one name for two runs: "0.1 mm" and "0.1_mm".
void check_values(const ListedAxis& axis, input::Diagnostics& diagnostics) {
  std::map<std::string, const input::Value*> first;
  for (std::size_t k = 0; k < axis.size(); ++k) {
    const input::Value& value = axis.leading(k);
    if (const auto [other, fresh] = first.emplace(axis.name_of(k), &value); !fresh)
      diagnostics.add(input::Mistake::conflict, value.where, axis.path,
                      fmt::format("found {} after {} at {}, which makes two runs named '{}', expected "
                                  "different values",
                                  value.show(), other->second->show(), other->second->where.text(),
                                  other->first));
  }
}

std::vector<StudyRun> expand(const std::vector<ListedAxis>& axes,
                             const std::vector<input::Override>& common) {
  std::vector<StudyRun> runs(1);
  runs.front().common = common;
  for (const ListedAxis& axis : axes) {
    std::vector<StudyRun> finer;
    for (const StudyRun& run : runs)
      for (std::size_t k = 0; k < axis.size(); ++k) {
        StudyRun next = run;
        if (!next.name.empty()) next.name += '-';
        next.name += axis.name_of(k);
        for (const input::Member* list : axis.lists) {
          const input::Value& value = list->value.elements[k];
          next.own.push_back({list->key, value, value.where});
        }
        next.where = axis.leading(k).where;
        finer.push_back(std::move(next));
      }
    runs = std::move(finer);
  }
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (runs[k].name.size() > input::longest_name)
      runs[k].name = fmt::format("{}_{}", runs[k].name.substr(0, input::longest_name), k + 1);
  return runs;
}

/// The Cartesian product of all axes, of which the first varies slowest.
std::vector<StudyRun> read_product(const input::Value* grid, const input::Value* linked,
                                   const std::vector<input::Override>& common, Study& study,
                                   input::Diagnostics& diagnostics) {
  std::vector<ListedAxis> axes;
  if (grid) axes = read_grid(*grid, diagnostics);
  if (linked && linked->elements.empty())
    diagnostics.add(input::Mistake::missing_key, linked->where, "axis", "empty, expected tables [[axis]]");
  if (linked)
    for (const input::Value& entry : linked->elements) axes.push_back(read_axis(entry, diagnostics));
  diagnostics.throw_if_any();
  std::size_t count = 1;
  for (const ListedAxis& axis : axes) {
    count = std::min(most_runs + 1, count * axis.size());
    if (std::any_of(study.axes.begin(), study.axes.end(),
                    [&](const StudyAxis& known) { return known.name == axis.name; }))
      diagnostics.add(input::Mistake::conflict, axis.leading(0).where, axis.path,
                      fmt::format("found two axes named '{}', expected a name for each", axis.name));
    study.axes.push_back({axis.name, {}});
    for (const input::Member* list : axis.lists) {
      if (std::find(study.keys.begin(), study.keys.end(), list->key) != study.keys.end())
        diagnostics.add(input::Mistake::conflict, list->where, axis.path,
                        fmt::format("found '{}' on two axes, expected it on one", list->key));
      study.keys.push_back(list->key);
      study.axes.back().keys.push_back(list->key);
    }
    check_values(axis, diagnostics);
  }
  if (count > most_runs)
    diagnostics.add(input::Mistake::range, grid ? grid->where : linked->where, grid ? "grid" : "axis",
                    fmt::format("found more than {0} runs, expected at most {0}", most_runs));
  diagnostics.throw_if_any();
  return expand(axes, common);
}

std::vector<StudyRun> read_list(const input::Value& list, const std::vector<input::Override>& common,
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
  for (const std::string& key : study.keys) study.axes.push_back({key.substr(key.rfind('.') + 1), {key}});
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

} // namespace

void read_runs(const input::Value& root, TableReader& table, Study& study, input::Diagnostics& diagnostics) {
  const std::string of_keys = "a table of keys of the case in quotes";
  std::vector<input::Override> common;
  if (const input::Value* set = table.find("set", Kind::table, of_keys))
    common = read_set(*set, "set.", diagnostics);
  const input::Value* grid = table.find("grid", Kind::table, of_keys);
  const input::Value* linked = table.find("axis", Kind::array, "tables [[axis]]");
  const input::Value* list = table.find("run", Kind::array, "tables [[run]]");
  if ((grid || linked) && list)
    diagnostics.add(input::Mistake::conflict, list->where, "run",
                    fmt::format("found {} and [[run]], expected one of them", grid ? "[grid]" : "[[axis]]"));
  if (!root.find("grid") && !root.find("run") && !root.find("axis"))
    diagnostics.add(input::Mistake::missing_key, root.where, "grid",
                    "missing, expected [grid], [[axis]] or [[run]]");
  diagnostics.throw_if_any();
  study.runs = list ? read_list(*list, common, study, diagnostics)
                    : read_product(grid, linked, common, study, diagnostics);
  check_names(study, list ? "run.name" : grid ? "grid" : "axis", diagnostics);
}

} // namespace cnem::study
