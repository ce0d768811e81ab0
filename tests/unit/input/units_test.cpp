#include "input/schema/nearest.hpp"
#include "input/schema/schema.hpp"
#include "input/schema/units.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::input {
namespace {

namespace d = dimension;

std::string message_of(const std::string& text, const Dimension& expected) {
  try {
    parse_quantity(text, expected);
  } catch (const UnitError& error) { return error.what(); }
  return "no error";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Units, QuantitiesOfCasesInSI) {
  EXPECT_EQ(parse_quantity("11 m/s", d::velocity), 11.0);
  EXPECT_EQ(parse_quantity("12 us", d::time), 1.2e-5);
  EXPECT_EQ(parse_quantity("12 µs", d::time), 1.2e-5);
  EXPECT_EQ(parse_quantity("12 μs", d::time), 1.2e-5);
  EXPECT_EQ(parse_quantity("0.2 mm", d::length), 0.0002);
  EXPECT_EQ(parse_quantity("253 MPa", d::pressure), 253e6);
  EXPECT_EQ(parse_quantity("210 GPa", d::pressure), 210e9);
  EXPECT_EQ(parse_quantity("210000 N/mm2", d::pressure), 210e9);
  EXPECT_EQ(parse_quantity("7850 kg/m3", d::density), 7850.0);
  EXPECT_DOUBLE_EQ(parse_quantity("7.85 g/cm3", d::density), 7850.0);
  EXPECT_DOUBLE_EQ(parse_quantity("7.85e-9 t/mm^3", d::density), 7850.0);
  EXPECT_EQ(parse_quantity("5.86 W/(m K)", d::conductivity), 5.86);
  EXPECT_EQ(parse_quantity("5.86 W/m/K", d::conductivity), 5.86);
  EXPECT_EQ(parse_quantity("5.86 W m^-1 K^-1", d::conductivity), 5.86);
  EXPECT_EQ(parse_quantity("5.86 W·m⁻¹·K⁻¹", d::conductivity), 5.86);
  EXPECT_EQ(parse_quantity("500 J/(kg K)", d::specific_heat), 500.0);
  EXPECT_EQ(parse_quantity("5 kW/(m2*K)", d::heat_transfer), 5000.0);
  EXPECT_EQ(parse_quantity("1 1/s", d::rate), 1.0);
  EXPECT_EQ(parse_quantity("1 /s", d::rate), 1.0);
  EXPECT_EQ(parse_quantity("1/s", d::rate), 1.0);
  EXPECT_EQ(parse_quantity("1e4/s", d::rate), 1e4);
  EXPECT_EQ(parse_quantity("2 kHz", d::rate), 2000.0);
  EXPECT_EQ(parse_quantity("-9.81 m/s²", d::acceleration), -9.81);
  EXPECT_DOUBLE_EQ(parse_quantity("800 m/min", d::velocity), 800.0 / 60.0);
  EXPECT_DOUBLE_EQ(parse_quantity("3 mm/us", d::velocity), 3000.0);
  EXPECT_EQ(parse_quantity("11m/s", d::velocity), 11.0);
  EXPECT_EQ(parse_quantity("  +11   m / s ", d::velocity), 11.0);
  EXPECT_DOUBLE_EQ(parse_quantity("30 deg", d::angle), std::numbers::pi / 6.0);
  EXPECT_DOUBLE_EQ(parse_quantity("60 rpm", d::angular_velocity), 2.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(parse_quantity("360 deg/s", d::angular_velocity), 2.0 * std::numbers::pi);
  EXPECT_EQ(parse_quantity("14000 W s^0.5/(m2 K)", d::effusivity), 14000.0);
  EXPECT_EQ(parse_quantity("14 kJ/(m2 K s^0.5)", d::effusivity), 14000.0);
  EXPECT_EQ(parse_quantity("0.3", d::none), 0.3);
  EXPECT_EQ(parse_quantity("30 %", d::none), 0.3);
}

TEST(Units, DegreesCelsiusAreAbsoluteTemperaturesOnly) {
  EXPECT_DOUBLE_EQ(parse_quantity("20 degC", d::temperature), 293.15);
  EXPECT_DOUBLE_EQ(parse_quantity("20 °C", d::temperature), 293.15);
  EXPECT_TRUE(has(message_of("5 W/(m degC)", d::conductivity), "degC has an offset"));
  EXPECT_TRUE(has(message_of("5 degC2", d::temperature), "degC has an offset"));
}

TEST(Units, DecimalPrefixesDoNotChangeBits) {
  EXPECT_EQ(parse_quantity("5.1 mm", d::length), 0.0051);
  EXPECT_EQ(parse_quantity("0.05 us", d::time), 5e-8);
  EXPECT_EQ(parse_quantity("1e-3 mm", d::length), 1e-6);
  EXPECT_EQ(parse_quantity("7.85 g/cm3", d::density), 7850.0);
  EXPECT_EQ(parse_quantity("7.85e-9 t/mm^3", d::density), 7850.0);
  EXPECT_EQ(parse_quantity("-0.3 mm", d::length), -0.0003);
  EXPECT_EQ(parse_quantity("1e-320 nm", d::length), 0.0);
}

TEST(Units, MilliAndMetreAndMinute) {
  EXPECT_EQ(parse_quantity("3 m", d::length), 3.0);
  EXPECT_EQ(parse_quantity("3 mm", d::length), 0.003);
  EXPECT_EQ(parse_quantity("3 min", d::time), 180.0);
  EXPECT_EQ(parse_quantity("3 ms", d::time), 0.003);
  EXPECT_TRUE(has(message_of("3 kmin", d::time), "unknown unit 'kmin'"));
}

TEST(Units, SeveralNumbersShareAUnit) {
  EXPECT_EQ(parse_quantities("0 -10.5 mm", d::length), (std::vector{0.0, -0.0105}));
  EXPECT_EQ(parse_quantities("2 4 5 12 us", d::time), (std::vector{2e-6, 4e-6, 5e-6, 12e-6}));
  EXPECT_EQ(parse_quantities("1 2 1/s", d::rate), (std::vector{1.0, 2.0}));
}

TEST(Units, OfTwoNamesAKeyHasTheOneOfItsExample) {
  EXPECT_EQ(find_key("modes.*.stiffness")->quantity().si_unit, "N/m");
  EXPECT_EQ(find_key("modes.*.frequency")->quantity().name, "a frequency");
  EXPECT_EQ(find_key("cutting.forces.Kte")->quantity().name, "a force per length");
  EXPECT_EQ(find_key("materials.*.damage.fracture_energy")->quantity().si_unit, "J/m2");
}

TEST(Units, MessagesSayWhatWasFoundAndExpected) {
  EXPECT_EQ(message_of("11 mm", d::velocity),
            "found '11 mm', which is a length, expected a velocity such as \"11 m/s\"");
  EXPECT_EQ(message_of("11", d::velocity),
            "found '11' without a unit, expected a velocity such as \"11 m/s\"");
  EXPECT_EQ(message_of("fast", d::velocity), "found 'fast', expected a velocity such as \"11 m/s\"");
  EXPECT_EQ(message_of("", d::velocity), "found '', expected a velocity such as \"11 m/s\"");
  EXPECT_TRUE(has(message_of("1 2 m/s", d::velocity), "found 2 numbers in '1 2 m/s', expected one"));
  EXPECT_TRUE(has(message_of("11 MPaa", d::pressure), "unknown unit 'MPaa' (did you mean 'MPa'?)"));
  EXPECT_TRUE(
      has(message_of("30 1/s", d::angular_velocity), "which is a rate, expected an angular velocity"));
  EXPECT_TRUE(has(message_of("1650 N/mm", d::pressure), "which is a force per length, expected a stress"));
  EXPECT_TRUE(has(message_of("20 kJ/m2", d::pressure), "which is an energy per area, expected a stress"));
  EXPECT_TRUE(has(message_of("5 W/m K", d::conductivity), "ambiguous"));
  EXPECT_TRUE(has(message_of("5 J/kg*K", d::specific_heat), "ambiguous"));
  EXPECT_TRUE(has(message_of("5 kg m", d::velocity), "a quantity in m kg"));
}

TEST(Units, CommasAndCelsiusAreToldHowTheyAreWritten) {
  EXPECT_EQ(message_of("0,1 mm", d::length),
            "found '0,1 mm' with a comma, expected a point in a number: '0.1 mm'");
  EXPECT_EQ(message_of("1, 2 mm", d::length),
            "found '1, 2 mm' with a comma, expected spaces between numbers: '1 2 mm'");
  EXPECT_EQ(message_of("7,850 kg/m3", d::density),
            "found '7,850 kg/m3' with a comma, expected a point in a number and nothing between thousands");
  EXPECT_TRUE(has(message_of("20 C", d::temperature), "unknown unit 'C' (did you mean 'degC'?)"));
}

TEST(Units, MalformedTextIsRefusedNotCrashedOn) {
  for (const char* text :
       {"1 (m", "1 m)", "1 m/", "1 /", "1 m^", "1 m^x", "1 *m", "1 ()", "1 m2.3", "1 m^99", "nan m", "inf m",
        "1e999 m", "1e308 Gm", "1,5 m", "1 m\n", "0x10 m", "1 ^2", "- m"})
    EXPECT_THROW(parse_quantity(text, d::length), UnitError) << text;
  EXPECT_THROW(parse_quantity("1 " + std::string(10000, '('), d::length), UnitError);
}

TEST(Units, TextsOfAnyLengthAreReadAndMessagesShortenThem) {
  std::string list;
  for (int k = 0; k < 1000; ++k) list += "1 ";
  EXPECT_EQ(parse_quantities(list + "mm", d::length).size(), 1000U);
  for (const char* end : {"", "s", "xyz", "1, 1 mm", "1e999 mm"}) {
    const std::string message = message_of(list + end, d::length);
    EXPECT_FALSE(message.empty());
    EXPECT_LT(message.size(), 300U) << end;
  }
}

TEST(Units, NumbersReadBackToTheSameBits) {
  for (const double value : {0.1, 1.0 / 3.0, 1e-300, 12e-6, 5.0e9, -0.0})
    EXPECT_EQ(parse_quantity(format_number(value), d::none), value);
}

TEST(Nearest, FindsMisspellingsAndStaysSilentOtherwise) {
  const std::vector<std::string> keys{"spacing", "pattern", "jitter", "seed"};
  EXPECT_EQ(nearest("spaceing", keys), "spacing");
  EXPECT_EQ(nearest("Pattern", keys), "pattern");
  EXPECT_EQ(nearest("jittre", keys), "jitter");
  EXPECT_EQ(nearest("viscosity", keys), std::nullopt);
  EXPECT_EQ(nearest("patt", keys), "pattern");
  EXPECT_EQ(did_you_mean("sed", keys), " (did you mean 'seed'?)");
  EXPECT_EQ(did_you_mean("conductivity", keys), "");
  EXPECT_EQ(edit_distance("abcd", "bacd"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
}

} // namespace
} // namespace cnem::input
