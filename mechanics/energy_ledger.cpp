#include "mechanics/energy_ledger.hpp"

#include <fmt/format.h>
#include <stdexcept>

namespace cnem {

double EnergyLedger::operator[](std::string_view name) const {
  for (const Energy& entry : entries_)
    if (entry.name == name) return entry.value;
  throw std::out_of_range(fmt::format("no energy is called '{}'", name));
}

double EnergyLedger::sum(EnergyKind kind, double from) const {
  for (const Energy& entry : entries_)
    if (entry.kind == kind) from += entry.value;
  return from;
}

double EnergyLedger::deformation() const {
  const EnergyLedger& e = *this;
  return e["elastic"] + e["stabilisation"] + e["plastic"] + e["penalty_release"];
}

double EnergyLedger::kinetic_share() const {
  const double taken = deformation();
  return taken > 0.0 ? (*this)["inertial"] / taken : 0.0;
}

double EnergyLedger::heat_residual() const {
  double residual = sum(EnergyKind::heat_held, 0.0);
  for (const Energy& entry : entries_)
    if (entry.kind == EnergyKind::heat_received) residual -= entry.value;
  return residual;
}

} // namespace cnem
