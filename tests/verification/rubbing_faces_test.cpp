// What rubs and conducts at a node is the face that touches, not the faces beside it round a rim.
#include "input/case_reader.hpp"
#include "tests/finished_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace cnem::testing {
namespace {

/// A block of 3 × 2 × 1 mm, 0.5 mm, on a plane tool that it touches with one face.
FinishedRun block_on_a_plane(const std::string& more) {
  return finish(input::read_case_text(R"toml(
[analysis]
kinematics = "three-dimensional"
[domain]
material = "m"
block = { from = "0 0 0 mm", to = "3 2 1 mm", grid = false }
[cloud]
spacing = "0.5 mm"
[materials.m]
density = "2700 kg/m3"
elastic = { young = "70 GPa", poisson = 0.0 }
heat = { specific_heat = "900 J/(kg K)", conductivity = "20000 W/(m K)" }
[output]
history_every = "5 us"
pictures = []
)toml" + more,
                                      "case.toml"));
}

TEST(RubbingFaces, friction_at_its_limit_is_the_limit_times_the_area) {
  const FinishedRun done = block_on_a_plane(R"toml(
[time]
end = "60 us"
[boundary.top]
pieces = "z+"
velocity = { x = "0 m/s", y = "0 m/s", z = { times = "0 10 20 200 us", values = "0 -0.1 0 0 m/s" } }
[tools.low]
plane = { at = "0 0 0 mm", normal = "0 0 1" }
velocity = { x = { value = "5 m/s", ramp = "20 us" } }
friction = { law = "coulomb", coefficient = 1.0, shear_limit = "20 MPa" }
)toml");
  EXPECT_NEAR(std::abs(done.mean("low.force_x", 30e-6, 60e-6)), 20e6 * 6e-6, 0.5);
}

/// Newton's law of cooling of one that conducts well, while it is pressed.
TEST(RubbingFaces, heat_goes_through_the_faces_that_touch) {
  const FinishedRun done = block_on_a_plane(R"toml(
[time]
end = "300 us"
[initial]
temperature = "600 K"
[tools.low]
plane = { at = "0 0 0 mm", normal = "0 0 1" }
heat = { conductance = "2 MW/(m2 K)", temperature = "300 K" }
[tools.up]
plane = { at = "0 0 1 mm", normal = "0 0 -1" }
velocity = { z = { value = "-0.05 m/s", ramp = "10 us", smooth = true } }
heat = { conductance = "1 MW/(m2 K)", temperature = "400 K" }
[output.probes.a]
at = "1.5 1 0.5 mm"
fields = ["temperature"]
)toml");
  const double rate = 3e6 / (2700.0 * 900.0 * 1e-3), equilibrium = 1000.0 / 3.0; // 1/s, K
  const std::vector<double>&time = done.of("time"), &temperature = done.of("probe.a.temperature");
  const auto above = [&](double t) {
    const auto row = std::lower_bound(time.begin(), time.end(), t - 1e-9) - time.begin();
    return temperature.at(static_cast<std::size_t>(row)) - equilibrium;
  };
  EXPECT_NEAR(std::log(above(100e-6) / above(300e-6)) / (200e-6 * rate), 1.0, 0.03);
}

} // namespace
} // namespace cnem::testing
