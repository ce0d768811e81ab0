#pragma once
// Whether metal has gone beyond what the constants of its law were measured at.
#include "core/fields/archive.hpp"
#include "mechanics/explicit_solver.hpp"

#include <string>
#include <vector>

namespace cnem::app {

/// Remembers, for each material and each of plastic strain, its rate and temperature, the first time that
/// points were found outside the range stated for it. Rates below the range are not told of: metal that
/// begins or ceases to flow passes through all of them.
class MeasuredRangeWatch {
public:
  /// Looks at the points of materials with a range, as long as there is something left to find.
  template<int dim> void look(const ExplicitSolver<dim>& solver);
  /// One for each material and quantity found, with the worst point of that time; those not found are empty.
  const std::vector<std::string>& warnings() const { return warnings_; }
  void archive(Archive& archive) { archive.texts("run/measured_range", warnings_); }

private:
  std::vector<std::string> warnings_; ///< three a material
};

} // namespace cnem::app
