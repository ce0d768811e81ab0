// Checkpoint files: what is carried comes back bit for bit; files that are not whole are refused with the
// reason.
#include "results/checkpoint.hpp"

#include "core/error.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/output_folder.hpp"
#include "tests/temporary_folder.hpp"

#include <bit>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>

namespace cnem::results {
namespace {

namespace fs = std::filesystem;

/// One of each kind.
struct Things {
  double time = 0.1;
  Vec2 force{1.0 / 3.0, -0.0};
  Field temperature{293.15, std::numeric_limits<double>::quiet_NaN(), 5e-324};
  Fields<2> position{Field{1.0, 2.0}, Field{-std::numeric_limits<double>::infinity(), 4.0}};
  Field nothing;
  std::vector<double> weights{0.5, 0.25, 0.125};
  std::int64_t step = std::int64_t{1} << 60;
  int age = -3;
  std::string name = "spät";
  std::string empty;
  std::vector<std::string> names{"a b", "", "c"};

  void archive(Archive& archive) {
    archive.number("things/time", "s", time);
    archive.vector<2>("things/force", "N/m", force);
    archive.field("things/temperature", "K", temperature);
    archive.field("things/position", "m", position);
    archive.field("things/nothing", "1", nothing);
    archive.list("things/weights", "1", weights);
    archive.integer("step", step);
    archive.integer("age", age);
    archive.text("name", name);
    archive.text("empty", empty);
    archive.texts("names", names);
  }
};

std::string content_of(Things things) {
  CheckpointWriter writer;
  things.archive(writer);
  return writer.content();
}

std::string refusal_of(const std::string& content) {
  try {
    const CheckpointReader reader(content);
  } catch (const IoError& error) { return error.what(); }
  return "accepted";
}

void expect_same_bits(const Field& a, const Field& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i])) << i;
}

TEST(Checkpoint, carries_every_kind_bit_for_bit) {
  const Things before;
  Things after{.time = 0,
               .force = {7, 7},
               .temperature = Field(3),
               .position = {Field(2), Field(2)},
               .nothing = {},
               .weights = {},
               .step = 0,
               .age = 0,
               .name = "",
               .empty = "x",
               .names = {}};
  CheckpointReader reader(content_of(before));
  after.archive(reader);
  EXPECT_EQ(after.time, before.time);
  EXPECT_EQ(after.force, before.force);
  EXPECT_TRUE(std::signbit(after.force.y()));
  expect_same_bits(after.temperature, before.temperature);
  for (std::size_t k = 0; k < 2; ++k) expect_same_bits(after.position[k], before.position[k]);
  EXPECT_EQ(after.weights, before.weights);
  EXPECT_EQ(after.step, before.step);
  EXPECT_EQ(after.age, before.age);
  EXPECT_EQ(after.name, before.name);
  EXPECT_EQ(after.empty, before.empty);
  EXPECT_EQ(after.names, before.names);
  EXPECT_EQ(content_of(before), content_of(after)) << "the same quantities make the same file";
}

TEST(Checkpoint, what_is_absent_or_of_another_kind_is_named) {
  const auto message = [](auto&& read) -> std::string {
    CheckpointReader reader(content_of(Things()));
    try {
      read(reader);
    } catch (const IoError& error) { return error.what(); }
    return "accepted";
  };
  Field four(4);
  double number = 0.0;
  std::vector<double> list;
  EXPECT_NE(
      message([&](Archive& a) { a.number("things/pressure", "Pa", number); }).find("lacks 'things/pressure'"),
      std::string::npos);
  EXPECT_NE(message([&](Archive& a) { a.list("things/pressure", "Pa", list); }).find("lacks"),
            std::string::npos);
  EXPECT_NE(
      message([&](Archive& a) { a.field("things/temperature", "K", four); }).find("3 values, expected 4"),
      std::string::npos);
  EXPECT_NE(message([&](Archive& a) { a.number("step", "1", number); }).find("another type"),
            std::string::npos);
}

