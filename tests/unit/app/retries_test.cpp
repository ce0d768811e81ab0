// Going back after a failure: how often, to which state, and how soon references are renewed then.
#include "app/retries.hpp"

#include <gtest/gtest.h>

namespace cnem::app {
namespace {

const DivergenceError inverted("a cell turned inside out", 3, "deformation gradient");

/// A run whose state is one number.
struct NumberRun {
  double state = 0.0;
  Retries::Course course() {
    return [this](Archive& archive) { archive.number("state", "1", state); };
  }
  void pass(Retries& retries, double time) {
    state = time;
    retries.take(time, course());
    retries.keep();
  }
  void fail(Retries& retries, double time) {
    ASSERT_TRUE(retries.may_go_back(inverted));
    retries.go_back(time, "failure at " + std::to_string(time), course());
  }
};

TEST(Retries, halve_the_strain_three_times_and_then_give_up) {
  Retries retries(true);
  NumberRun run;
  EXPECT_TRUE(retries.lacks_state());
  EXPECT_FALSE(retries.may_go_back(inverted)) << "there is nothing to go back to";
  run.pass(retries, 1.0);
  EXPECT_EQ(retries.strain_share(), 1.0);
  for (const double share : {0.5, 0.25, 0.125}) {
    run.state = 9.0;
    run.fail(retries, 2.0);
    EXPECT_EQ(run.state, 1.0);
    EXPECT_EQ(retries.strain_share(), share);
    run.pass(retries, 1.5); // the state before the failure stays
  }
  EXPECT_FALSE(retries.may_go_back(inverted));
  EXPECT_EQ(retries.count(), 3);
  EXPECT_NE(retries.warning().find("3 times"), std::string::npos);
  EXPECT_NE(retries.warning().find("failure at 2"), std::string::npos);
}

TEST(Retries, the_strain_of_the_case_returns_as_far_behind_the_failure_as_the_state_was_before_it) {
  Retries retries(true);
  NumberRun run;
  run.pass(retries, 1.0);
  run.fail(retries, 3.0);
  run.fail(retries, 2.0); // sooner: the margin is still that of the later one
  retries.look(4.9);
  EXPECT_EQ(retries.strain_share(), 0.25);
  retries.look(5.1);
  EXPECT_EQ(retries.strain_share(), 1.0);
  EXPECT_TRUE(retries.lacks_state()) << "the old one would lead the same way again";
  run.pass(retries, 5.2);
  run.fail(retries, 5.3);
  EXPECT_EQ(run.state, 5.2);
  EXPECT_EQ(retries.strain_share(), 0.5);
  EXPECT_EQ(retries.count(), 3);
}

TEST(Retries, a_new_reference_that_fails_is_not_gone_back_to) {
  Retries retries(true);
  NumberRun run;
  run.pass(retries, 1.0);
  run.state = 2.0;
  retries.take(2.0, run.course()); // never kept
  run.fail(retries, 2.0);
  EXPECT_EQ(run.state, 1.0);
}

TEST(Retries, nothing_is_remembered_where_no_strain_renews_the_reference) {
  Retries retries(false);
  NumberRun run;
  EXPECT_FALSE(retries.lacks_state());
  run.pass(retries, 1.0);
  EXPECT_FALSE(retries.may_go_back(inverted));
}

TEST(Retries, a_tool_that_is_too_fast_stays_too_fast) {
  Retries retries(true);
  NumberRun run;
  run.pass(retries, 1.0);
  EXPECT_FALSE(retries.may_go_back(DivergenceError("too fast", 3, "tool velocity")));
}

TEST(Retries, go_through_a_checkpoint) {
  Retries before(true), after(true);
  NumberRun run;
  run.pass(before, 1.0);
  run.fail(before, 2.0);
  MemoryArchive checkpoint;
  before.archive(checkpoint);
  checkpoint.recall();
  after.archive(checkpoint);
  EXPECT_EQ(after.count(), 1);
  EXPECT_EQ(after.strain_share(), 0.5);
  EXPECT_EQ(after.warning(), before.warning());
  run.state = 7.0;
  run.fail(after, 2.0);
  EXPECT_EQ(run.state, 1.0);
  after.look(2.9);
  EXPECT_EQ(after.strain_share(), 0.25);
  after.look(3.1);
  EXPECT_EQ(after.strain_share(), 1.0);
}

} // namespace
} // namespace cnem::app
