#pragma once
// Where the energy of a run is, term by term; what does not add up is reported as the residual.
#include <string>
#include <string_view>
#include <vector>

namespace cnem {

/// On which side of the balance an energy stands.
enum class EnergyKind {
  held,          ///< by the body or its tools
  dissipated,    ///< for good
  received,      ///< work of what acts from outside
  heat_held,     ///< heat has a balance of its own, fed by dissipation
  heat_received, ///< generated, or through the boundary
  noted,         ///< no part of a balance, and in no history
};

/// One entry of the ledger, declared by the object that computes it; J/m^(3−dim) at t_n, counted from the
/// start of the run.
struct Energy {
  const char* name; ///< in histories "energy.<name>"
  EnergyKind kind;
  double value = 0.0;
};

/// The entries of a run at one time.
class EnergyLedger {
public:
  EnergyLedger() = default;
  EnergyLedger(std::vector<Energy> entries, double initial)
      : entries_(std::move(entries)), initial_(initial) {}

  const std::vector<Energy>& entries() const { return entries_; }
  /// The value of an entry. Throws std::out_of_range for a name that no object declared.
  double operator[](std::string_view name) const;

  double external() const { return sum(EnergyKind::received, 0.0); }
  double total() const { return sum(EnergyKind::dissipated, sum(EnergyKind::held, 0.0)); }
  double initial() const { return initial_; } ///< total at the start of the run
  /// Taken by the deformation of the body.
  double deformation() const;
  /// Kinetic energy over that of deformation: small in slow processes; 0 while nothing is deformed.
  double kinetic_share() const;
  /// What the scheme made or lost: zero up to the order of central differences.
  double residual() const { return total() - initial_ - external(); }
  double heat_residual() const;

private:
  double sum(EnergyKind kind, double from) const;

  std::vector<Energy> entries_;
  double initial_ = 0.0;
};

/// What an energy residual is compared with.
struct EnergyScale {
  double energy = 0.0;   ///< J/m, J of revolution; > 0
  const char* what = ""; ///< "the work done"
};

} // namespace cnem
