// Tools with a velocity or a mass, and mass scaling, as read from a case.
#include "tests/unit/input/case_text.hpp"

#include <cmath>

namespace cnem::input {
namespace {

/// The least case with a table of tools.
std::string with_press(const std::string& press, const std::string& analysis = "") {
  return analysis + R"toml(
[time]
end = "10 us"
[domain]
material = "m"
outer.rectangle = { from = "0 0 mm", to = "10 5 mm" }
[cloud]
spacing = "1 mm"
[materials.m]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[tools.press]
rectangle = { from = "0 5 mm", to = "12 8 mm" }
)toml" + press;
}

TEST(Tools, VelocityMayRampSmoothly) {
  const Case plain = read_case_text(with_press(""), "x");
  EXPECT_EQ(plain.tools.front().velocity[1].value()(1.0), 0.0);
  const Case input = read_case_text(
      with_press("velocity = { y = { value = \"-4 m/s\", ramp = \"2 us\", smooth = true } }"), "x");
  const TimeTable& velocity = input.tools.front().velocity[1].value();
  EXPECT_EQ(velocity(0.0), 0.0);
  EXPECT_NEAR(velocity(1e-6), -2.0, 1e-12);
  EXPECT_NEAR(velocity(0.25e-6), -4.0 * (std::pow(0.125, 3) * (10.0 + 0.125 * (6.0 * 0.125 - 15.0))), 1e-12);
  EXPECT_EQ(velocity(5e-6), -4.0);
  EXPECT_FALSE(input.tools.front().drive);
  EXPECT_FALSE(input.tools.front().velocity[0]) << "zero";
}

TEST(Tools, MassAndForceArePerThicknessOrOfTheWholeBody) {
  const Case plane =
      read_case_text(with_press("mass = \"2 t/m\"\nforce = { y = { value = \"-5 kN/mm\", ramp = "
                                "\"1 us\" } }\ndirection = \"0 -3\"\n"
                                "initial_velocity = \"0 -2 m/s\""),
                     "x");
  ASSERT_TRUE(plane.tools.front().drive);
  const contact::ToolDrive<3>& drive = *plane.tools.front().drive;
  EXPECT_EQ(drive.mass, 2000.0);
  EXPECT_NEAR(drive.force[1](0.5e-6), -2.5e6, 1e-6);
  EXPECT_EQ(drive.force[0](1.0), 0.0);
  EXPECT_EQ(drive.free, Mat<3>(Vec3(0, 1, 0).asDiagonal()));
  EXPECT_EQ(drive.initial_velocity, Vec3(0, -2, 0));
  const Case far = read_case_text(with_press("mass = \"2 t/m\"\ndirection = \"0 -1e200\""), "x");
  EXPECT_EQ(far.tools.front().drive->free, drive.free) << "of any length";
  const std::string round = "[analysis]\nkinematics = \"axisymmetric\"\n";
  const Case body = read_case_text(with_press("mass = \"2 kg\"\nforce = \"0 -5 kN\"", round), "x");
  EXPECT_EQ(body.tools.front().drive->mass, 2.0);
  EXPECT_EQ(body.tools.front().drive->force[1](1.0), -5000.0);
  EXPECT_EQ(body.tools.front().drive->free, Mat<3>(Vec3(0, 1, 0).asDiagonal()));
  const Case again = read_case_text(body.resolved, "x"); // the resolved case has its units, and no velocity
  EXPECT_EQ(again.tools.front().drive->mass, 2.0);
  EXPECT_EQ(again.resolved.substr(again.resolved.find('\n')), body.resolved.substr(body.resolved.find('\n')));
}

TEST(Tools, HangOnSpringsWhoseFarEndMayMove) {
  const std::string slide = "mass = \"20 kg/m\"\ndirection = \"0 -2\"\nvelocity = \"0 -3 m/s\"\n"
                            "damping = \"40 kN s/m2\"\n";
  const Case press = read_case_text(with_press(slide + "spring = { stiffness = \"2 GN/m2\" }"), "x");
  const contact::ToolDrive<3>& drive = *press.tools.front().drive;
  EXPECT_EQ(drive.damping, 4e4);
  ASSERT_TRUE(drive.spring);
  EXPECT_EQ(drive.spring->along, Vec3(0, -1, 0));
  EXPECT_EQ(drive.spring->spring.force(1e-4), 2e5);
  EXPECT_EQ(drive.spring->spring.charge(0.0), 1.0);
  EXPECT_EQ(press.tools.front().velocity[1].value()(0.0), -3.0) << "of the mount";
  const Case gas = read_case_text(
      with_press(slide +
                 "spring = { law = \"gas\", preload = \"200 kN/m\", length = \"20 mm\", exponent = 1.2, "
                 "ramp = \"20 us\" }"),
      "x");
  const contact::Spring& charged = gas.tools.front().drive->spring->spring;
  EXPECT_NEAR(charged.force(1e-2), 2e5 * std::pow(2.0, 1.2), 1e-6);
  EXPECT_EQ(charged.charge(0.0), 0.0);
  EXPECT_NEAR(charged.charge(1e-5), 0.5, 1e-12);
  const Case round =
      read_case_text(with_press("mass = \"2 kg\"\ndirection = \"0 -1\"\ndamping = \"1 N s/m\"\n"
                                "spring = { law = \"table\", travel = \"0 10 mm\", forces = \"2 4 kN\" }",
                                "[analysis]\nkinematics = \"axisymmetric\"\n"),
                     "x");
  EXPECT_EQ(round.tools.front().drive->spring->spring.force(5e-3), 3e3);
  const Case again = read_case_text(round.resolved, "x");
  EXPECT_EQ(again.resolved.substr(again.resolved.find('\n')),
            round.resolved.substr(round.resolved.find('\n')));
}

TEST(QuasiStatic, IsMeantWhereMassIsScaledOrACutIsReported) {
  EXPECT_FALSE(read_case_text(with_press(""), "x").time.quasi_static);
  EXPECT_TRUE(read_case_text(with_press(""), "x", {"time.mass_scaling.factor=25"}).time.quasi_static);
  EXPECT_TRUE(read_case_text(with_press(""), "x", {"time.quasi_static=true"}).time.quasi_static);
  EXPECT_FALSE(read_case_text(with_press(""), "x", {"time.mass_scaling.factor=25", "time.quasi_static=false"})
                   .time.quasi_static);
}

TEST(Ramps, OfTemperatureStartFromTheInitialOne) {
  const std::string bath =
      "[boundary.bath]\npieces = \"top\"\ntemperature = { value = \"400 K\", ramp = \"2 us\" }\n"
      "[materials.m.heat]\nspecific_heat = \"500 J/(kg K)\"\nconductivity = \"50 W/(m K)\"\n"
      "[boundary.air]\npieces = \"left\"\n"
      "convection = { coefficient = \"10 W/(m2 K)\", ambient = { value = \"500 K\", ramp = \"2 us\" } }\n";
  EXPECT_EQ(read_case_text(with_press("") + bath, "x").boundary[0].temperature.value()(1e-6),
            0.5 * (293.15 + 400.0));
  const Case warm = read_case_text(with_press("") + bath, "x", {"initial.temperature=\"27 degC\""});
  EXPECT_NEAR(warm.boundary[0].temperature.value()(0.0), 300.15, 1e-12);
  EXPECT_NEAR(warm.boundary[1].convection.value().ambient(1e-6), 0.5 * (300.15 + 500.0), 1e-12);
  const Case again = read_case_text(warm.resolved, "x");
  EXPECT_EQ(again.boundary[0].temperature.value()(0.0), warm.boundary[0].temperature.value()(0.0));
}

TEST(MassScaling, IsAFactorAStepOrACell) {
  EXPECT_FALSE(read_case_text(with_press(""), "x").time.mass_scaling);
  const Case factor = read_case_text(with_press(""), "x", {"time.mass_scaling.factor=25"});
  EXPECT_EQ(factor.time.mass_scaling->factor, 25.0);
  EXPECT_EQ(factor.time.mass_scaling->step, 0.0);
  const Case step = read_case_text(with_press(""), "x", {"time.mass_scaling.step=\"20 ns\""});
  EXPECT_NEAR(step.time.mass_scaling->step, 20e-9, 1e-20);
  const Case cell = read_case_text(with_press(""), "x", {"time.mass_scaling.cell=\"20 um\""});
  EXPECT_DOUBLE_EQ(cell.time.mass_scaling->cell, 20e-6);
}

} // namespace
} // namespace cnem::input
