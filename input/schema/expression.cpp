#include "input/schema/expression.hpp"

#include "input/schema/document.hpp"
#include "input/schema/expression_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::input {
namespace {

class Evaluation {
public:
  Evaluation(std::string_view text, const Lookup& lookup) : scan_(text), lookup_(lookup) {}

  Quantity run() {
    Quantity result = sum();
    if (!scan_.at_end())
      fail(fmt::format("has '{}'", scan_.word_at(scan_.at).empty() ? std::string(1, scan_.next())
                                                                   : std::string(scan_.word_at(scan_.at))),
           scan_.at, "an operator such as '*' before it");
    if (calculated_) {
      const std::string decimal = fmt::format("{:.15g}", result.value);
      std::from_chars(decimal.data(), decimal.data() + decimal.size(), result.value);
    }
    return result;
  }

private:
  [[noreturn]] void fail(const std::string& what, std::size_t at, const std::string& expected) const {
    const std::string_view before = scan_.text().substr(0, at);
    const auto characters = std::count_if(before.begin(), before.end(), [](char c) {
      return (static_cast<unsigned char>(c) & 0xc0) != 0x80; // UTF-8
    });
    throw UnitError(fmt::format("which {} at character {}, expected {}", what, characters + 1, expected));
  }

  Quantity finite(Quantity q, const std::string& what, std::size_t at) {
    calculated_ = true;
    if (celsius_) fail("calculates with degC", at, "K");
    if (!std::isfinite(q.value)) fail(what, at, "a finite number");
    return q;
  }

  Quantity sum() {
    Quantity left = product();
    for (; scan_.next() == '+' || scan_.next() == '-';) {
      const std::size_t at = scan_.at++;
      const bool add = scan_.text()[at] == '+';
      const Quantity right = product();
      const std::string a = named_dimension(left.dimension), b = named_dimension(right.dimension);
      if (left.dimension != right.dimension)
        fail(add ? fmt::format("adds {} and {}", a, b) : fmt::format("subtracts {} from {}", b, a), at,
             "quantities of one kind");
      left.value += add ? right.value : -right.value;
      left = finite(left, "is beyond what a number can hold", at);
    }
    return left;
  }

  Quantity product() {
    Quantity left = sign();
    for (; scan_.next() == '*' || scan_.next() == '/';) {
      const std::size_t at = scan_.at++;
      const bool times = scan_.text()[at] == '*';
      const Quantity right = sign();
      if (!times && right.value == 0.0) fail("divides by zero", at, "another divisor");
      left.value = times ? left.value * right.value : left.value / right.value;
      for (std::size_t k = 0; k < left.dimension.halves.size(); ++k)
        left.dimension.halves[k] += (times ? 1 : -1) * right.dimension.halves[k];
      left = finite(left, "is beyond what a number can hold", at);
      check(left.dimension, at);
    }
    return left;
  }

  void check(const Dimension& dimension, std::size_t at) const {
    constexpr int largest = 18; // as units have
    for (const int half : dimension.halves)
      if (std::abs(half) > largest) fail("has a dimension of a power beyond 9", at, "a smaller one");
  }

  Quantity sign() {
    constexpr int most_nested = 50;
    if (++depth_ > most_nested) fail("nests too deeply", scan_.at, "fewer parentheses");
    scan_.skip_blanks();
    const bool minus = scan_.next() == '-';
    Quantity result;
    if (double number = 0.0; minus && is_plain(scan_.text())) { // "-20 degC" is a reading, no calculation
      const std::size_t end = scan_.number_end(scan_.at + 1, number);
      result = literal(-number, end);
    } else if (minus || scan_.next() == '+') {
      const std::size_t at = scan_.at++;
      result = sign();
      if (minus && celsius_) fail("takes the negative of degC", at, "K");
      if (minus) result.value = -result.value;
    } else {
      result = power();
    }
    --depth_;
    return result;
  }

  Quantity power() {
    Quantity base = value();
    scan_.skip_blanks();
    if (scan_.next() != '^') return base;
    const std::size_t at = scan_.at++;
    const Quantity exponent = sign();
    if (!exponent.dimension.dimensionless())
      fail("has an exponent that is " + named_dimension(exponent.dimension), at, "a plain number");
    return raised(base, exponent.value, at);
  }

  Quantity raised(Quantity base, double exponent, std::size_t at) {
    for (int& half : base.dimension.halves) {
      const double power = half * exponent;
      if (power != std::round(power) || std::abs(power) > 100.0)
        fail(fmt::format("takes the power {:g} of {}", exponent, named_dimension(base.dimension)), at,
             "one that leaves whole or half powers of units");
      half = static_cast<int>(power);
    }
    base.value = std::pow(base.value, exponent);
    check(base.dimension, at);
    return finite(base, "is not a number", at);
  }

