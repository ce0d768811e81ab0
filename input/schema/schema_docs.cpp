// The case reference in Markdown.
#include "input/case.hpp"
#include "input/case_pairs.hpp"
#include "input/schema/schema.hpp"
#include "mechanics/field_catalogue.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>
#include <stdexcept>

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

/// A key that a kind of case needs, and what for.
struct Needed {
  const char *key, *why;
};

constexpr std::array blanking_needs{
    Needed{"let", "sheet, clearance, radius of edges: lengths that others follow from"},
    Needed{"time.end", "stroke over speed, and a little more"},
    Needed{"domain.material", "a metal of the library, `\"lib:304L\"`, or one of `materials`"},
    Needed{"domain.outer.rectangle", "the sheet; or `domain.drawing`, its drawing"},
    Needed{"domain.drawing.file", "a DXF; its layers name the sides"},
    Needed{"materials.*.damage", "when metal breaks; with `base = \"lib:NAME\"` for the rest"},
    Needed{"cloud.spacing", "a tenth of the thickness or so: bands are refined"},
    Needed{"boundary.*.symmetry", "the middle of half a sheet"},
    Needed{"tools.*.path", "punch, die and holder with `fillet` at their edges; or `tools.NAME.drawing`"},
    Needed{"tools.*.velocity", "of the punch, with a smooth ramp"},
    Needed{"tools.*.friction.coefficient", "between tools and sheet"},
    Needed{"tools.*.heat", "without it tools take no friction heat: edges are as hot as they can be"},
    Needed{"contact.deformable", "faces of a crack meet again"},
    Needed{"method.rereference.every", "steps between looks at the cloud"},
    Needed{"adapt.resample", "`true`; and `separate`, `cracks`, that it parts"},
    Needed{"adapt.tool_spacing", "half the radius of the edges"},
    Needed{"adapt.indicator.field", "`\"plastic_strain\"`, and `h_min`: the band"},
    Needed{"report.blanking", "force, work and faces in the report"},
    Needed{"output.fields_every", "frames of a film"},
    Needed{"output.pictures", "pictures of the report"},
    Needed{"output.windows.*.box", "the cut, enlarged"},
};

constexpr std::array cutting_needs{
    Needed{"cutting.feed", "uncut chip thickness"},
    Needed{"cutting.width", "of cut, for forces in N"},
    Needed{"cutting.rake", "and `clearance`: angles of the tool"},
    Needed{"cutting.edge_radius", "or a `chamfer`"},
    Needed{"cutting.speed", "of the tool"},
    Needed{"cutting.length", "of cut"},
    Needed{"cutting.friction", "between tool, chip and surface"},
    Needed{"domain.material", "a metal of the library, `\"lib:AA2024-T351\"`, or one of `materials`"},
    Needed{"materials.*.damage", "of metals whose chips have teeth"},
    Needed{"tools.*.heat", "of tools that grow warm"},
    Needed{"cutting.window", "`true`: the workpiece goes with the tool, for long cuts"},
    Needed{"report.cutting", "is there by itself"},
};

/// Where a page has a heading: letters, digits, '_' and '-' of it.
std::string anchor(const std::string& heading) {
  std::string text;
  for (const char c : heading)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-')
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The heading under which a key stands: its own table, else the one it belongs to.
std::string section_of(const Key& key) {
  return key.type == Type::table ? readable(key.path) : readable(key.parent());
}

std::string link_to(const std::string& heading, const std::string& words) {
  return fmt::format("[`{}`](#{})", words, anchor(heading));
}

std::string needs_table(std::span<const Needed> needs) {
  std::string text = "| key | for |\n| --- | --- |\n";
  for (const Needed& need : needs) {
    const Key* key = find_key(need.key);
    if (!key) throw std::logic_error(fmt::format("the contents name {}, which is no key", need.key));
    const std::string section = section_of(*key);
    const std::string words = readable(key->path);
    text += fmt::format("| {} | {} |\n",
                        section.empty() ? fmt::format("`{}`", words) : link_to(section, words), need.why);
  }
  return text;
}

bool belongs_to_outline(const Key& key) {
  for (const std::string_view at : {"domain.holes.*.", "tools.*."}) {
    if (!key.path.starts_with(at)) continue;
    const std::string twin = "domain.outer." + key.path.substr(at.size());
    return find_key(twin) != nullptr;
  }
  return false;
}

bool has_section(const Key& key) {
  return (key.type == Type::table || key.type == Type::table_list) && !belongs_to_outline(key);
}

/// What stands at the head of the reference.
std::string contents() {
  std::string text = "## Contents\n\n[Values](#values) · [A small case](#a-small-case) · "
                     "[Keys a blanking case needs](#keys-a-blanking-case-needs) · "
                     "[Keys a cut needs](#keys-a-cut-needs) · [Keys](#keys) · [Fields](#fields) · "
                     "[What cannot be asked for together](#what-cannot-be-asked-for-together)\n";
  std::string top;
  for (const Key& key : schema()) {
    if (!has_section(key)) continue;
    const std::string heading = readable(key.type == Type::table_list ? key.path + "[]" : key.path);
    const std::string first = heading.substr(0, heading.find('.'));
    text += first == top ? " · " : "\n- ";
    text += link_to(heading, heading);
    top = first;
  }
  return text + "\n";
}

std::string needed_keys() {
  return "\n## Keys a blanking case needs\n\nIn the order in which one writes them; "
         "`cases/blanking/sheet/case.toml` has most of them, [blanking](blanking.md) says more.\n\n" +
         needs_table(blanking_needs) +
         "\n## Keys a cut needs\n\n`cases/cutting/a2024_800/case.toml` has them, [cutting](cutting.md) says "
         "more.\n\n" +
         needs_table(cutting_needs) + "\n";
}

std::string kind(const Key& key) {
  std::string unit = key.quantity().si_unit;
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
  const Key* around = find_key(table.parent());
  if (table.family == Family::milling && (!around || around->family != Family::milling))
    return " In milling analyses only.";
  if (table.family == Family::structures && (!around || around->family != Family::structures))
    return " In analyses of parts and shafts alone.";
  if (table.family == Family::machining && (!around || around->family != Family::machining))
    return " In analyses of parts and shafts, and of milling, only.";
  if (!says_scope(table)) return "";
  return fmt::format(" {}: {}.",
                     table.scope == Scope::plane ? "Not in three-dimensional analyses"
                                                 : "In three-dimensional analyses only",
                     table.scope_reason);
}

std::string required_text(const Key& table) {
  if (table.presence != Presence::required) return "";
  const std::string where = table.free_in_space ? " in the plane" : "";
  return table.elsewhere.empty() ? fmt::format(" Required{}.", where)
                                 : fmt::format(" Required{}, or {}.", where, table.elsewhere);
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
  if (key.range.bounded())
    parts.push_back(fmt::format("Must be {}.", range_text(key.range, key.dimension, key.example)));
  if (!key.example.empty()) parts.push_back(fmt::format("E.g. `{}`.", key.example));
  return fmt::format("{}", fmt::join(parts, " "));
}

} // namespace

std::string case_reference() {
  std::string text(introduction);
  for (const Key& table : schema()) {
    const bool is_list = table.type == Type::table_list;
    if (!has_section(table)) continue;
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
  text.insert(introduction.size(), top);
  return text.insert(text.find("## Values\n"), contents() + needed_keys() + "\n");
}

} // namespace cnem::input
