#pragma once
// The cloud of a case: outlines of the plane are filled, blocks of space are cut into tetrahedra.
#include "core/geometry/cloud.hpp"
#include "input/case.hpp"

#include <string>
#include <vector>

namespace cnem::app {

template<int dim> struct Workpiece {
  Cloud<dim> cloud;
  methods::Options options; ///< of the case, with the mesh of a block
  std::vector<std::string> warnings;
};

/// Throws InputError with file, line and key for a domain that cannot be filled.
template<int dim> Workpiece<dim> make_workpiece(const input::Case& input);
template<> Workpiece<2> make_workpiece(const input::Case& input);
template<> Workpiece<3> make_workpiece(const input::Case& input);

} // namespace cnem::app
