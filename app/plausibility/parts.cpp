// Parts that nothing keeps apart.
#include "app/plausibility/list.hpp"
#include "mechanics/statics/rigid_motion.hpp"

#include <fmt/format.h>
#include <set>

namespace cnem::app {

void doubt_parts(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts) {
  if (input.contact.active || !input.domain.interfaces.empty() || !input.periodic.empty()) return;
  const std::vector<std::size_t> root =
      parts_of(solver.approximation().mechanics, solver.state().node.size());
  const std::set<std::size_t> parts(root.begin(), root.end());
  if (parts.size() > 1)
    doubts.push_back(doubt_about(
        input, "contact.deformable",
        fmt::format("the workpiece has {} parts that pass through each other where they meet, expected "
                    "contact.deformable = true",
                    parts.size())));
}

} // namespace cnem::app
