#include "core/error.hpp"
#include "core/rpm.hpp"
#include "machining/structure/shaft.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

using namespace cnem;
using namespace cnem::machining;

namespace {

constexpr double pi = std::numbers::pi, rigid = std::numeric_limits<double>::infinity();

ShaftSection rod(double from, double to) {
  return {.from = from,
          .to = to,
          .diameter = 0.05,
          .bore = 0.0,
          .solid = {2.1e11, 0.3, 7800.0},
          .shear_correction = 0.886};
}
Bearing pin(double at) {
  Bearing bearing;
  bearing.at = at;
  bearing.stiffness = rigid;
  return bearing;
}
double hertz(const Whirl& whirl) { return whirl.omega / (2.0 * pi); }

} // namespace

// Closed form of the simply supported Timoshenko shaft.
TEST(Shaft, Whirl) {
  const Shaft shaft({rod(0.0, 0.3)}, {pin(0.0), pin(0.3)}, 0.015);
  const auto still = whirls(shaft, 0.0, 2);
  EXPECT_NEAR(hertz(still[0]), 1096.10, 1e-3 * 1096.10 * 0.1);
  EXPECT_NEAR(hertz(still[1]), 1096.10, 1e-3 * 1096.10 * 0.1);
  for (const auto& [speed, backward, forward] :
       {std::array{20000.0, 1091.01, 1101.22}, {60000.0, 1080.87, 1111.51}}) {
    const auto both = whirls(shaft, speed * rpm, 2);
    EXPECT_NEAR(hertz(both[0]), backward, 1e-4 * backward);
    EXPECT_NEAR(hertz(both[1]), forward, 1e-4 * forward);
    EXPECT_NEAR(both[0].direction, -1.0, 1e-6);
    EXPECT_NEAR(both[1].direction, 1.0, 1e-6);
  }
}

// A clamped rod under a force at its end, of two pieces: exact with any number of elements.
TEST(Shaft, Deflection) {
  Bearing clamp = pin(0.0);
  clamp.tilt_stiffness = rigid;
  const double thin = 0.03;
  ShaftSection end = rod(0.1, 0.3);
  end.diameter = thin;
  const Shaft shaft({end, rod(0.0, 0.1)}, {clamp}, 1.0);
  const Eigen::MatrixXd tip = shaft.displacement_at(0.3);
  const double flexibility = (tip * shaft.stiffness().lu().solve(tip.transpose()))(0, 0);
  const auto inertia = [](double d) { return pi / 64.0 * d * d * d * d; };
  const auto shear = [](double d) { return 0.886 * 2.1e11 / 2.6 * pi / 4.0 * d * d; };
  const auto cube = [](double x) { return x * x * x; };
  const double exact = (cube(0.3) - cube(0.2)) / (3.0 * 2.1e11 * inertia(0.05)) +
                       cube(0.2) / (3.0 * 2.1e11 * inertia(thin)) + 0.1 / shear(0.05) + 0.2 / shear(thin);
  EXPECT_NEAR(flexibility / exact, 1.0, 1e-9);
}

// A stiff rod on two bearings: masses on springs, damped by them.
TEST(Shaft, Bearings) {
  ShaftSection stiff = rod(0.0, 0.1);
  stiff.solid.young = 1e16;
  std::vector<Bearing> bearings(2);
  bearings[1].at = 0.1;
  for (Bearing& bearing : bearings) {
    bearing.stiffness = 1e7;
    bearing.damping = 100.0;
  }
  const auto found = whirls(Shaft({stiff}, bearings, 0.02), 0.0, 1);
  const double mass = 7800.0 * pi / 4.0 * 0.0025 * 0.1, omega = std::sqrt(2e7 / mass);
  EXPECT_NEAR(found[0].omega / omega, 1.0, 1e-4);
  EXPECT_NEAR(found[0].damping, 200.0 / (2.0 * mass * omega), 1e-4 * found[0].damping);
}

TEST(Shaft, Cowper) {
  EXPECT_NEAR(circular_shear_correction(0.3, 0.0), 7.8 / 8.8, 1e-15);
  EXPECT_NEAR(circular_shear_correction(0.3, 1.0), 2.6 / 4.9, 1e-2 * 2.6 / 4.9); // a thin tube: 2(1+ν)/(4+3ν)
}

TEST(Shaft, PiecesThatDoNotMeet) {
  EXPECT_THROW(Shaft({rod(0.0, 0.1), rod(0.2, 0.3)}, {}, 0.01), InputError);
  EXPECT_THROW(Shaft({rod(0.0, 0.1)}, {pin(0.2)}, 0.01), InputError);
  EXPECT_THROW(Shaft({rod(0.0, 0.1)}, {}, 0.01).displacement_at(0.2), InputError);
}
