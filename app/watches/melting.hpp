#pragma once
// Whether metal has become hotter than its law reaches.
#include "core/fields/archive.hpp"
#include "mechanics/explicit_solver.hpp"

#include <string>

namespace cnem::app {

/// Remembers the first node that was found above the melting temperature of its material.
class MeltingWatch {
public:
  /// Looks at all nodes, until one has been found.
  template<int dim> void look(const ExplicitSolver<dim>& solver);
  /// Names node, temperature, material and time; empty while nothing melts.
  const std::string& warning() const { return warning_; }
  void archive(Archive& archive) { archive.text("run/melting", warning_); }

private:
  std::string warning_;
};

} // namespace cnem::app
