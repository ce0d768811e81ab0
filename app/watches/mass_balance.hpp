#pragma once
// Whether the mass of nodes and the volume of their cells have come apart.
#include "core/fields/archive.hpp"
#include "mechanics/explicit_solver.hpp"

#include <string>

namespace cnem::app {

/// Remembers the first node whose mass was found to be less than half, or more than twice, that of the matter
/// in its cell.
class MassBalanceWatch {
public:
  /// Looks at all nodes, until one has been found.
  template<int dim> void look(const ExplicitSolver<dim>& solver);
  /// Names node, ratio and time; empty while there is none.
  const std::string& warning() const { return warning_; }
  void archive(Archive& archive) { archive.text("run/mass_balance", warning_); }

private:
  std::string warning_;
};

} // namespace cnem::app
