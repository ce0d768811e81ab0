#include "evaluate/residual_stress.hpp"

#include "core/index.hpp"
#include "mechanics/kinematics.hpp"
#include "results/fields.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace cnem::evaluate {
namespace {

double von_mises(double xx, double yy, double zz, double xy) {
  const double p = (xx + yy + zz) / 3.0;
  return std::sqrt(1.5 * ((xx - p) * (xx - p) + (yy - p) * (yy - p) + (zz - p) * (zz - p) + 2.0 * xy * xy));
}

} // namespace

Fields<4> stress_at_nodes(const results::Snapshot<2>& shot) {
  return {results::values_at_nodes(shot, "stress_xx"), results::values_at_nodes(shot, "stress_yy"),
          results::values_at_nodes(shot, "stress_zz"), results::values_at_nodes(shot, "stress_xy")};
}

ResidualStress no_residual_stress(std::size_t nodes, const std::string& reason) {
  ResidualStress residual;
  resize_all(residual.stress, nodes, std::numeric_limits<double>::quiet_NaN());
  residual.yield_ratio = residual.stress.front();
  residual.note = fmt::format("there are no residual stresses: {}", reason);
  return residual;
}

ResidualStress residual_stress(const results::Snapshot<2>& shot, const StressedBody* body) {
  const auto& node = shot.state.node;
  if (!body) return no_residual_stress(node.size(), "tied nodes are not let go");
  Springback released;
  try {
    released = springback(*body);
  } catch (const std::runtime_error& error) { return no_residual_stress(node.size(), error.what()); }
  ResidualStress residual = no_residual_stress(node.size(), "");
  residual.note.clear();
  const DiscreteOperators<2>& op = shot.approximation.mechanics;
  residual.stress = stress_at_nodes(shot);
  for (std::size_t c = 0; c < residual.stress.size(); ++c) {
    const Field change = average_at_nodes<2>(op, released.stress_change[c]);
    for (std::size_t i = 0; i < change.size(); ++i) residual.stress[c][i] += change[i];
  }
  const auto& [xx, yy, zz, xy] = residual.stress;
  const Field strain = results::values_at_nodes(shot, "plastic_strain"),
              strength = average_at_nodes<2>(op, shot.state.point.strength);
  for (std::size_t i = 0; i < node.size(); ++i) {
    const auto& hardening = body->materials[index_of(node.material[i])].hardening;
    residual.yield_ratio[i] =
        hardening ? von_mises(xx[i], yy[i], zz[i], xy[i]) /
                        (strength[i] * hardening->flow_stress(strain[i], 0.0, (*body->cooled_to)[i]))
                  : 0.0;
  }
  return residual;
}

} // namespace cnem::evaluate