TEST(Checkpoint, files_that_are_no_checkpoint_are_refused_with_the_reason) {
  const std::string good = content_of(Things());
  EXPECT_EQ(refusal_of(good), "accepted");
  EXPECT_NE(refusal_of("").find("empty"), std::string::npos);
  EXPECT_NE(refusal_of("time[s],step\n0,0\n").find("no checkpoint"), std::string::npos);
  EXPECT_NE(refusal_of(good.substr(512)).find("HDF5 file, but no checkpoint"), std::string::npos);
  std::string other = good;
  const std::string format = fmt::format("format {}", checkpoint_format);
  other.replace(other.find(format), format.size(), "format 1");
  EXPECT_NE(refusal_of(other).find(
                fmt::format("format 1, this version of cnem reads format {}", checkpoint_format)),
            std::string::npos);
}

TEST(Checkpoint, a_file_cut_anywhere_is_refused) {
  const std::string good = content_of(Things());
  for (std::size_t length = 0; length < good.size(); length += 97)
    EXPECT_NE(refusal_of(good.substr(0, length)), "accepted") << length;
  EXPECT_NE(refusal_of(good.substr(0, good.size() - 1)).find("cut short"), std::string::npos);
  EXPECT_NE(refusal_of(good + "x").find("damaged"), std::string::npos);
}

TEST(Checkpoint, a_flipped_bit_anywhere_is_seen) {
  const std::string good = content_of(Things());
  for (std::size_t at = 0; at < good.size(); at += at < 512 ? 1 : 13) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ (1 << (at % 8)));
    EXPECT_NE(refusal_of(bad), "accepted") << at;
  }
}

class CheckpointFolder : public ::testing::Test {
protected:
  std::vector<std::string> contents() const {
    std::vector<std::string> list;
    for (const fs::path& path : list_checkpoints(folder)) list.push_back(read_file(path));
    return list;
  }
  const cnem::testing::TemporaryFolder temporary{"checkpoints"};
  const fs::path& folder = temporary.path();
};

using Texts = std::vector<std::string>;

TEST_F(CheckpointFolder, keeps_the_last_ones_newest_first) {
  EXPECT_EQ(contents(), Texts{});
  for (const char* text : {"a", "b", "c", "d"}) add_checkpoint(folder, text, 3);
  EXPECT_EQ(contents(), (Texts{"d", "c", "b"}));
  EXPECT_EQ(read_file(folder / "checkpoint.h5"), "d");
  EXPECT_EQ(read_file(folder / "checkpoint.2.h5"), "b");
  add_checkpoint(folder, "e", 1);
  EXPECT_EQ(contents(), Texts{"e"});
}

TEST_F(CheckpointFolder, goes_on_after_an_interruption_between_its_renames) {
  for (const char* text : {"a", "b", "c"}) add_checkpoint(folder, text, 3);
  fs::rename(folder / "checkpoint.1.h5", folder / "checkpoint.2.h5"); // killed here
  EXPECT_EQ(contents(), (Texts{"c", "b"}));
  fs::create_hard_link(folder / "checkpoint.h5", folder / "checkpoint.1.h5"); // or here
  add_checkpoint(folder, "d", 3);
  EXPECT_EQ(contents(), (Texts{"d", "c", "c"}));
}

TEST_F(CheckpointFolder, other_files_are_not_checkpoints) {
  for (const char* name :
       {"checkpoint.x.h5", "checkpoint.01.h5", "checkpoint.refused.h5", "checkpoint.1.h5.tmp"})
    std::ofstream(folder / name) << name;
  EXPECT_EQ(contents(), Texts{});
}

TEST_F(CheckpointFolder, a_write_that_fails_leaves_the_old_ones) {
  add_checkpoint(folder, "a", 2);
  fs::create_directories(folder / "sub");
  EXPECT_THROW(add_checkpoint(folder / "absent", "b", 2), IoError);
  EXPECT_EQ(contents(), Texts{"a"});
}

} // namespace
} // namespace cnem::results
