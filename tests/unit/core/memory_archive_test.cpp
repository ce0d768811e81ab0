// An archive in memory: what goes in comes out with its bits, through another archive too.
#include "core/fields/memory_archive.hpp"

#include "core/error.hpp"

#include <bit>
#include <gtest/gtest.h>
#include <limits>

namespace cnem {
namespace {

/// One of each kind.
struct Things {
  double time = 0.1;
  Field field{-0.0, std::numeric_limits<double>::quiet_NaN(), 5e-324};
  Field nothing;
  std::vector<double> list{0.5, 0.25};
  std::vector<std::int32_t> facets{1, -2, 3};
  std::int64_t step = std::int64_t{1} << 60;
  std::string name = "spät\nund mehr";
  std::vector<std::string> names{"a b", "", "c"};

  void archive(Archive& archive) {
    archive.number("time", "s", time);
    archive.field("things/field", "K", field);
    archive.field("things/nothing", "1", nothing);
    archive.list("list", "m", list);
    archive.integers("facets", facets);
    archive.integer("step", step);
    archive.text("name", name);
    archive.texts("names", names);
  }
};

Things blank() {
  return {.time = 7.0,
          .field = Field(3),
          .nothing = {},
          .list = {},
          .facets = {},
          .step = 0,
          .name = "",
          .names = {}};
}

void expect_same(const Things& a, const Things& b) {
  EXPECT_EQ(a.time, b.time);
  ASSERT_EQ(a.field.size(), b.field.size());
  for (std::size_t i = 0; i < a.field.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.field[i]), std::bit_cast<std::uint64_t>(b.field[i])) << i;
  EXPECT_EQ(a.list, b.list);
  EXPECT_EQ(a.facets, b.facets);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.names, b.names);
}

TEST(MemoryArchive, gives_back_every_kind_bit_for_bit_as_often_as_asked) {
  Things things;
  MemoryArchive memory;
  EXPECT_TRUE(memory.empty());
  things.archive(memory);
  EXPECT_FALSE(memory.empty());
  memory.recall();
  for (int time = 0; time < 2; ++time) {
    Things back = blank();
    back.archive(memory);
    expect_same(back, things);
  }
}

TEST(MemoryArchive, goes_through_another_archive) {
  Things things;
  MemoryArchive memory, file, again;
  things.archive(memory);
  memory.archive(file, "folder");
  file.recall();
  again.archive(file, "folder");
  again.recall();
  Things back = blank();
  back.archive(again);
  expect_same(back, things);

  MemoryArchive empty, file_of_nothing;
  empty.archive(file_of_nothing, "folder");
  file_of_nothing.recall();
  again.archive(file_of_nothing, "folder");
  EXPECT_TRUE(again.empty());
}

TEST(MemoryArchive, refuses_what_it_lacks_or_holds_otherwise) {
  MemoryArchive memory;
  Things().archive(memory);
  memory.recall();
  double number = 0.0;
  std::string text;
  Field longer(4);
  EXPECT_THROW(memory.number("absent", "1", number), IoError);
  EXPECT_THROW(memory.number("step", "1", number), IoError);
  EXPECT_THROW(memory.text("time", text), IoError);
  EXPECT_THROW(memory.field("things/field", "K", longer), IoError);
}

TEST(MemoryArchive, forgets_what_it_had) {
  MemoryArchive memory;
  Things().archive(memory);
  memory.clear();
  EXPECT_TRUE(memory.empty());
  EXPECT_FALSE(memory.loading());
}

} // namespace
} // namespace cnem
