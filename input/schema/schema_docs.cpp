// The case reference in Markdown.
#include "input/case.hpp"
#include "input/case_pairs.hpp"
#include "input/schema/schema.hpp"
#include "mechanics/field_catalogue.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::input {
namespace {

constexpr std::string_view introduction = R"md(# Case reference

<!-- Generated from input/keys/*.cpp by `cnem schema --markdown`. -->

A case is one [TOML](https://toml.io) file. Keys that are not listed here are errors, and so are values of the
wrong dimension. Anything can be overridden on the command line: `--set time.end="3 us"`,
`--set tools.punch.path[1].fillet="0.5 mm"` (list elements count from 0).

## Values

| kind | how it is written |
| --- | --- |
| quantity | a text with number and unit, `"11 m/s"`; numbers without dimension stand alone, `0.3` |
| vector | two numbers, in three-dimensional analyses three, and one unit, `"20 10 mm"`, or `["20 mm", "10 mm"]` |
| values | several numbers and one unit, `"2 4 us"`, or `["2 us", "4 us"]` |
| function | a quantity (constant in time), `{ value = "11 m/s", ramp = "1 us" }` (linear from 0, or from `from`, then constant; with `smooth = true` without kinks, for loads that must not set the body swinging), or `{ times = "0 1 5 us", values = "0 11 0 m/s" }` (linear between, constant outside) |
| vector function | a vector, the same tables with vectors, or `{ x = function, y = function }`, of which one may be left out |
| expression | wherever a quantity, a number or a whole number stands: `"0.08 * sheet"`, `"max(gap, 0.1 mm)"`, of variables of `[let]` and of numbers with units; components of vectors in an array, `["gap", "-1.5 * sheet"]`, or with commas, `"gap, -1.5 * sheet"` ([variables](user_guide.md#variables)) |
| name | at most 100 letters, digits, `_` and `-` |

Units are products, quotients and powers of m, g, t, s, min, h, K, N, Pa, bar, J, W, Hz, rad, deg, rev, rpm, %
with the prefixes n, u (µ), m, c, d, k, M, G: `kg/m3`, `W/(m K)`, `mm/us`, `1/s`, `s^0.5`. After a slash a product
needs parentheses. `degC` stands for an absolute temperature and cannot be part of another unit.

Plane models have unit thickness: forces are per metre of it. Axisymmetric ones are whole bodies, x the radius and y
the axis. x points right, y up, z to the reader; angles and rotations count counter-clockwise.

## A small case

```toml
title = "A steel block between two plates"

[time]
end = "20 us"

[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "10 5 mm" }

[cloud]
spacing = "0.25 mm"

[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "linear", yield = "400 MPa", hardening = "1 GPa" }

[boundary.middle]
pieces = "left"
symmetry = true

[boundary.bed]
pieces = "bottom"
velocity = { y = "0 m/s" }

[tools.plate]
rectangle = { from = "-1 5 mm", to = "12 7 mm" }
velocity = { y = { value = "-5 m/s", ramp = "2 us" } }
friction = { law = "coulomb", coefficient = 0.1 }
```

## Keys

Members of an outline (`domain.outer`, `domain.holes.NAME`, `tools.NAME`) are listed once, under `domain.outer`.
)md";

bool belongs_to_outline(const Key& key) {
  for (const std::string_view at : {"domain.holes.*.", "tools.*."}) {
    if (!key.path.starts_with(at)) continue;
    const std::string twin = "domain.outer." + key.path.substr(at.size());
    return find_key(twin) != nullptr;
  }
  return false;
}

std::string kind(const Key& key) {
  std::string unit = describe(key.dimension).si_unit;
  if (key.revolution) unit += fmt::format(" (axisymmetric: {})", describe(*key.revolution).si_unit);
  switch (key.type) {
  case Type::table:
    return "table";
  case Type::named_tables:
    return "tables by name";
  case Type::table_list:
    return "array of tables";
  case Type::variables:
    return "quantities and expressions by name";
  case Type::quantity:
    return key.dimension.dimensionless() ? "number" : unit;
  case Type::integer:
    return "whole number";
  case Type::boolean:
    return "true or false";
  case Type::text:
    return "text";
  case Type::choice:
    return fmt::format("`{}`", fmt::join(key.choices, "`, `"));
  case Type::texts:
    return "text or array of texts";
  case Type::choices:
    return fmt::format("array of `{}`", fmt::join(key.choices, "`, `"));
  case Type::vector:
    return "vector, " + unit;
  case Type::vectors:
    return "array of vectors, " + unit;
  case Type::quantities:
    return "values, " + unit;
  case Type::function:
    return "function, " + unit;
  case Type::vector_function:
    return "vector function, " + unit;
  }
  return "";
}

/// Whether the tables around a key leave its scope to be said.
bool says_scope(const Key& key) {
  if (key.scope == Scope::everywhere) return false;
  for (std::string at = key.path; !at.empty();) {
    const auto cut = at.find_last_of(".[");
    at.resize(cut == std::string::npos ? 0 : cut);
    if (const Key* table = find_key(at); table && table->scope == key.scope) return false;
  }
  return true;
}

/// Of a table whose keys have a meaning in the plane or in space alone, with the reason.
std::string scope_of(const Key& table) {
  if (!says_scope(table)) return "";
  return fmt::format(" {}: {}.",
                     table.scope == Scope::plane ? "Not in three-dimensional analyses"
                                                 : "In three-dimensional analyses only",
                     table.scope_reason);
}

std::string required_text(const Key& table) {
  if (table.presence != Presence::required) return "";
  return table.elsewhere.empty() ? " Required." : fmt::format(" Required, or {}.", table.elsewhere);
}

std::string default_text(const Key& key) {
  if (key.presence == Presence::required) return "**required**";
  if (!key.fallback.empty()) return fmt::format("`{}`", key.fallback);
  return key.computed.empty() ? "–" : key.computed;
}

std::string meaning(const Key& key) {
  std::vector<std::string> parts;
  if (!key.doc.empty()) parts.push_back(key.doc);
  if (says_scope(key))
    parts.push_back(key.scope == Scope::plane ? "Not in three-dimensional analyses."
                                              : "Three-dimensional analyses only.");
  if (!key.when.sibling.empty())
    parts.push_back(fmt::format("With `{}` = `{}`.", key.when.sibling, fmt::join(key.when.values, "` or `")));
  if (key.range.bounded()) parts.push_back(fmt::format("Must be {}.", range_text(key.range, key.dimension)));
  if (!key.example.empty()) parts.push_back(fmt::format("E.g. `{}`.", key.example));
  return fmt::format("{}", fmt::join(parts, " "));
}

} // namespace

std::string case_reference() {
  std::string text(introduction);
  for (const Key& table : schema()) {
    const bool is_list = table.type == Type::table_list;
    if ((table.type != Type::table && !is_list) || belongs_to_outline(table)) continue;
    const std::string pattern = is_list ? table.path + "[]" : table.path;
    text += fmt::format("\n### `{}`\n\n{}{}{}\n", readable(pattern), is_list ? "A piece." : table.doc,
                        required_text(table), scope_of(table));
    std::string rows;
    for (const Key* key : members_of(pattern)) {
      if (belongs_to_outline(*key) || key->type == Type::table || key->type == Type::named_tables) continue;
      rows += fmt::format("| `{}` | {} | {} | {} |\n", key->name(), kind(*key), default_text(*key),
                          meaning(*key));
    }
    if (!rows.empty()) text += "\n| key | value | default | meaning |\n| --- | --- | --- | --- |\n" + rows;
  }
  text += "\n## Fields\n\n| name | unit | meaning |\n| --- | --- | --- |\n";
  const std::vector<std::string> in_plane = field_names(2);
  for (const FieldInfo<3>& field : field_catalogue<3>()) {
    const bool everywhere = std::find(in_plane.begin(), in_plane.end(), field.name) != in_plane.end();
    text += fmt::format("| `{}` | {} | {}{} |\n", field.name, field.unit.empty() ? "1" : field.unit,
                        field.shown.meaning, everywhere ? "" : " (three-dimensional analyses)");
  }
  text += "\n## What cannot be asked for together\n\n";
  text += pairs_table();
  std::string top;
  for (const Key* key : members_of(""))
    if (key->type != Type::table && key->type != Type::named_tables)
      top += fmt::format("\nAt the top, `{}`: {}\n", key->name(), key->doc);
  return text.insert(introduction.size(), top);
}

} // namespace cnem::input
