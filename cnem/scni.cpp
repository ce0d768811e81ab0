#include "cnem/scni.hpp"

#include "cnem/quadrature.hpp"
#include "cnem/revolution.hpp"
#include "cnem/smoothing.hpp"
#include "core/error.hpp"
#include "voronoi/cells.hpp"
#include "voronoi/linear_simplices.hpp"

#include <fmt/format.h>

namespace cnem::scni {

Cnem::Cnem(Options options) : options_(options) {
  if (options.gauss_points < 1 || options.gauss_points > 3)
    throw InputError(
        fmt::format("{} Gauss points per Voronoi edge: expected 1, 2 or 3", options.gauss_points));
}

std::string Cnem::name() const {
  return options_.functions == Functions::sibson ? "cnem_sibson" : "cnem_laplace";
}

Approximation<2> Cnem::rebuild(const Cloud<2>& cloud) {
  const auto triangulation = voronoi::triangulate(cloud);
  const auto circles = voronoi::circumcircles(cloud, triangulation);
  const auto cells = voronoi::constrained_cells(cloud, triangulation, circles);
  const auto means = face_means(cloud, triangulation, circles, cells, options_.functions,
                                options_.gauss_points, options_.space);
  const auto faces = faces_of_cells(cells);

  Approximation<2> result;
  if (options_.space == Space::revolution) {
    const auto values = centroid_values(cloud, triangulation, circles, cells, options_.functions);
    result.mechanics = smoothed_gradients<2>(cloud, cells, faces, means, &values);
  } else {
    result.mechanics = smoothed_gradients<2>(cloud, cells, faces, means);
  }
  result.conduction = voronoi::linear_simplices<2>(cloud, triangulation.node, options_.space);
  result.links = stabilisation_links<2>(cloud, cells, faces);
  if (options_.space == Space::revolution) revolve(result.mechanics.radius, result.links);
  result.node_volume = result.mechanics.volume;
  result.cells = voronoi::cell_geometry(cloud, triangulation, circles, cells);
  return result;
}

} // namespace cnem::scni
