// Expressions over quantities, and what is said of wrong ones.
#include "input/schema/expression.hpp"

#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace cnem::input {
namespace {

namespace d = dimension;

Quantity value_of(const std::string& text) {
  static const std::map<std::string, Quantity, std::less<>> known{
      {"sheet", {0.002, d::length}}, {"speed", {10.0, d::velocity}}, {"n", {3.0, d::none}}};
  return evaluate(text, [](std::string_view name) {
    const auto found = known.find(name);
    if (found == known.end()) throw UnitError("another name");
    return found->second;
  });
}

void expect_value(const std::string& text, double value, const Dimension& dimension) {
  const Quantity found = value_of(text);
  EXPECT_EQ(found.value, value) << text;
  EXPECT_EQ(found.dimension, dimension) << text << " is " << named_dimension(found.dimension);
}

std::string clause_of(const std::string& text) {
  try {
    const Quantity found = value_of(text);
    return "no error: " + quantity_text(found);
  } catch (const UnitError& error) { return error.what(); }
}

TEST(Expression, operators_and_their_order) {
  expect_value("1 + 2 * 3", 7.0, d::none);
  expect_value("(1 + 2) * 3", 9.0, d::none);
  expect_value("8 / 2 / 2 - 1", 1.0, d::none);
  expect_value("-2^2", -4.0, d::none);
  expect_value("2^3^2", 512.0, d::none);
  expect_value("2 * -n", -6.0, d::none);
  expect_value("+n-1", 2.0, d::none);
  expect_value("1e-3*2", 0.002, d::none);
  expect_value(" 2*( n ) ", 6.0, d::none);
}

TEST(Expression, dimensions_are_carried) {
  expect_value("sheet", 0.002, d::length);
  expect_value("2 * sheet", 0.004, d::length);
  expect_value("sheet^2", 4e-6, Dimension::of(2, 0, 0));
  expect_value("sheet / speed", 0.0002, d::time);
  expect_value("sqrt(sheet * 2 mm)", 0.002, d::length);
  expect_value("sheet^0.5 * sheet^0.5", 0.002, d::length);
  expect_value("sheet / mm", 2.0, d::none);
  expect_value("sheet / (1 mm * 4)", 0.5, d::none);
}

TEST(Expression, a_number_takes_all_of_the_unit_behind_it) {
  expect_value("10 m/s", 10.0, d::velocity);
  expect_value("0.02 m / 2 mm/s", 10.0, d::time);
  expect_value("5 W/(m K) * 2", 10.0, d::conductivity);
  expect_value("2 mm^2", 2e-6, Dimension::of(2, 0, 0));
  expect_value("(2 mm)^2", 4e-6, Dimension::of(2, 0, 0));
  expect_value("10 mm-2 mm", 0.008, d::length);
  expect_value("8% * sheet", 0.00016, d::length);
  expect_value("0.2 mm", 0.0002, d::length);
  expect_value("5 1/s * 2", 10.0, d::rate);
  expect_value("20 degC", 293.15, d::temperature);
  expect_value("2 µm + 1 μm", 3e-6, d::length);
}

TEST(Expression, results_have_the_bits_of_the_decimal_number) {
  EXPECT_NE(0.07 * 0.002, 0.00014);
  expect_value("0.07 * sheet", 0.00014, d::length);
  expect_value("0.1 + 0.2", 0.3, d::none);
  expect_value("0.12345678901234567", 0.12345678901234567, d::none);
}

TEST(Expression, functions) {
  expect_value("min(sheet, 1 mm, 3 mm)", 0.001, d::length);
  expect_value("max(1, n, 2)", 3.0, d::none);
  expect_value("abs(1 mm - sheet)", 0.001, d::length);
  expect_value("sqrt(16)", 4.0, d::none);
  expect_value("sin(30 deg)", 0.5, d::none);
  expect_value("cos(60 deg)", 0.5, d::none);
  expect_value("tan(45 deg)", 1.0, d::none);
  expect_value("2 * pi", 6.28318530717959, d::none);
  expect_value("30 m/min * 2 min", 60.0, d::length);
}

TEST(Expression, says_what_is_wrong_and_where) {
  EXPECT_EQ(clause_of("sheet + speed"),
            "which adds a length (m) and a velocity (m/s) at character 7, expected "
            "quantities of one kind");
  EXPECT_EQ(
      clause_of("sheet - 1"),
      "which subtracts a plain number from a length (m) at character 7, expected quantities of one kind");
  EXPECT_EQ(clause_of("max(sheet, 3)"),
            "which compares a length (m) and a plain number at character 1, expected quantities of one kind");
  EXPECT_EQ(clause_of("2 * shet"), "which names 'shet' at character 5, expected another name");
  EXPECT_EQ(clause_of("1 µm + shet"), "which names 'shet' at character 8, expected another name");
  EXPECT_EQ(clause_of("2 sheet"),
            "which has 'sheet' at character 3, expected an operator such as '*' before it");
  EXPECT_EQ(clause_of("2 *"), "which ends at character 4, expected a number, a name or a parenthesis there");
  EXPECT_EQ(clause_of("2 * )"),
            "which has ')' at character 5, expected a number, a name or a parenthesis there");
  EXPECT_EQ(clause_of("2 * (sheet"), "which has a '(' at character 5, expected ')' to close it");
  EXPECT_EQ(clause_of("(1, 2)"), "which has a comma in parentheses at character 1, expected one value");
  EXPECT_EQ(clause_of("1 / (n - 3)"), "which divides by zero at character 3, expected another divisor");
  EXPECT_EQ(clause_of("1e200 * 1e200"),
            "which is beyond what a number can hold at character 7, expected a finite number");
  EXPECT_EQ(clause_of("2 + 1e999"),
            "which has a number beyond what one can hold at character 5, expected 0 or 1e-307 to 1e308");
  EXPECT_EQ(clause_of("2^sheet"),
            "which has an exponent that is a length (m) at character 2, expected a plain "
            "number");
  EXPECT_EQ(clause_of("sheet^0.3"), "which takes the power 0.3 of a length (m) at character 6, expected one "
                                    "that leaves whole or half powers of units");
  EXPECT_EQ(clause_of("sqrt(0 - n)"), "which is not a number at character 1, expected a finite number");
  EXPECT_EQ(clause_of("sin(0.5)"),
            "which takes the sin of a plain number at character 1, expected an angle such as 30 deg");
  EXPECT_EQ(clause_of("min(3)"), "which gives min one value at character 1, expected two or more");
  EXPECT_EQ(clause_of("abs(3, 4)"), "which gives abs 2 values at character 1, expected one");
  EXPECT_EQ(clause_of("20 degC + 5 K"), "which calculates with degC at character 9, expected K");
  EXPECT_EQ(clause_of("-(20 degC)"), "which takes the negative of degC at character 1, expected K");
  EXPECT_EQ(
      clause_of("5 W/m K * 2"),
      "which has a unit (cannot read the unit 'W/m K': a product after '/' is ambiguous, write W/(m K) or "
      "W/m/K instead of W/m K) at character 3, expected another one");
  EXPECT_EQ(clause_of("sheet^9 * sheet"),
            "which has a dimension of a power beyond 9 at character 9, expected a smaller one");
  std::string deep(60, '(');
  EXPECT_EQ(clause_of(deep += '1'), "which nests too deeply at character 51, expected fewer parentheses");
}

TEST(Expression, tells_values_from_what_is_calculated) {
  for (const char* plain : {"2 mm", "0 -11 m/s", "1/s", "1 1/s", "5 W/(m K)", "-3", "1e4/s", "2 m-2"})
    EXPECT_TRUE(is_plain(plain)) << plain;
  for (const char* other : {"sheet", "2 * sheet", "2 mm + 1 mm", "0.5 mn", "", "fine", "2 mm, 3 mm"})
    EXPECT_FALSE(is_plain(other)) << other;
  for (const char* text : {"2 mm + 1 mm", "10 mm/2", "2 * gap", "2 mm -1 mm", "sin(a)", "pi"})
    EXPECT_TRUE(calculates(text)) << text;
  for (const char* text : {"0.5 mn", "0 -11 m/ss", "fine", "5 J/(kg K", "5 /kk"})
    EXPECT_FALSE(calculates(text)) << text;
  EXPECT_EQ(names_in("2 mm * gap_1 + sin(a) - pi"), (std::vector<std::string>{"gap_1", "a"}));
  EXPECT_EQ(split_at_commas("a, max(b, c)"), (std::vector<std::string>{"a", " max(b, c)"}));
}

TEST(Expression, refuses_names_that_mean_something_already) {
  EXPECT_EQ(refusal_of_name("clearance"), "");
  EXPECT_EQ(refusal_of_name("r_2"), "");
  EXPECT_EQ(refusal_of_name("t"), "which is a unit, of a mass, expected another name such as 't_'");
  EXPECT_EQ(refusal_of_name("min"),
            "which stands for something in expressions already, expected another name");
  EXPECT_EQ(refusal_of_name("pi"),
            "which stands for something in expressions already, expected another name");
  for (const char* wrong : {"", "2r", "a-b", "a b", "ä", "%"})
    EXPECT_EQ(refusal_of_name(wrong),
              "which is no name of a variable, expected letters, digits and '_', not a digit first")
        << wrong;
}

TEST(Expression, texts_of_quantities_read_back) {
  for (const char* text : {"0.0002 m", "1.5 m^0.5", "3", "0.7853981633974483 rad", "7850 kg/m3", "5 1/s",
                           "1e-05 1/K", "14000 W s^0.5/(m2 K)", "-5 W/(m2 K)"})
    EXPECT_EQ(quantity_text(value_of(text)), text);
}

} // namespace
} // namespace cnem::input
