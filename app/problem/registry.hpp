#pragma once
// From a case to solver objects: the only place that knows every material and tool; methods have a registry
// of their own.
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cnem::app {

/// A case made ready to run.
template<int dim> struct Setup {
  Problem<dim> problem;
  Fields<dim> velocity; ///< [component][node] m/s at t = 0
  Field temperature;    ///< [node] K at t = 0
  std::vector<std::string> warnings;
};

/// Builds cloud, method, material, boundary conditions and tools of a case. Throws InputError with file, line
/// and key for what only geometry can tell: impossible clouds, pieces without nodes, conditions that
/// contradict each other.
template<int dim> Setup<dim> build(const input::Case& input);
extern template Setup<2> build(const input::Case& input);
extern template Setup<3> build(const input::Case& input);

} // namespace cnem::app
