#include "core/machine/isa.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace cnem {
namespace {

TEST(isa, names_and_refusals) {
  EXPECT_EQ(isa_name(Isa::baseline), "baseline");
  EXPECT_EQ(isa_name(Isa::avx2), "avx2");
  EXPECT_EQ(isa_name(Isa::avx512), "avx512");
  EXPECT_TRUE(isa_supported(Isa::baseline));
  const Isa before = active_isa();
  for (Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (!isa_supported(isa)) {
      EXPECT_THROW(set_isa(isa), InputError);
      continue;
    }
    set_isa(isa);
    EXPECT_EQ(active_isa(), isa);
  }
  set_isa(before);
}

/// 0 for baseline, 1 for another, 2 for an error; in a fresh process, because the variable is read once.
[[noreturn]] void exit_with_choice(const char* variable) {
  setenv("CNEM_ISA", variable, 1);
  try {
    std::_Exit(active_isa() == Isa::baseline ? 0 : 1);
  } catch (const InputError& e) {
    std::fputs(e.what(), stderr);
    std::_Exit(2);
  }
}

TEST(isa, environment_variable) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(exit_with_choice("baseline"), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(exit_with_choice("sse9"), ::testing::ExitedWithCode(2),
              "CNEM_ISA = \"sse9\": expected an instruction set that this machine has: baseline");
  for (const Isa isa : {Isa::avx2, Isa::avx512})
    if (!isa_supported(isa)) {
      EXPECT_EXIT(exit_with_choice(std::string(isa_name(isa)).c_str()), ::testing::ExitedWithCode(2),
                  "this machine has: baseline");
    }
}

} // namespace
} // namespace cnem
