// Computes all convergence tables and compares them with the committed baselines, and with what is claimed of
// the method. With CNEM_WRITE_BASELINES set, writes the baselines instead.
#include "tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace cnem::convergence {
namespace {

const std::string folder = CNEM_SOURCE_DIR "/cases/verification/convergence";

const std::vector<Table>& tables() {
  static const std::vector<Table> computed = all_tables();
  return computed;
}

const Table& table(const std::string& name) {
  for (const Table& t : tables())
    if (t.name == name) return t;
  throw std::out_of_range(name);
}

double value(const Table& t, const std::string& method, std::size_t from_the_end) {
  for (const Row& row : t.rows)
    if (row.method == method) return row.values[row.values.size() - 1 - from_the_end];
  throw std::out_of_range(method);
}

TEST(Convergence, tables_are_those_committed) {
  if (std::getenv("CNEM_WRITE_BASELINES")) {
    write_baselines(folder, tables());
    GTEST_SKIP() << "wrote " << folder;
  }
  for (const Table& now : tables()) {
    const Table then = read_baseline(folder, now.name);
    ASSERT_EQ(now.rows.size(), then.rows.size()) << now.name;
    for (std::size_t r = 0; r < now.rows.size(); ++r) {
      SCOPED_TRACE(now.name + ", " + now.rows[r].method);
      EXPECT_EQ(now.rows[r].method, then.rows[r].method);
      ASSERT_EQ(now.rows[r].values.size(), then.rows[r].values.size());
      // The patch is exact: only that it stays so, not its rounding.
      const bool exact = now.name == "affine_patch";
      for (std::size_t k = 0; k < now.rows[r].values.size(); ++k) {
        const double a = now.rows[r].values[k], b = then.rows[r].values[k];
        const bool is_order = exact && k + 2 >= now.rows[r].values.size();
        if (is_order) continue;
        if (exact && k % 3 != 0)
          EXPECT_LT(a, 1e-12);
        else
          EXPECT_NEAR(a, b, 1e-3 * std::abs(b) + 1e-6);
      }
    }
  }
}

TEST(Convergence, orders_are_two_in_displacement_and_one_in_energy) {
  for (const char* name : {"plate_with_hole", "thick_cylinder", "cantilever"})
    for (const char* method : {"Sibson, 1 point", "Sibson, 2 points", "Sibson, 3 points"}) {
      SCOPED_TRACE(std::string(name) + ", " + method);
      // The coarse plate has three cells along the hole: its order is still rising.
      EXPECT_GT(value(table(name), method, 1), std::string(name) == "plate_with_hole" ? 1.85 : 1.9);
      EXPECT_GT(value(table(name), method, 0), 0.95);
    }
}

TEST(Convergence, nearly_incompressible_membrane_is_within_1_percent_at_16_by_16) {
  EXPECT_NEAR(value(table("cook_0.4999"), "Sibson, 2 points", 1), 16.45, 0.01 * 16.45);
}

TEST(Convergence, stress_is_more_accurate_than_with_triangles_in_every_table) {
  for (const char* name : {"plate_with_hole", "thick_cylinder", "cantilever"})
    EXPECT_LT(value(table(name), "Sibson, 2 points", 2), value(table(name), "FE triangles", 2)) << name;
}

} // namespace
} // namespace cnem::convergence
