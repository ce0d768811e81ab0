#pragma once
// Every discretisation a case can name, with what it promises: the one place a new one is entered.
#include "cnem/scni.hpp"
#include "core/revolution.hpp"
#include "methods/sph.hpp"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::methods {

/// What a case may choose of its method; each discretisation takes what concerns it.
struct Options {
  scni::Functions functions = scni::Functions::sibson;
  int gauss_points = 2; ///< per edge of a Voronoi cell, 1 to 3
  Kernel kernel = Kernel::cubic_spline;
  double smoothing = 2.4; ///< – support of the kernel in spacings, 1.5 to 5
  Space space = Space::plane;
};

struct Entry {
  std::string_view name; ///< as in a case
  Promises promises;     ///< of each object that `make` returns
  std::unique_ptr<Discretisation<2>> (*make)(const Options& options);
};

std::span<const Entry> registry();

/// Throws InputError for a name that is not registered.
const Entry& entry(std::string_view name);

/// Names of all entries, or of those that keep a promise, in the order of the registry.
std::vector<std::string> names();
std::vector<std::string> names_that_keep(Promise promise);

/// Throws InputError for a name that is not registered, for options out of range, and for bodies of
/// revolution with a method that does not promise hoop rows.
std::unique_ptr<Discretisation<2>> make(std::string_view name, const Options& options);

} // namespace cnem::methods
