// What the results of a file are named after.
#include "core/error.hpp"
#include "input/case_reader.hpp"

#include <gtest/gtest.h>

namespace cnem::input {
namespace {

TEST(NameAfter, is_the_file_or_the_folder_of_a_generic_one) {
  EXPECT_EQ(name_after("a/blank.toml", "case"), "blank");
  EXPECT_EQ(name_after("a/.toml", "case"), ".toml");
  for (const char* file : {"a/case.toml", "a/b/../case.toml", "a/case.resolved.toml"})
    EXPECT_EQ(name_after(file, "case"), "a");
  for (const char* file : {"...toml", "..toml", "/case.toml"})
    EXPECT_THROW(name_after(file, "case"), InputError) << file;
}

} // namespace
} // namespace cnem::input
