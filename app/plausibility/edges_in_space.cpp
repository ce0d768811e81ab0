// Rounded edges of tools in space beside the cells that are to feel them.
#include "app/plausibility/list.hpp"
#include "app/plausibility/tool_gap.hpp"
#include "clouds/space/domain.hpp"

#include <algorithm>

namespace cnem::app {

/// Of each tool the sharpest edge over the cells there, where it stands no further from the workpiece than
/// half of that is wide.
void doubt_edges(const input::Case& input, const ExplicitSolver<3>& solver, Doubts& doubts) {
  const StartingSurface<3> surface(solver);
  const Box<3> box = surface.box();
  const double reach = 0.5 * (box.high - box.low).minCoeff();
  const clouds::SpaceSpacing wanted{input.cloud.spacing, input.cloud.space_refinements};
  for (const contact::Tool<3>& tool : solver.conditions().contact.tools()) {
    double sharpest = 0.0, spacing = 0.0; // m
    for (const contact::Ridge<3>& ridge : tool.shape->ridges()) {
      const double radius = ridge.section.radius;
      if (ridge.path == contact::Ridge<3>::Path::corner || radius == 0.0) continue;
      if (spacing > 0.0 && radius >= sharpest) continue;
      const auto near = surface.least([&](const Vec3& x) { return ridge.clearance(x); });
      if (near.distance > reach) continue;
      sharpest = radius;
      spacing = std::min(wanted.at(near.at), adapted_spacing(input));
    }
    if (spacing > 0.0) doubt_arc(input, tool.name, sharpest, spacing, doubts);
  }
}

} // namespace cnem::app
