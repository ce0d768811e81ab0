#include "results/tool_fields.hpp"

#include "core/index.hpp"

#include <cmath>

namespace cnem::results {
namespace {

struct Kept {
  FieldFrame<2> frame;
  CellGeometry<2> cells;
  Fields<2> position;
  Field of_cells, of_nodes, of_surface; ///< K
};

void append(Kept& kept, const ToolSection<2>& section, const Field& temperature, const Vec2& displacement) {
  const CellGeometry<2>& cells = section.approximation.cells;
  const std::size_t first = kept.of_nodes.size(), n = index_of(section.cloud.nodes());
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 x = section.cloud.position[i] + displacement;
    for (std::size_t k = 0; k < 2; ++k) kept.position[k].push_back(x[as<int>(k)]);
    kept.of_nodes.push_back(temperature[i]);
    const bool coated = section.coating && exists(section.coating_node[i]);
    kept.of_surface.push_back(coated ? temperature[index_of(section.coating_node[i])] : temperature[i]);
    kept.cells.vertex.push_back(x);
    kept.cells.vertex_node.push_back(as<NodeIndex>(first + i));
    kept.cells.vertex_weight.push_back(1.0);
    kept.cells.vertex_begin.push_back(as<std::int32_t>(first + i + 1));
  }
  for (std::size_t c = 0; c + 1 < cells.begin.size(); ++c) {
    double sum = 0.0;
    for (auto e = index_of(cells.begin[c]); e < index_of(cells.begin[c + 1]); ++e) {
      const auto i = index_of(cells.index[e]);
      kept.cells.index.push_back(as<std::int32_t>(first + i));
      sum += temperature[i];
    }
    kept.cells.begin.push_back(as<std::int32_t>(kept.cells.index.size()));
    kept.of_cells.push_back(sum / (cells.begin[c + 1] - cells.begin[c]));
  }
}

} // namespace

std::shared_ptr<const FieldFrame<2>> tool_frame(const Snapshot<2>& shot, const Vec3& origin) {
  if (!shot.tools || shot.tools->empty()) return nullptr;
  const auto kept = std::make_shared<Kept>();
  kept->cells.begin.push_back(0);
  kept->cells.vertex_begin.push_back(0);
  for (std::size_t s = 0; s < shot.tools->size(); ++s) {
    const ToolSection<2>& section = (*shot.tools)[s];
    append(*kept, section, shot.state.tool_temperature[s],
           shot.contact.displacement(index_of(section.tool), shot.state.time));
  }
  FieldFrame<2>& frame = kept->frame;
  frame.time = shot.state.time;
  frame.cells = &kept->cells;
  for (std::size_t k = 0; k < 2; ++k) frame.position[k] = kept->position[k];
  frame.origin = origin;
  frame.cell_scalars = {{"temperature [K]", kept->of_cells}};
  frame.node_scalars = {{"temperature [K]", kept->of_nodes}, {"surface_temperature [K]", kept->of_surface}};
  return {kept, &frame};
}

} // namespace cnem::results
