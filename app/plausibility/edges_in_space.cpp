// Rounded edges of tools in space beside the cells that are to feel them.
#include "app/plausibility/list.hpp"
#include "clouds/space/domain.hpp"
#include "core/geometry/box.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <vector>

namespace cnem::app {

/// Of each tool the sharpest edge over the cells there, where it stands no further from the workpiece than
/// half of that is wide.
void doubt_edges(const input::Case& input, const ExplicitSolver<3>& solver, Doubts& doubts) {
  const Cloud<3>& cloud = solver.conditions().cloud;
  const contact::RigidContact<3>& contact = solver.conditions().contact;
  const clouds::SpaceSpacing wanted{input.cloud.spacing, input.cloud.space_refinements};
  const Box<3> box = box_of<3>(cloud.position);
  const double reach = 0.5 * (box.high - box.low).minCoeff();
  std::vector<char> outside(index_of(cloud.nodes()), 0);
  for (const Facet<3>& facet : cloud.facets)
    for (const NodeIndex i : facet.node) outside[index_of(i)] = 1;
  for (const ToolIndex t : contact.tools().indices()) {
    const contact::Tool<3>& tool = contact.tools()[t];
    double sharpest = 0.0, spacing = 0.0; // m
    for (const contact::Ridge<3>& ridge : tool.shape->ridges()) {
      const double radius = ridge.section.radius;
      if (ridge.path == contact::Ridge<3>::Path::corner || radius == 0.0) continue;
      if (spacing > 0.0 && radius >= sharpest) continue;
      double least = reach;
      for (const NodeIndex i : cloud.position.indices()) {
        if (outside[index_of(i)] == 0) continue;
        const Vec3 x = cloud.position[i] - contact.results()[t].displacement;
        if (const double d = ridge.clearance(x); d < least) {
          least = d;
          sharpest = radius;
          spacing = std::min(wanted.at(cloud.position[i]), adapted_spacing(input));
        }
      }
    }
    if (spacing > 0.0) doubt_arc(input, tool.name, sharpest, spacing, doubts);
  }
}

} // namespace cnem::app
