// Default cells of parts.
#include "input/case_reader.hpp"
#include "input/case_structure.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cnem::input {
namespace {

/// A wall of 90 × 50 × 4 mm, clamped below, that gets thinner by as many steps, of 0.4 mm.
machining::PartShape wall(int steps) {
  std::string text = "[analysis]\ntype = \"modes\"\n[part]\nsize = \"90 50 4 mm\"\nyoung = \"200 GPa\"\n"
                     "density = \"7800 kg/m3\"\nclamped = [\"y0\"]\n";
  for (int k = 0; k < steps; ++k)
    text += fmt::format("[part.zones.s{}]\nfrom = \"0 {} {} mm\"\nto = \"90 {} 4 mm\"\ntaken = 1\n", k,
                        10 + 8 * k, 3.6 - 0.4 * k, 18 + 8 * k);
  return read_case_text(text, "case.toml", {}).structure->part->shape;
}

TEST(PartCells, AreFewerAlongWhereManyStepsMakeMany) {
  EXPECT_EQ(wall(0).divisions[0], 29);
  EXPECT_GE(wall(1).divisions[0], 20);
  const machining::PartShape many = wall(5);
  EXPECT_LT(many.divisions[0], 20);
  EXPECT_GE(many.divisions[0], 10);
  EXPECT_LE(machining::cells_of(many), 3000U);
  EXPECT_EQ(many.more[2].size(), 10U) << "thin ones stand beside each step";
}

} // namespace
} // namespace cnem::input
