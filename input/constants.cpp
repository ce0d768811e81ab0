#include "input/constants.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdexcept>
#include <tuple>

namespace cnem::input {
namespace {

/// A value as a case has it: 0.5, "210 GPa", "1 /s".
std::string toml(std::string_view number, std::string_view unit) {
  if (unit.empty()) return std::string(number);
  return fmt::format("\"{} {}\"", number, unit.starts_with("1/") ? unit.substr(1) : unit);
}

/// Whether a key can stand for both.
bool same(const ConstantText& a, const ConstantText& b) {
  const auto known = [](const ConstantText& c) {
    return std::tuple(std::string_view(c.info.unit), c.info.range.low, c.info.range.high,
                      c.info.range.low_open, c.info.range.high_open, c.info.required,
                      c.info.required ? 0.0 : c.initial, c.list);
  };
  return known(a) == known(b);
}

std::string value_text(const Setting& setting) {
  const double value = std::get<double>(setting.value);
  const Dimension& dimension = setting.key->dimension;
  return dimension.dimensionless() ? fmt::format("{:g}", value)
                                   : fmt::format("{:g} {}", value, describe(dimension).si_unit);
}

/// "Share of work (Taylor 1934)."
std::string meaning_with_source(const ParameterInfo& info) {
  std::string_view meaning = info.meaning;
  if (!*info.source) return info.meaning;
  if (meaning.ends_with('.')) meaning.remove_suffix(1);
  return fmt::format("{} ({}).", meaning, info.source);
}

KeyDraft add_constant(Keys& k, const std::string& at, const ConstantText& constant) {
  const ParameterInfo& info = constant.info;
  const std::string_view unit = info.unit;
  KeyDraft key = k.add(fmt::format("{}.{}", at, info.name), constant.list ? Type::quantities : Type::quantity,
                       meaning_with_source(info));
  key.in(info.range);
  if (!unit.empty()) key.unit(parse_unit(unit).dimension);
  if (*info.example)
    key.example(unit.empty() || constant.list ? info.example : fmt::format("\"{}\"", info.example));
  if (info.required)
    key.required();
  else if (*info.computed)
    key.computed(info.computed);
  else if (std::isfinite(constant.initial))
    key.fallback(toml(format_number(constant.initial), unit));
  return key;
}

} // namespace

void add_constants(Keys& k, const std::string& at, const std::vector<ConstantText>& constants) {
  for (const ConstantText& constant : constants) add_constant(k, at, constant);
}

KeyDraft add_law_choice(Keys& k, const std::string& at, const std::vector<LawText>& laws) {
  std::vector<std::string> names, formulas;
  for (const LawText& law : laws) {
    names.push_back(law.name);
    formulas.push_back(fmt::format("`{}`: {}{}", law.name, law.formula,
                                   law.source.empty() ? "" : fmt::format(" ({})", law.source)));
  }
  return k.add(at + ".law", Type::choice, fmt::format("{}.", fmt::join(formulas, "; "))).one_of(names);
}

void add_law_constants(Keys& k, const std::string& at, const std::vector<LawText>& laws) {
  struct Shared {
    ConstantText constant;
    std::vector<std::string> laws;
  };
  std::vector<Shared> all;
  for (const LawText& law : laws)
    for (const ConstantText& constant : law.constants) {
      const auto known = std::find_if(all.begin(), all.end(), [&](const Shared& other) {
        return std::string_view(other.constant.info.name) == constant.info.name;
      });
      if (known == all.end())
        all.push_back({constant, {law.name}});
      else if (same(known->constant, constant))
        known->laws.push_back(law.name);
      else
        throw std::logic_error(fmt::format("{} of the law {} has another unit, range or default than in {}",
                                           constant.info.name, law.name, known->laws.front()));
    }
  for (const Shared& shared : all) add_constant(k, at, shared.constant).when("law", shared.laws);
}

bool read_list(const ParameterInfo& info, const Setting& table, NumberList& list, Diagnostics& diagnostics) {
  const Setting* setting = table.find(info.name);
  if (!setting) return true;
  const auto& numbers = std::get<std::vector<double>>(setting->value);
  if (numbers.size() > std::size_t{NumberList::capacity}) {
    diagnostics.add(
        Mistake::type, setting->where, setting->path,
        fmt::format("found {} numbers, expected at most {}", numbers.size(), NumberList::capacity));
    return false;
  }
  list.size = static_cast<int>(numbers.size());
  std::copy(numbers.begin(), numbers.end(), list.value);
  return true;
}

void check_order(const Order& order, const Setting& table, Diagnostics& diagnostics) {
  const Setting *larger = table.find(order.larger), *smaller = table.find(order.smaller);
  if (!larger || !smaller) return;
  const double a = std::get<double>(larger->value), b = std::get<double>(smaller->value);
  if (order.may_equal ? a >= b : a > b) return;
  diagnostics.add(Mistake::range, larger->where, larger->path,
                  fmt::format("found {}, expected {} {} = {}", value_text(*larger),
                              order.may_equal ? "at least" : "more than", order.smaller,
                              value_text(*smaller)));
}

void check_strength(const std::vector<std::string>& names, const Setting& table, Diagnostics& diagnostics) {
  if (std::any_of(names.begin(), names.end(),
                  [&](const std::string& name) { return table.maybe<double>(name).value_or(0.0) > 0.0; }))
    return;
  diagnostics.add(Mistake::range, table.where, table.path,
                  fmt::format("found {} = 0, expected some strength", fmt::join(names, " = ")));
}

} // namespace cnem::input
