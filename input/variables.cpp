#include "input/variables.hpp"

#include "core/error.hpp"
#include "input/schema/expression.hpp"
#include "input/schema/nearest.hpp"
#include "input/schema/settings.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::input {
namespace {

using Kind = Value::Kind;

/// A variable is wrong, which has been told.
struct ToldBefore {};

std::vector<std::string> names_of(const Value& let) {
  std::vector<std::string> names;
  for (const Member& member : let.members) names.push_back(member.key);
  return names;
}

std::string variables_in_words(const std::vector<std::string>& names) {
  return names.empty() ? "a variable of [let]"
                       : fmt::format("one of the variables {}", fmt::join(names, ", "));
}

/// The variables of a document, calculated when they are first asked for: their order does not matter.
class Variables {
public:
  Variables(Value* let, Diagnostics& diagnostics) : let_(let), diagnostics_(diagnostics) {
    if (!let) return;
    names_ = names_of(*let);
    entries_.resize(names_.size());
    for (const Member& member : let->members)
      if (const std::string refusal = refusal_of_name(member.key); !refusal.empty())
        diagnostics_.add(Mistake::type, member.where, "let",
                         fmt::format("found the name {}, {}", toml_quoted(shortened(member.key)), refusal));
  }

  bool any() const { return !names_.empty(); }
  bool has(const std::string& name) const { return place(name) < names_.size(); }

  Quantity value(std::string_view name) {
    const std::size_t k = place(name);
    if (k == names_.size()) throw UnitError(variables_in_words(names_) + did_you_mean(name, names_));
    entries_[k].used = true;
    if (entries_[k].state == State::open) throw UnitError(cycle(k));
    if (entries_[k].state == State::untouched) calculate(k);
    if (entries_[k].state == State::failed) throw ToldBefore{};
    return entries_[k].value;
  }

  /// All of them; their texts become values.
  /// `source`: of the file that may include others.
  std::vector<Variable> take(const std::vector<Override>& changed, const std::string& source,
                             std::vector<std::string>& warnings) {
    std::vector<Variable> list;
    const bool used =
        std::any_of(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.used; });
    // A variable that is given a value may have been the only one that used another.
    const bool replaced = std::any_of(changed.begin(), changed.end(),
                                      [](const Override& one) { return one.key.starts_with("let."); });
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (entries_[k].state == State::untouched) calculate(k);
      if (entries_[k].state == State::failed) continue;
      Member& member = let_->members[k];
      const Quantity quantity = entries_[k].value;
      const bool bare = quantity.dimension.dimensionless();
      list.push_back({member.key, quantity.value, bare ? "" : describe(quantity.dimension).si_unit,
                      member.value.kind == Kind::text ? member.value.text : ""});
      const auto change = std::find_if(changed.begin(), changed.end(),
                                       [&](const Override& one) { return one.key == "let." + member.key; });
      if (!entries_[k].used && change != changed.end())
        diagnostics_.add(
            Mistake::conflict, change->where, change->key,
            "found a value for a variable that nothing in the case uses, expected it in an expression; a "
            "resolved case holds values alone");
      else if (used && !replaced && !entries_[k].used && member.where.source == source)
        warnings.push_back(fmt::format("variable '{}' ({}) is defined and nothing uses it", member.key,
                                       member.where.text()));
      member.value.kind = bare ? Kind::real : Kind::text;
      member.value.real = quantity.value;
      member.value.text = quantity_text(quantity);
    }
    return list;
  }

private:
  enum class State { untouched, open, done, failed };
  struct Entry {
    Quantity value;
    State state = State::untouched;
    bool used = false;
  };

  std::size_t place(std::string_view name) const {
    return static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
  }

  void calculate(std::size_t k) {
    constexpr std::size_t most_nested = 100;
    const Member& member = let_->members[k];
    if (open_.size() > most_nested) throw UnitError("one that fewer variables lead to");
    entries_[k].state = State::open;
    open_.push_back(k);
    try {
      entries_[k].value = calculated(member.value);
      entries_[k].state = State::done;
    } catch (const UnitError& error) {
      fail(k, Mistake::unit, fmt::format("found {}, {}", member.value.show(), error.what()));
    } catch (const ToldBefore&) { entries_[k].state = State::failed; }
    open_.pop_back();
  }

  Quantity calculated(const Value& value) {
    if (value.kind == Kind::integer) return {static_cast<double>(value.integer), {}};
    if (value.kind == Kind::real && std::isfinite(value.real)) return {value.real, {}};
    if (value.kind != Kind::text)
      throw UnitError("which is no quantity, expected one such as \"2 mm\", a number, or an expression such "
                      "as \"0.08 * sheet\"");
    refuse_decimal_comma(value.text);
    return evaluate(value.text, [this](std::string_view name) { return this->value(name); });
  }

  void fail(std::size_t k, Mistake kind, const std::string& message) {
    entries_[k].state = State::failed;
    diagnostics_.add(kind, let_->members[k].value.where, "let." + names_[k], message);
  }

  /// What a variable that follows from itself follows from, in words.
  std::string cycle(std::size_t k) const {
    std::string text;
    for (std::size_t at = 0; at < open_.size(); ++at) {
      if (text.empty() && open_[at] != k) continue;
      const std::size_t next = at + 1 < open_.size() ? open_[at + 1] : k;
      text += fmt::format("{}{} from {}", text.empty() ? "" : ", ", names_[open_[at]], names_[next]);
    }
    return "variables that do not follow from themselves: " + text;
  }

  Value* let_;
  Diagnostics& diagnostics_;
  std::vector<std::string> names_;
  std::vector<Entry> entries_;
  std::vector<std::size_t> open_; ///< being calculated, each for the one before
};

