#include "adapt/indicator.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/parallel.hpp"
#include "voronoi/natural_neighbours.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::adapt {

namespace {

/// f* − f_i at x. Outside the domain, where rounding may put a point of a cell at a notch, the value of the
/// nearest triangle's node counts: none.
double excess(voronoi::NaturalNeighbours& functions, const Vec2& x, std::int32_t triangle, const Field& value,
              double own) {
  try {
    functions.evaluate(voronoi::Functions::sibson, x, triangle);
  } catch (const GeometryError&) { return 0.0; }
  double sum = 0.0;
  for (std::size_t k = 0; k < functions.nodes().size(); ++k)
    sum += functions.values()[k] * (value[index_of(functions.nodes()[k])] - own);
  return sum;
}

} // namespace

Indicator indicator(const Cloud<2>& cloud, const Structure& structure, const Field& value) {
  const CellGeometry<2> cells =
      voronoi::cell_geometry(cloud, structure.mesh, structure.circles, structure.cells);
  Indicator result;
  result.error.assign(value.size(), 0.0);
  for_each_block(value.size(), [&](std::size_t begin, std::size_t end) {
    voronoi::NaturalNeighbours functions(cloud, structure.mesh, structure.circles);
    for (std::size_t i = begin; i < end; ++i) {
      const auto around = structure.neighbours(static_cast<std::int32_t>(i));
      if (std::all_of(around.begin(), around.end(),
                      [&](std::int32_t k) { return value[index_of(k)] == value[i]; }))
        continue;
      const auto first = index_of(cells.begin[i]), last = index_of(cells.begin[i + 1]);
      const Vec2& centre = cloud.position[i];
      double squared = 0.0;
      for (std::size_t v = first; v < last; ++v) {
        const Vec2 &a = cells.vertex[index_of(cells.index[v])],
                   &b = cells.vertex[index_of(cells.index[v + 1 < last ? v + 1 : first])];
        const double area = 0.5 * cross(a - centre, b - centre);
        if (area == 0.0) continue;
        const std::array<Vec2, 3> corner{centre, a, b};
        for (std::size_t g = 0; g < 3; ++g) {
          const Vec2 x = (4.0 * corner[g] + corner[(g + 1) % 3] + corner[(g + 2) % 3]) / 6.0;
          const double e = excess(functions, x, structure.mesh.triangle_of_node[i], value, value[i]);
          squared += area / 3.0 * e * e;
        }
      }
      result.error[i] = std::sqrt(std::max(squared, 0.0));
    }
  });
  for (std::size_t i = 0; i < value.size(); ++i) {
    result.total += result.error[i] * result.error[i];
    result.norm += value[i] * value[i] * structure.cells.volume[i];
  }
  result.total = std::sqrt(result.total);
  result.norm = std::sqrt(result.norm);
  return result;
}

} // namespace cnem::adapt
