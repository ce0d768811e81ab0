#pragma once
// Every discretisation that has to keep the contract: all of the registry in each dimension it exists in,
// C-NEM and SPH with all their options, the hybrid with both kinds of functions.
#include "domains.hpp"
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
  int dim = 2;

  /// Whether it is made on the mesh of a domain.
  template<int dim> bool takes_mesh(const Domain<dim>& domain) const {
    return dim == 3 && !(domain.triangulates && entry->name == "cnem");
  }

  template<int dim> std::unique_ptr<Discretisation<dim>> make(const Domain<dim>& domain) const {
    methods::Options given = options;
    if (takes_mesh(domain)) given.tetrahedra = domain.mesh;
    return methods::make<dim>(entry->name, given);
  }
};

inline void PrintTo(const Method& method, std::ostream* os) { *os << method.name; }

inline std::vector<Method> methods(Space space = Space::plane) {
  std::vector<Method> list;
  for (const methods::Entry& entry : methods::registry()) {
    if (space == Space::revolution && !(entry.exists_in(2) && entry.promises.keep(Promise::hoop_rows)))
      continue;
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
      for (int points = 1; points <= 3; ++points)
        list.push_back({"mls_" + std::to_string(points),
                        &entry,
                        {.least_squares = true, .gauss_points = points, .space = space}});
      if (space == Space::plane) {
        list.push_back({"median", &entry, {}, 3});
        for (const auto& [functions, name] :
             {std::pair(scni::Functions::sibson, "sibson"), std::pair(scni::Functions::laplace, "laplace"),
              std::pair(scni::Functions::linear, "linear")})
          for (const int points : {1, 3}) {
            if (functions == scni::Functions::linear && points == 3) continue;
            list.push_back(
                {std::string("space_") + name + "_" + std::to_string(points),
                 &entry,
                 {.functions = functions, .cells = scni::CellKind::voronoi, .points_on_facets = points},
                 3});
          }
      }
    } else if (entry.name.starts_with("sph")) {
      for (const auto kernel : {methods::Kernel::cubic_spline, methods::Kernel::wendland_c2}) {
        options.kernel = kernel;
        list.push_back({methods::make<2>(entry.name, options)->name(), &entry, options});
      }
    } else {
      options.zone_spacing = 0.13; // m: jittered domains are split by it
      std::string name(entry.name);
      std::replace(name.begin(), name.end(), '-', '_');
      for (const int dim : {2, 3})
        if (entry.exists_in(dim))
          list.push_back({name + (dim == 3 && entry.exists_in(2) ? "_3d" : ""), &entry, options, dim});
    }
  }
  return list;
}

} // namespace cnem::testing
