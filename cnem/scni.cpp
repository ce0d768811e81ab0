#include "cnem/scni.hpp"

#include "cnem/moving_least_squares.hpp"
#include "cnem/quadrature.hpp"
#include "cnem/revolution.hpp"
#include "cnem/smoothing.hpp"
#include "core/error.hpp"
#include "voronoi/linear_simplices.hpp"
#include "voronoi/plane/cells.hpp"

#include <fmt/format.h>

#include <utility>

namespace cnem::scni {

void check_gauss_points(int gauss_points) {
  if (gauss_points < 1 || gauss_points > 3)
    throw InputError(fmt::format("{} Gauss points per Voronoi edge: expected 1, 2 or 3", gauss_points));
}

Cnem::Cnem(Options options) : options_(options) {
  check_gauss_points(options.gauss_points);
  if (options.support) check_support(*options.support);
}

std::string Cnem::name() const {
  if (options_.support) return "cnem_mls";
  return options_.functions == Functions::sibson ? "cnem_sibson" : "cnem_laplace";
}

Approximation<2> Cnem::rebuild(const Cloud<2>& cloud) {
  const Diagram diagram(cloud);
  if (options_.support)
    return integrate_at_nodes(
        cloud, diagram,
        face_means(cloud, diagram.cells, *options_.support, options_.gauss_points, options_.space),
        Functions::sibson, options_.space);
  return integrate_at_nodes(cloud, diagram,
                            face_means(cloud, diagram.triangulation, diagram.circles, diagram.cells,
                                       options_.functions, options_.gauss_points, options_.space),
                            options_.functions, options_.space);
}

Diagram::Diagram(const Cloud<2>& cloud)
    : triangulation(voronoi::triangulate(cloud)), circles(voronoi::circumcircles(cloud, triangulation)),
      cells(voronoi::constrained_cells(cloud, triangulation, circles)) {}

Approximation<2> integrate_at_nodes(const Cloud<2>& cloud, const Diagram& diagram, FaceMeans means,
                                    Functions at_centroids, Space space) {
  const auto& [triangulation, circles, cells] = diagram;
  const auto faces = faces_of_cells(cells);
  Approximation<2> result;
  if (space == Space::revolution) {
    const auto values = centroid_values(cloud, triangulation, circles, cells, at_centroids);
    result.mechanics = smoothed_gradients<2>(cloud, cells, faces, std::move(means), &values);
  } else {
    result.mechanics = smoothed_gradients<2>(cloud, cells, faces, std::move(means));
  }
  result.conduction = voronoi::linear_simplices<2>(cloud, triangulation.node, space);
  result.links = stabilisation_links<2>(cloud, cells, faces);
  if (space == Space::revolution) revolve(result.mechanics.radius, result.links);
  result.node_volume = result.mechanics.volume;
  result.cells = voronoi::cell_geometry(cloud, triangulation, circles, cells);
  return result;
}

} // namespace cnem::scni
