#include "adapt/plane/indicator.hpp"

#include "core/error.hpp"
#include "voronoi/plane/natural_neighbours.hpp"

namespace cnem::adapt {
namespace {

struct Sibson {
  voronoi::NaturalNeighbours functions;
  const voronoi::Triangulation& mesh;

  // False outside the domain, where rounding may put a point of a cell at a notch.
  bool evaluate(const Vec2& x, const InnerFace<2>& face) {
    try {
      functions.evaluate_on_facet(voronoi::Functions::sibson, x, face.simplex);
    } catch (const GeometryError&) { return false; }
    return true;
  }
  bool evaluate(const Vec2& x, std::size_t cell) {
    try {
      functions.evaluate(voronoi::Functions::sibson, x, mesh.triangle_of_node[cell]);
    } catch (const GeometryError&) { return false; }
    return true;
  }
  auto nodes() const { return functions.nodes(); }
  auto values() const { return functions.values(); }
};

} // namespace

Indicator indicator(const Cloud<2>& cloud, const Structure& structure, const Field& value) {
  return indicator<2>(cloud, structure.cells, value, [&] {
    return Sibson{voronoi::NaturalNeighbours(cloud, structure.mesh, structure.circles), structure.mesh};
  });
}

} // namespace cnem::adapt
