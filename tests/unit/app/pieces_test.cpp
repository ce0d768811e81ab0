// Runs within another program: in pieces, beside each other, without a folder, and what they are asked for.
#include "app/run.hpp"
#include "core/error.hpp"
#include "input/case_reader.hpp"
#include "tests/shared_cases.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace cnem::app {
namespace {

/// Pauses after so many steps, or stops; counts what it is told.
struct Watching final : RunObserver {
  explicit Watching(Request::Kind wanted = Request::Kind::pause, int steps = 1)
      : after{wanted}, every(steps), left(steps) {}
  void recorded(bool row, bool) override { rows += row ? 1 : 0; }
  Request request() override {
    if (left-- > 0) return {};
    left = every;
    return {after, "the test"};
  }
  Request::Kind after;
  int every, left, rows = 0;
};

const RunOptions in_memory_only{.output = {}, .threads = 1, .version = "test"};

input::Case punched(const std::string& end) {
  return input::read_case_text(cnem::testing::punched_block + "[time]\nend = \"" + end + "\"\n",
                               "punched.toml");
}

std::vector<Field> state_of(app::Run& run) {
  const auto shot = std::get<results::Snapshot<2>>(run.session().snapshot());
  return {shot.state.node.position[0], shot.state.node.position[1], shot.state.node.velocity[1],
          shot.state.point.plastic_strain, shot.state.node.temperature};
}

std::vector<Field> in_one_go(const input::Case& input) {
  RunObserver silent;
  app::Run run(input, in_memory_only, silent);
  EXPECT_EQ(run.go_on(), Exit::done);
  return state_of(run);
}

TEST(Pieces, of_two_runs_in_turns_have_the_bits_of_each_alone) {
  const input::Case cases[] = {punched("0.8 us"), punched("0.5 us")};
  Watching watching[] = {Watching(), Watching(Request::Kind::pause, 3)};
  app::Run first(cases[0], in_memory_only, watching[0]), second(cases[1], in_memory_only, watching[1]);
  std::optional<Exit> ends[2];
  int pieces = 0;
  for (; !ends[0] || !ends[1]; ++pieces) {
    if (!ends[0]) ends[0] = first.go_on();
    if (!ends[1]) ends[1] = second.go_on();
  }
  EXPECT_GT(pieces, 5);
  EXPECT_EQ(ends[0], Exit::done);
  EXPECT_EQ(first.go_on(), Exit::done); // and nothing changes
  EXPECT_EQ(state_of(first), in_one_go(cases[0]));
  EXPECT_EQ(state_of(second), in_one_go(cases[1]));
  EXPECT_EQ(first.session().history().columns()[0].size(), static_cast<std::size_t>(watching[0].rows));
}

TEST(Pieces, a_run_that_was_stopped_goes_on_in_memory_and_from_its_folder) {
  const cnem::testing::TemporaryFolder folder("pieces");
  const input::Case input = punched("0.5 us");
  const std::vector<Field> whole = in_one_go(input);
  Watching once(Request::Kind::stop, 4);
  app::Run in_memory(input, in_memory_only, once);
  EXPECT_EQ(in_memory.go_on(), Exit::interrupted);
  EXPECT_TRUE(in_memory.session().status().reason.starts_with("by the test at step"));
  once.after = Request::Kind::go_on;
  EXPECT_EQ(in_memory.go_on(), Exit::done);
  EXPECT_EQ(state_of(in_memory), whole);

  const RunOptions options{.output = folder.path() / "run", .threads = 1, .version = "test"};
  Watching stop(Request::Kind::stop, 4);
  app::Run stopped(input, options, stop);
  EXPECT_EQ(stopped.go_on(), Exit::interrupted);
  EXPECT_EQ(stopped.go_on(), Exit::interrupted); // its folder is another's by now
  RunObserver silent;
  app::Run again(options, silent);
  EXPECT_EQ(again.go_on(), Exit::done);
  EXPECT_EQ(state_of(again), whole);
  EXPECT_THROW(app::Run(options, silent), InputError);
}

} // namespace
} // namespace cnem::app
