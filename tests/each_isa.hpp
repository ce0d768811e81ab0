#pragma once
// Tests that run with each instruction set this machine has.
#include "core/machine/isa.hpp"

#include <gtest/gtest.h>
#include <string>

namespace cnem::testing {

/// Sets the instruction set of its parameter, and the one before afterwards.
struct EachIsa : ::testing::TestWithParam<Isa> {
  void SetUp() override {
    if (!isa_supported(GetParam())) GTEST_SKIP() << "this machine lacks " << isa_name(GetParam());
    set_isa(GetParam());
  }
  void TearDown() override { set_isa(isa_before); }
  Isa isa_before = active_isa();
};

inline auto every_isa() { return ::testing::Values(Isa::baseline, Isa::avx2, Isa::avx512); }
inline std::string name_of_isa(const ::testing::TestParamInfo<Isa>& parameter) {
  return std::string(isa_name(parameter.param));
}

} // namespace cnem::testing
