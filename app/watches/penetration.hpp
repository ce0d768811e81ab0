#pragma once
// Whether nodes are where contact should not let them be.
#include "core/fields/archive.hpp"
#include "mechanics/explicit_solver.hpp"

#include <string>

namespace cnem::app {

/// Remembers the first node that was found deeper than half its spacing inside a tool: more than contact
/// leaves, of a support that drives it there.
class PenetrationWatch {
public:
  /// Looks at the nodes of the boundary, until one has been found.
  template<int dim> void look(const ExplicitSolver<dim>& solver);
  /// Names node, tool, depth and time; empty while there is none.
  const std::string& warning() const { return warning_; }
  void archive(Archive& archive) { archive.text("run/penetration", warning_); }

private:
  std::string warning_;
};

} // namespace cnem::app
