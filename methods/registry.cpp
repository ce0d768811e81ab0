#include "methods/registry.hpp"

#include "core/error.hpp"
#include "methods/efg.hpp"
#include "methods/fe_simplices.hpp"
#include "methods/hybrid.hpp"
#include "methods/sph_consistent.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace cnem::methods {
namespace {

constexpr std::array list{
    Entry{"cnem", scni::Cnem::promised,
          [](const Options& o) -> Made<2> {
            return std::make_unique<scni::Cnem>(
                scni::Options{o.functions, o.gauss_points, o.space,
                              o.least_squares ? std::optional(o.support) : std::nullopt});
          },
          [](const Options& o) -> Made<3> {
            return std::make_unique<scni::CnemInSpace>(
                scni::SpaceOptions{o.cells, o.functions, o.points_on_facets, o.tetrahedra});
          }},
    Entry{"fe-triangles", FeTriangles::promised,
          [](const Options& o) -> Made<2> { return std::make_unique<FeTriangles>(o.space); }, nullptr},
    Entry{"fe-tetrahedra", FeTetrahedra::promised, nullptr,
          [](const Options& o) -> Made<3> { return std::make_unique<FeTetrahedra>(o.tetrahedra); }},
    Entry{"sph", Sph::promised,
          [](const Options& o) -> Made<2> { return std::make_unique<Sph>(o.kernel, o.smoothing); }, nullptr},
    Entry{"sph-consistent", ConsistentSph::promised,
          [](const Options& o) -> Made<2> { return std::make_unique<ConsistentSph>(o.kernel, o.smoothing); },
          nullptr},
    Entry{"hybrid", Hybrid::promised,
          [](const Options& o) -> Made<2> {
            return std::make_unique<Hybrid>(o.zone_spacing, o.gauss_points, o.space);
          },
          nullptr},
    Entry{"efg", Efg::promised, [](const Options& o) -> Made<2> { return std::make_unique<Efg>(o.support); },
          nullptr},
};

std::vector<std::string> names_where(auto&& wanted) {
  std::vector<std::string> found;
  for (const Entry& method : list)
    if (wanted(method)) found.emplace_back(method.name);
  return found;
}

} // namespace

std::span<const Entry> registry() { return list; }

const Entry& entry(std::string_view name) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const Entry& method) { return method.name == name; });
  if (found == list.end())
    throw InputError(fmt::format("found method '{}', expected one of {}", name, fmt::join(names(), ", ")));
  return *found;
}

std::vector<std::string> names() {
  return names_where([](const Entry&) { return true; });
}

std::vector<std::string> names_in(int dim) {
  return names_where([&](const Entry& method) { return method.exists_in(dim); });
}

std::vector<std::string> names_that_keep(Promise promise, int dim) {
  if (promise == Promise::hoop_rows && dim == 3) return {}; // bodies of revolution are of the plane
  return names_where(
      [&](const Entry& method) { return method.exists_in(dim) && method.promises.keep(promise); });
}

template<int dim> Made<dim> make(std::string_view name, const Options& options) {
  const Entry& method = entry(name);
  if (!method.exists_in(dim))
    throw InputError(fmt::format("found method '{}' in {} dimensions, expected one of {}", name, dim,
                                 fmt::join(names_in(dim), ", ")));
  if (options.space == Space::revolution)
    require(method.promises, Promise::hoop_rows, method.name, "a body of revolution");
  return method.maker<dim>()(options);
}

template Made<2> make(std::string_view, const Options&);
template Made<3> make(std::string_view, const Options&);

} // namespace cnem::methods