  Quantity value() {
    scan_.skip_blanks();
    const std::size_t at = scan_.at;
    double number = 0.0;
    if (const std::size_t end = scan_.number_end(at, number); end > at) return literal(number, end);
    if (scan_.next() == '(') {
      const std::vector<Quantity> inner = arguments();
      if (inner.size() != 1) fail("has a comma in parentheses", at, "one value");
      return inner.front();
    }
    const std::string_view word = scan_.word_at(at);
    if (word.empty())
      fail(scan_.at_end() ? "ends" : fmt::format("has '{}'", scan_.next()), at,
           "a number, a name or a parenthesis there");
    scan_.at += word.size();
    if (is_function(word) && scan_.is_called(scan_.at)) return call(word, at);
    if (word == "pi") return {std::numbers::pi, {}};
    if (!is_unit(word)) return named(word, at);
    scan_.at = scan_.factor_end(at);
    return unit(scan_.text().substr(at, scan_.at - at), at, 1.0);
  }

  Quantity literal(double number, std::size_t end) {
    const std::size_t at = scan_.at;
    if (!std::isfinite(number)) fail("has a number beyond what one can hold", at, "0 or 1e-307 to 1e308");
    scan_.at = end;
    scan_.skip_blanks();
    const std::size_t begin = scan_.at;
    const bool inverse = scan_.text().substr(begin).starts_with("1/"); // "5 1/s"
    const std::size_t first = inverse ? begin + 2 : begin;
    const std::size_t behind = scan_.next() == '(' ? first : scan_.unit_end(first);
    const std::size_t unit_end = behind == first ? begin : behind;
    scan_.at = unit_end;
    return unit_end == begin ? Quantity{number, {}}
                             : unit(scan_.text().substr(begin, unit_end - begin), begin, number);
  }

  Quantity unit(std::string_view text, std::size_t at, double number) {
    Unit unit;
    try {
      unit = parse_unit(text);
    } catch (const UnitError& error) {
      fail(fmt::format("has a unit ({})", error.what()), at, "another one");
    }
    celsius_ = celsius_ || unit.offset != 0.0;
    check(unit.dimension, at);
    return {unit.to_si(number), unit.dimension};
  }

  Quantity named(std::string_view name, std::size_t at) const {
    try {
      return lookup_(name);
    } catch (const UnitError& error) { fail(fmt::format("names '{}'", shortened(name)), at, error.what()); }
  }

  std::vector<Quantity> arguments() {
    const std::size_t open = scan_.at++;
    std::vector<Quantity> list{sum()};
    while (scan_.next() == ',') {
      ++scan_.at;
      list.push_back(sum());
    }
    if (scan_.next() != ')') fail("has a '('", open, "')' to close it");
    ++scan_.at;
    scan_.skip_blanks();
    return list;
  }

  Quantity call(std::string_view name, std::size_t at) {
    scan_.skip_blanks();
    const std::vector<Quantity> list = arguments();
    Quantity result = list.front();
    if (name == "min" || name == "max") {
      if (list.size() < 2) fail(fmt::format("gives {} one value", name), at, "two or more");
      for (const Quantity& other : list) {
        if (other.dimension != result.dimension)
          fail(fmt::format("compares {} and {}", named_dimension(result.dimension),
                           named_dimension(other.dimension)),
               at, "quantities of one kind");
        result.value =
            name == "min" ? std::min(result.value, other.value) : std::max(result.value, other.value);
      }
      return result;
    }
    if (list.size() != 1) fail(fmt::format("gives {} {} values", name, list.size()), at, "one");
    if (name == "sqrt") return raised(result, 0.5, at);
    if (name == "abs") return {std::abs(result.value), result.dimension};
    if (result.dimension != dimension::angle)
      fail(fmt::format("takes the {} of {}", name, named_dimension(result.dimension)), at,
           "an angle such as 30 deg");
    const double angle = result.value;
    return finite({name == "sin"   ? std::sin(angle)
                   : name == "cos" ? std::cos(angle)
                                   : std::tan(angle),
                   {}},
                  "is not a number", at);
  }

  ExpressionScanner scan_;
  const Lookup& lookup_;
  int depth_ = 0;
  bool calculated_ = false;
  bool celsius_ = false; ///< a number in degC was read: with those one does not calculate
};

} // namespace

std::string named_dimension(const Dimension& dimension) {
  const DimensionText text = describe(dimension);
  return dimension.dimensionless() || text.name.ends_with(text.si_unit)
             ? text.name
             : fmt::format("{} ({})", text.name, text.si_unit);
}

std::string quantity_text(const Quantity& quantity) {
  const std::string number = format_number(quantity.value);
  return quantity.dimension.dimensionless()
             ? number
             : fmt::format("{} {}", number, describe(quantity.dimension).si_unit);
}

Quantity evaluate(std::string_view text, const Lookup& lookup) { return Evaluation(text, lookup).run(); }

} // namespace cnem::input
