#include "app/melting.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::app {

namespace {

/// K; infinite where the material has none.
double melting_temperature(const plasticity::Material& material) {
  double melting = std::numeric_limits<double>::infinity();
  if (material.hardening) melting = std::min(melting, material.hardening->melting_temperature());
  if (material.damage) melting = std::min(melting, material.damage->Tmelt);
  return melting;
}

} // namespace

void MeltingWatch::look(const ExplicitSolver<2>& solver) {
  if (!warning_.empty()) return;
  const Model<2>& model = solver.model();
  const State<2>& state = solver.state();
  std::vector<double> melting;
  for (const plasticity::Material& material : model.materials)
    melting.push_back(melting_temperature(material));
  std::size_t hottest = 0, of_hottest = 0;
  double most = 0.0; // K above melting
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    const auto material = index_of(state.node.material[i]);
    if (const double above = state.node.temperature[i] - melting[material]; above > most)
      most = above, hottest = i, of_hottest = material;
  }
  if (!(most > 0.0)) return;
  warning_ = fmt::format(
      "node {} at ({:.6g}, {:.6g}) m is at {:.5g} K, above the melting temperature {:.5g} K of {}, at step "
      "{}, "
      "t = {:.6g} s: its metal has no strength left, and what melting itself takes is not counted",
      hottest, state.node.position[0][hottest], state.node.position[1][hottest],
      state.node.temperature[hottest], melting[of_hottest], model.materials[of_hottest].name, state.step,
      state.time);
}

} // namespace cnem::app
