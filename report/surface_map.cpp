#include "report/surface_map.hpp"

#include "report/picture.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::report {

std::string machined_map(const SurfaceMap& map, const std::string& title, double time,
                         const results::ShownUnits& units) {
  CellGeometry<2> cells;
  std::array<std::vector<double>, 2> position;
  const std::size_t columns = map.along.size(), rows = map.height.size();
  for (std::size_t k = 0; k < rows; ++k)
    for (std::size_t i = 0; i < columns; ++i) {
      cells.vertex.emplace_back(map.along[i], map.height[k]);
      cells.vertex_begin.push_back(static_cast<std::int32_t>(cells.vertex_node.size()));
      cells.vertex_node.push_back(as<NodeIndex>(k * columns + i));
      cells.vertex_weight.push_back(1.0);
      position[0].push_back(map.along[i]);
      position[1].push_back(map.height[k]);
    }
  cells.vertex_begin.push_back(static_cast<std::int32_t>(cells.vertex_node.size()));
  cells.begin.push_back(0);
  for (std::size_t k = 0; k + 1 < rows; ++k)
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      const std::size_t corner = k * columns + i;
      for (const std::size_t vertex : {corner, corner + 1, corner + columns + 1, corner + columns})
        cells.index.push_back(static_cast<std::int32_t>(vertex));
      cells.begin.push_back(static_cast<std::int32_t>(cells.index.size()));
    }
  Picture picture;
  picture.cells = &cells;
  picture.position = {position[0], position[1]};
  picture.value = map.value;
  double most = 0.0;
  for (const double value : map.value) most = std::max(most, std::abs(value));
  picture.label = "left on the surface";
  picture.map = ColourMap::diverging;
  picture.unit = units.of(most, "m");
  picture.edges = false;
  picture.title = title;
  picture.time = time;
  return draw_png(picture);
}

} // namespace cnem::report
