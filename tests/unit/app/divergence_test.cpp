// What counts as a divergence, and that the message names the place.
#include "app/divergence.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace cnem::app {
namespace {

State<2> three_nodes() {
  State<2> state;
  NodeState<2>& node = state.node;
  for (Fields<2>* fields : {&node.reference, &node.position, &node.velocity}) resize_all(*fields, 3, 0.5);
  node.mass.assign(3, 1.0);
  node.temperature.assign(3, 300.0);
  state.step = 12;
  return state;
}

TEST(Divergence, is_any_value_that_is_not_a_number) {
  EXPECT_NO_THROW(check_finite(three_nodes()));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const std::string name : {"temperature", "velocity", "position"}) {
      State<2> state = three_nodes();
      Field& field = name == "temperature" ? state.node.temperature
                     : name == "velocity"  ? state.node.velocity[1]
                                           : state.node.position[0];
      field[2] = bad;
      try {
        check_finite(state);
        ADD_FAILURE() << name;
      } catch (const DivergenceError& error) {
        EXPECT_EQ(error.node, 2);
        EXPECT_EQ(error.field, name);
        EXPECT_NE(std::string(error.what()).find("step 12"), std::string::npos) << error.what();
      }
    }
}

TEST(Divergence, is_a_temperature_below_absolute_zero) {
  State<2> state = three_nodes();
  state.node.temperature[1] = -1e-9; // rounding at 0 K
  EXPECT_NO_THROW(check_finite(state));
  state.node.temperature[1] = -40.0;
  try {
    check_finite(state);
    ADD_FAILURE();
  } catch (const DivergenceError& error) {
    EXPECT_EQ(error.node, 1);
    EXPECT_NE(std::string(error.what()).find("-40 K, below absolute zero"), std::string::npos)
        << error.what();
  }
}

TEST(Divergence, is_an_energy_residual_beyond_the_tolerance) {
  State<2> state = three_nodes();
  const EnergyScale work{1.0, "the work done"};
  EXPECT_NO_THROW(check_energy(-0.049, work, 0.05, state));
  state.node.velocity[0][1] = 7.0;
  for (const double residual : {0.051, -0.051, std::numeric_limits<double>::quiet_NaN()}) try {
      check_energy(residual, work, 0.05, state);
      ADD_FAILURE() << residual;
    } catch (const DivergenceError& error) { EXPECT_EQ(error.node, 1) << "the fastest"; }
  state.step = 9;
  EXPECT_NO_THROW(check_energy(0.2, work, 0.05, state)) << "too early to tell";
}

} // namespace
} // namespace cnem::app
