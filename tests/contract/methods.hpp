#pragma once
// Every discretisation that has to keep the contract: all of the registry, C-NEM and SPH with all their
// options.
#include "methods/registry.hpp"

#include <algorithm>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace cnem::testing {

struct Method {
  std::string name;
  const methods::Entry* entry;
  methods::Options options;

  std::unique_ptr<Discretisation<2>> make() const { return methods::make(entry->name, options); }
};

inline void PrintTo(const Method& method, std::ostream* os) { *os << method.name; }

inline std::vector<Method> methods(Space space = Space::plane) {
  std::vector<Method> list;
  for (const methods::Entry& entry : methods::registry()) {
    if (space == Space::revolution && !entry.promises.keep(Promise::hoop_rows)) continue;
    methods::Options options;
    options.space = space;
    if (entry.name == "cnem") {
      for (const auto functions : {scni::Functions::sibson, scni::Functions::laplace})
        for (int points = 1; points <= 3; ++points) {
          options.functions = functions;
          options.gauss_points = points;
          const std::string name = functions == scni::Functions::sibson ? "sibson_" : "laplace_";
          list.push_back({name + std::to_string(points), &entry, options});
        }
    } else if (entry.name == "sph") {
      for (const auto kernel : {methods::Kernel::cubic_spline, methods::Kernel::wendland_c2}) {
        options.kernel = kernel;
        list.push_back({methods::make(entry.name, options)->name(), &entry, options});
      }
    } else {
      std::string name(entry.name);
      std::replace(name.begin(), name.end(), '-', '_');
      list.push_back({name, &entry, options});
    }
  }
  return list;
}

} // namespace cnem::testing
