// Cuts whose tool answers nodes inside it as papers 000 and 003 have it, against the exact contact.
#include "adapted_run.hpp"

namespace cnem::testing {
namespace {

const std::string answered_cut = aluminium_cut + R"toml(
[cloud]
spacing = "0.12 mm"
[adapt]
tool_spacing = "15 um"
surface_spacing = "0.03 mm"
indicator = { h_min = "0.03 mm", h_max = "0.06 mm" }
[output]
fields_every = "0 s"
)toml";

double force(const Adapted& of) { return of.metric("cutting.Fc"); }

TEST(ToolResponse, a_penalty_spring_cuts_with_nearly_the_force_of_exact_contact) {
  const Adapted exact = testing::run(answered_cut),
                spring = testing::run(
                    answered_cut, {"tools.cutter.response.law=penalty", "tools.cutter.response.scale=0.1"});
  EXPECT_NEAR(force(spring), force(exact), 0.02 * force(exact));
  EXPECT_NE(force(spring), force(exact));
}

TEST(ToolResponse, the_scheme_of_contact_is_that_of_all_tools_without_a_response) {
  const std::string scheme = "contact.scheme=central-difference";
  const auto tool = [](const Texts& overrides) {
    return input::read_case_text(answered_cut, "case.toml", overrides).tools.front().response;
  };
  EXPECT_TRUE(tool({}).exact());
  EXPECT_TRUE(tool({scheme}).is<contact::Penalty>());
  EXPECT_EQ(tool({scheme}).step_share(), contact::Penalty{2.0}.step_share());
  EXPECT_TRUE(tool({scheme, "tools.cutter.response.law=exact"}).exact());
  // with spacings of 0.118 to 0.125 mm and two instruction sets the residual is 0.25 to 1.5%, by chance
  const double exact = force(testing::run(answered_cut)),
               springs = force(testing::run(answered_cut, {scheme}, 2e-2));
  EXPECT_NEAR(springs, exact, 0.1 * exact);
  EXPECT_NE(springs, exact);
}

TEST(ToolResponse, a_kinematic_tool_has_no_force_across_its_motion) {
  const Adapted run = testing::run(answered_cut, {"tools.cutter.response.law=kinematic"});
  EXPECT_GT(force(run), 0.0);
  EXPECT_EQ(run.metric("cutting.Ft"), 0.0);
}

} // namespace
} // namespace cnem::testing
