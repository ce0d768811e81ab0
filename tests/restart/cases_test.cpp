// The same bits for any number of threads, and after a restart: every case in the repository, its first
// steps, or whole runs with all threads when CNEM_WHOLE_RUNS is set.
#include "core/machine/isa.hpp"
#include "input/case_machining.hpp"
#include "input/case_reader.hpp"
#include "input/case_structure.hpp"
#include "results/output_folder.hpp"
#include "tests/restart/process.hpp"
#include "tests/restart/runs.hpp"
#include "tests/temporary_folder.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

namespace fs = std::filesystem;

/// Files below cases/: every case.toml, and what stands beside one and has state of its own.
const std::vector<fs::path>& all_cases() {
  static const std::vector<fs::path> files = [] {
    const fs::path root = fs::path(CNEM_SOURCE_DIR) / "cases";
    std::vector<fs::path> found{root / "milling/wall_lobes/part.toml",
                                root / "milling/wall_removal/passes.toml"};
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root))
      if (entry.path().filename() == "case.toml") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }();
  return files;
}

/// As tests are called: two folders may hold a case of the same name.
std::string name_of(const fs::path& input) {
  const fs::path folder = input.parent_path();
  const std::string name = folder.parent_path().filename().string() + "_" + folder.filename().string();
  return input.stem() == "case" ? name : name + "_" + input.stem().string();
}

bool is_of(const fs::path& input, input::Analysis::Type type) {
  return input::read_case(input.string()).analysis.type == type;
}
bool is_explicit(const fs::path& input) { return is_of(input, input::Analysis::Type::explicit_dynamics); }

bool is_in_space(const fs::path& input) {
  return input.parent_path().parent_path().filename() == "three_dimensions";
}

bool is_milling(const fs::path& input) { return input::read_case(input.string()).analysis.of_milling(); }

/// The command line of a case, with pictures of one field where it has any, or a chart of few points.
std::vector<std::string> run_with_few_pictures(const fs::path& input, const fs::path& output, int threads) {
  std::vector<std::string> words{"run",           input.string(), "--output",
                                 output.string(), "--threads",    std::to_string(threads)};
  if (is_of(input, input::Analysis::Type::modes)) return words;
  if (is_of(input, input::Analysis::Type::removal))
    words.insert(words.end(), {"--set", "removal.duration=4 ms"});
  else if (is_milling(input)) {
    const input::Case read = input::read_case(input.string());
    const auto& machining = read.machining;
    const bool high = machining->blank && machining->blank->height > machining->axial_depth;
    words.insert(words.end(),
                 {"--set", "stability.speeds=9", "--set", "stability.depths=10", "--set",
                  high ? "dexels.layers=45" : "dexels.layers=90"}); // enough for threads to share
    constexpr double turns = 12.0, longest = 1.2e-3;                // m
    const double of_turn = machining->cut.feed * static_cast<double>(machining->cut.cutter.teeth());
    if (machining->passes.empty())
      words.insert(words.end(),
                   {"--set", fmt::format("milling.length={} mm", 1e3 * std::min(longest, turns * of_turn))});
    else if (read.structure && read.structure->part &&
             read.structure->part->newmark) // with all unknowns: short steps or none
      words.insert(words.end(),
                   {"--set", "milling.feed=1.5 mm", "--set", "dexels.steps=180", "--set", "dexels.layers=3"});
    else
      words.insert(words.end(), {"--set", "milling.feed=1 mm", "--set", "dexels.steps=60"});
  } else
    words.insert(words.end(), {"--set", "output.picture_fields=[\"pressure\"]"});
  return words;
}

/// Runs a case with 1 and 7 threads, whole runs with 2, 3 and 4, too; in space, where a step takes longer,
/// fewer steps with 1 and 3. Then the one with 1 loses what it wrote after its last checkpoint, some steps
/// before its end, and is restarted with 2 (whole runs are not).
void expect_same_bits(const fs::path& input, const std::string& isa,
                      const std::vector<std::string>& set = {}) {
  const testing::TemporaryFolder temporary("threads");
  const fs::path& folder = temporary.path();
  const bool whole = std::getenv("CNEM_WHOLE_RUNS") != nullptr, few = is_in_space(input) && !whole,
             of_steps = is_explicit(input),
             restarts = !whole && (of_steps || is_of(input, input::Analysis::Type::milling) ||
                                   is_of(input, input::Analysis::Type::removal));
  for (const int threads : {1, 2, 3, 4, 7}) {
    if (!whole && threads != 1 && threads != (few ? 3 : 7)) continue;
    const fs::path output = folder / fmt::format("{}", threads);
    std::vector<std::string> words = run_with_few_pictures(input, output, threads);
    const int steps = few ? 40 : 200;
    if (of_steps && !whole)
      words.insert(words.end(),
                   {"--set", fmt::format("time.max_steps={}", steps), "--set", "output.history_every=0 s",
                    "--set", fmt::format("output.checkpoint.every_steps={}", steps * 5 / 12)});
    else if (restarts)
      words.insert(words.end(), {"--set", "output.checkpoint.every_steps=100"});
    words.insert(words.end(), set.begin(), set.end());
    const Ending ending = run_cnem(words, 0, {"CNEM_ISA=" + isa});
    ASSERT_EQ(ending.code, 0) << ending.printed;
    EXPECT_EQ(difference(folder / "1", output), "") << threads << " threads";
    if (threads > 1) fs::remove_all(output);
  }
  if (!restarts) return;
  fs::copy(folder / "1", folder / "restarted", fs::copy_options::recursive);
  fs::remove(folder / "restarted" / results::files::status);
  const Ending rest =
      run_cnem({"restart", (folder / "restarted").string(), "--threads", "2"}, 0, {"CNEM_ISA=" + isa});
  EXPECT_EQ(rest.code, 0) << rest.printed;
  EXPECT_NE(rest.printed.find("going on from"), std::string::npos) << rest.printed;
  EXPECT_EQ(difference(folder / "1", folder / "restarted"), "") << "restarted";
}

class Threads : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Threads, and_a_restart_do_not_change_the_bits) {
  expect_same_bits(all_cases()[GetParam()], std::string(isa_name(active_isa())));
}
INSTANTIATE_TEST_SUITE_P(Of, Threads, ::testing::Range(std::size_t{0}, all_cases().size()),
                         [](const auto& index) { return name_of(all_cases()[index.param]); });

TEST(ThreadsWith, every_instruction_set_do_not_change_the_bits) {
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512})
    if (isa_supported(isa) && isa != active_isa())
      expect_same_bits(fs::path(CNEM_SOURCE_DIR) / "cases/verification/taylor_304l/case.toml",
                       std::string(isa_name(isa)));
}

TEST(ThreadsWith, pressure_exchange_do_not_change_the_bits) {
  expect_same_bits(fs::path(CNEM_SOURCE_DIR) / "cases/verification/taylor_slab_copper/case.toml",
                   std::string(isa_name(active_isa())), {"--set", "method.pressure_exchange=0.3"});
}

TEST(ThreadsWith, new_references_do_not_change_the_bits) {
  expect_same_bits(fs::path(CNEM_SOURCE_DIR) / "cases/paper/shearing_sharp/case.toml",
                   std::string(isa_name(active_isa())),
                   {"--set", "method.rereference.every=10", "--set", "time.max_steps=50", "--set",
                    "output.checkpoint.every_steps=20"});
}

} // namespace
} // namespace cnem::app