/// Goes through a document as the schema does.
class Substitution {
public:
  Substitution(Variables& variables, Diagnostics& diagnostics)
      : variables_(variables), diagnostics_(diagnostics) {}

  void table(Value& written, const std::string& pattern, const std::string& path) {
    for (Member& member : written.members) {
      const std::string at = pattern.empty() ? member.key : fmt::format("{}.{}", pattern, member.key);
      if (const Key* key = find_key(at)) value(member.value, *key, name_in(path, member.key));
    }
  }

private:
  static std::string name_in(const std::string& path, const std::string& key) {
    const std::string name = valid_name(key) ? key : toml_quoted(shortened(key));
    return path.empty() ? name : fmt::format("{}.{}", path, name);
  }

  void value(Value& written, const Key& key, const std::string& path) {
    switch (key.type) {
    case Type::table:
      return table(written, key.path, path);
    case Type::named_tables:
      for (Member& member : written.members) table(member.value, key.path + ".*", name_in(path, member.key));
      return;
    case Type::table_list:
      for (std::size_t i = 0; i < written.elements.size(); ++i)
        table(written.elements[i], key.path + "[]", fmt::format("{}[{}]", path, i));
      return;
    case Type::vector:
    case Type::vectors:
    case Type::vector_function:
    case Type::quantities:
      return leaves(written, key, path, true);
    case Type::quantity:
    case Type::function:
    case Type::integer:
      return leaves(written, key, path, false);
    default:
      return;
    }
  }

  void leaves(Value& written, const Key& key, const std::string& path, bool several) {
    if (written.kind == Kind::text && several && !is_plain(written.text))
      if (const std::vector<std::string> parts = split_at_commas(written.text); parts.size() > 1) {
        if (!are_values(parts)) return; // a comma among numbers, which the key tells
        divide(written, parts);
      }
    if (written.kind == Kind::text) leaf(written, key, path);
    for (Value& element : written.elements) leaves(element, key, path, several);
    for (Member& member : written.members) leaves(member.value, key, path, several);
  }

  bool are_values(const std::vector<std::string>& parts) const {
    return std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return is_expression(part); }) ||
           std::all_of(parts.begin(), parts.end(), ends_in_unit);
  }
  static bool ends_in_unit(const std::string& part) {
    const std::string_view words = trimmed(part);
    return !words.empty() && std::string_view("0123456789.").find(words.back()) == std::string_view::npos;
  }
  /// "a, b" becomes ["a", "b"].
  static void divide(Value& written, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) {
      Value& element = written.elements.emplace_back();
      element.kind = Kind::text;
      element.text = trimmed(part);
      element.where = written.where;
    }
    written.kind = Kind::array;
  }

  /// Whether a text is an expression; what else is wrong with it the key tells.
  bool is_expression(std::string_view text) const {
    if (is_plain(text)) return false;
    if (calculates(text)) return true;
    const std::vector<std::string> names = names_in(text);
    const std::string_view words = trimmed(text);
    const bool begins_with_name = !names.empty() && words.starts_with(names.front());
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return variables_.has(name); }) ||
           (variables_.any() && (begins_with_name || words.starts_with('(') || words.starts_with('-')));
  }

  void leaf(Value& written, const Key& key, const std::string& path) {
    if (!is_expression(written.text)) return;
    try {
      const Quantity quantity =
          evaluate(written.text, [this](std::string_view name) { return variables_.value(name); });
      std::string text = quantity_text(quantity);
      if (key.type == Type::integer) {
        if (!quantity.dimension.dimensionless() || quantity.value != std::round(quantity.value) ||
            std::abs(quantity.value) > 1e15)
          throw UnitError(fmt::format("which is {}, expected a whole number", text));
        written.kind = Kind::integer;
        written.integer = static_cast<std::int64_t>(quantity.value);
      }
      written.expression = std::move(written.text);
      written.text = std::move(text);
    } catch (const UnitError& error) {
      diagnostics_.add(Mistake::unit, written.where, path,
                       fmt::format("found {}, {}", written.show(), error.what()));
    } catch (const ToldBefore&) { diagnostics_.follows(written.where); }
  }

  Variables& variables_;
  Diagnostics& diagnostics_;
};

} // namespace

std::vector<Variable> apply_variables(Value& document, const std::vector<Override>& changed,
                                      Diagnostics& diagnostics, std::vector<std::string>& warnings) {
  Member* let = document.find("let");
  if (let && let->value.kind != Kind::table) {
    diagnostics.add(Mistake::type, let->value.where, "let",
                    fmt::format("found {}, expected {}", let->value.show(), find_key("let")->expectation()));
    return {};
  }
  Variables variables(let ? &let->value : nullptr, diagnostics);
  Substitution(variables, diagnostics).table(document, "", "");
  return variables.take(changed, document.where.source, warnings);
}

void check_variable_of(const Value& document, const Override& change) {
  constexpr std::string_view table = "let.";
  if (!change.key.starts_with(table)) return;
  const std::string name = change.key.substr(table.size());
  const Member* let = document.find("let");
  const std::vector<std::string> names = let ? names_of(let->value) : std::vector<std::string>{};
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  throw InputError(fmt::format("{}: key '{}': the case does not define it, expected {}{}",
                               change.where.text(), shortened(change.key), variables_in_words(names),
                               did_you_mean(name, names)));
}

} // namespace cnem::input
