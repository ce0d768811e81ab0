#pragma once
// Every discretisation a case can name, with what it promises and the dimensions it exists in: the one place
// a new one is entered.
#include "cnem/scni.hpp"
#include "cnem/space.hpp"
#include "core/geometry/revolution.hpp"
#include "methods/sph.hpp"
#include "voronoi/linear_simplices.hpp"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::methods {

/// What a case may choose of its method; each discretisation takes what concerns it.
struct Options {
  scni::Functions functions = scni::Functions::sibson;
  bool least_squares = false; ///< in the plane: moving least squares in the place of `functions`
  double support = 2.5;       ///< – supports of moving least squares in spacings, 1.5 to 5
  int gauss_points = 2;       ///< in the plane, per edge of a Voronoi cell, 1 to 3
  scni::CellKind cells = scni::CellKind::median; ///< in space
  int points_on_facets = 1;                      ///< in space, of Voronoi cells, 1 or 3
  Kernel kernel = Kernel::cubic_spline;
  double smoothing = 2.4;    ///< – support of the kernel in spacings, 1.5 to 5
  double zone_spacing = 0.0; ///< m: natural elements of the hybrid where nodes are as close as this
  Space space = Space::plane;
  std::vector<voronoi::Simplex<3>> tetrahedra{}; ///< in space: the mesh that tiles the domain
};

template<int dim> using Made = std::unique_ptr<Discretisation<dim>>;

struct Entry {
  std::string_view name;            ///< as in a case
  Promises promises;                ///< of each object that is made
  Made<2> (*plane)(const Options&); ///< null: the method does not exist in the plane
  Made<3> (*space)(const Options&); ///< null: it does not exist in space

  template<int dim> constexpr auto maker() const {
    if constexpr (dim == 2)
      return plane;
    else
      return space;
  }
  constexpr bool exists_in(int dim) const { return dim == 2 ? plane != nullptr : space != nullptr; }
};

std::span<const Entry> registry();

/// Throws InputError for a name that is not registered.
const Entry& entry(std::string_view name);

/// Names of all entries, of those that exist in `dim` dimensions, and of those that keep a promise there, in
/// the order of the registry.
std::vector<std::string> names();
std::vector<std::string> names_in(int dim);
std::vector<std::string> names_that_keep(Promise promise, int dim);

/// Throws InputError for a name that is not registered, a method that does not exist in `dim` dimensions,
/// options out of range or missing, and for bodies of revolution with a method that does not promise hoop
/// rows.
template<int dim> Made<dim> make(std::string_view name, const Options& options);
extern template Made<2> make(std::string_view, const Options&);
extern template Made<3> make(std::string_view, const Options&);

} // namespace cnem::methods
