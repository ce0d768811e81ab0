#include "app/watches/melting.hpp"

#include "app/places.hpp"
#include "core/index.hpp"

#include <fmt/format.h>

namespace cnem::app {

template<int dim> void MeltingWatch::look(const ExplicitSolver<dim>& solver) {
  if (!warning_.empty()) return;
  const Model<dim>& model = solver.model();
  const State<dim>& state = solver.state();
  std::vector<double> melting;
  for (const plasticity::Material& material : model.materials)
    melting.push_back(material.melting_temperature());
  std::size_t hottest = 0, of_hottest = 0;
  double most = 0.0; // K above melting
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    const auto material = index_of(state.node.material[i]);
    if (const double above = state.node.temperature[i] - melting[material]; above > most)
      most = above, hottest = i, of_hottest = material;
  }
  if (!(most > 0.0)) return;
  warning_ =
      fmt::format("node {} at {} is at {:.5g} K, above the melting temperature {:.5g} K of {}, at step "
                  "{}, t = {:.6g} s: its law does not reach there, and the heat of melting is not counted",
                  hottest, show_place<dim>(state.node.position, hottest), state.node.temperature[hottest],
                  melting[of_hottest], model.materials[of_hottest].name, state.step, state.time);
}

template void MeltingWatch::look(const ExplicitSolver<2>&);
template void MeltingWatch::look(const ExplicitSolver<3>&);

} // namespace cnem::app
