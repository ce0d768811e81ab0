// What a case asks of its method: the one table of combinations that are refused for want of a promise.
#include "input/case_parts.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace cnem::input {
namespace {

bool dynamic(const Case& c) { return c.analysis.type == Analysis::Type::explicit_dynamics; }

bool holds_nodes(const Case& c) {
  return std::any_of(c.boundary.begin(), c.boundary.end(), [](const BoundaryCondition& condition) {
    const auto given = [](const auto& component) { return component.has_value(); };
    return condition.symmetry || condition.temperature ||
           std::any_of(condition.velocity.begin(), condition.velocity.end(), given) ||
           std::any_of(condition.displacement.begin(), condition.displacement.end(), given);
  });
}

/// What is asked for at `path`, and why only a method that keeps the promise can give it.
struct Need {
  Promise promise;
  const char* path;
  bool (*asked)(const Case&);
  const char* found;
  const char* reason;
  const char* instead = ""; ///< a value of the key that every method can give
};

constexpr std::array promise_needs{
    Need{Promise::carried_history, "method.lagrangian",
         [](const Case& c) { return dynamic(c) && c.method.lagrangian != Method::Lagrangian::total; },
         "a reference that is renewed", "what its points have undergone would not reach those of the new one",
         "\"total\""},
    Need{Promise::one_point_per_node, "method.pressure_exchange",
         [](const Case& c) { return c.method.pressure_exchange > 0.0; },
         "an exchange of volume between nodes", "the volume of a node is that of its own stress point", "0"},
    Need{Promise::one_point_per_node, "method.stress_annealing",
         [](const Case& c) { return c.method.stress_annealing > 0.0; }, "an annealing between nodes",
         "the stress of a node is that of its own stress point", "0"},
    Need{Promise::one_point_per_node, "adapt.resample", [](const Case& c) { return c.adapt.resample; },
         "resampling", "history goes with the nodes that stay", "false"},
    Need{Promise::tiling_cells, "adapt.resample", [](const Case& c) { return c.adapt.resample; },
         "resampling", "new nodes take their mass from what their cells take of others", "false"},
    Need{Promise::hoop_rows, "analysis.kinematics",
         [](const Case& c) { return c.analysis.space() == Space::revolution; }, "an axisymmetric analysis",
         "the hoop strain u/r has no value on the axis without them"},
    Need{Promise::balanced_constant_stress, "analysis.type", [](const Case& c) { return !dynamic(c); },
         "a static analysis",
         "where uniform stress is not in balance, equilibrium is that of the scatter of the nodes"},
    Need{Promise::non_negative_values, "analysis.thermal",
         [](const Case& c) { return dynamic(c) && c.analysis.thermal; }, "an analysis with heat",
         "plastic heat goes to the nodes by their values: where one is negative, work would cool", "false"},
    Need{Promise::interpolating_values, "boundary", holds_nodes, "prescribed nodes",
         "holding a node would not hold the body there"},
    Need{Promise::interpolating_values, "tools", [](const Case& c) { return !c.tools.empty(); },
         "contact with tools", "a node on a tool would not bring the surface there"},
    Need{Promise::interpolating_values, "contact.deformable", [](const Case& c) { return c.contact.active; },
         "contact of bodies", "nodes that touch would not bring the surfaces together", "false"},
    Need{Promise::interpolating_values, "domain.interfaces",
         [](const Case& c) {
           return std::any_of(c.domain.interfaces.begin(), c.domain.interfaces.end(),
                              [](const Interface& one) { return one.cohesive.has_value(); });
         },
         "a cohesive interface", "nodes of its faces would not be where the faces are"},
};

std::string expectation(const Need& need, int dimensions) {
  const std::string instead(need.instead);
  const std::vector<std::string> others = methods::names_that_keep(need.promise, dimensions);
  if (others.empty()) return instead.empty() ? "another analysis: no method in space promises it" : instead;
  return fmt::format("{}{}method.name = \"{}\"", instead, instead.empty() ? "" : " or ",
                     fmt::join(others, "\" or \""));
}

} // namespace

std::vector<Unmet> unmet_needs(const Case& input, const Promises& promises) {
  std::vector<Unmet> list;
  for (const Need& need : promise_needs)
    if (!promises.keep(need.promise) && need.asked(input))
      list.push_back(
          {need.path, need.promise,
           fmt::format("found {} with method.name = \"{}\", which does not promise '{}': {}, expected {}",
                       need.found, input.method.name, name_of(need.promise), need.reason,
                       expectation(need, input.analysis.dimensions()))});
  return list;
}

void check_promises(const Setting& root, const Case& result, Diagnostics& diagnostics) {
  for (const Unmet& unmet : unmet_needs(result, methods::entry(result.method.name).promises)) {
    const Setting& setting = *root.find(unmet.path);
    diagnostics.add(Mistake::promise, setting.where, setting.path, unmet.message);
  }
}

} // namespace cnem::input
