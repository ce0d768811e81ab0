// The ledger is made of the entries of the terms.
#include "mechanics/energy_ledger.hpp"
#include "tests/unit/mechanics/models.hpp"

#include <gtest/gtest.h>
#include <set>
#include <stdexcept>

namespace cnem::testing {
namespace {

TEST(EnergyLedger, adds_up_by_the_sides_of_its_entries) {
  const EnergyLedger ledger({{"kinetic", EnergyKind::held, 1.0},
                             {"elastic", EnergyKind::held, 2.0},
                             {"stabilisation", EnergyKind::held, 0.5},
                             {"plastic", EnergyKind::dissipated, 4.0},
                             {"penalty_release", EnergyKind::dissipated, 0.25},
                             {"tool_work", EnergyKind::received, 7.0},
                             {"inertial", EnergyKind::noted, 100.0}},
                            0.5);
  EXPECT_EQ(ledger.total(), 7.75);
  EXPECT_EQ(ledger.external(), 7.0);
  EXPECT_EQ(ledger.residual(), 0.25);
  EXPECT_EQ(ledger.deformation(), 6.75);
  EXPECT_EQ(ledger.kinetic_share(), 100.0 / 6.75);
  EXPECT_EQ(ledger["plastic"], 4.0);
  EXPECT_THROW(ledger["no such energy"], std::out_of_range);
}

TEST(EnergyLedger, of_a_run_names_each_entry_and_metric_once) {
  const ExplicitSolver<2> solver = start(model_of(rectangle(2e-3, 1e-3, 2e-4), Method::cnem, steel()),
                                         [](const Vec2&) { return Vec2(1.0, 0.0); });
  std::set<std::string> names;
  const EnergyLedger ledger = solver.ledger();
  for (const Energy& entry : ledger.entries()) EXPECT_TRUE(names.insert(entry.name).second);
  for (const char* name : {"kinetic", "elastic", "plastic", "stabilisation", "viscosity", "friction",
                           "heat_content", "resampling", "pressure_exchange", "load_work"})
    EXPECT_TRUE(names.count(name)) << name;
  for (const Metric& metric : solver.metrics()) EXPECT_TRUE(names.insert(metric.name).second);
  EXPECT_TRUE(std::isnan(metric_of(solver, "no such metric")));
  EXPECT_EQ(metric_of(solver, "volume_drift"), 0.0);
  EXPECT_NEAR(solver.ledger()["kinetic"], 0.5 * total_mass(solver), 1e-12);
}

} // namespace
} // namespace cnem::testing
