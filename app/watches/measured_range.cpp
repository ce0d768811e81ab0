#include "app/watches/measured_range.hpp"

#include "app/divergence.hpp"
#include "app/places.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace cnem::app {

namespace {

struct Quantity {
  const char* name;
  const char* unit;
  Range plasticity::MeasuredRange::*range;
  bool lower; ///< whether values below the range are told of, too
};

constexpr std::array quantities{
    Quantity{"plastic strain", "", &plasticity::MeasuredRange::strain, false},
    Quantity{"plastic strain rate", " 1/s", &plasticity::MeasuredRange::rate, false},
    Quantity{"temperature", " K", &plasticity::MeasuredRange::temperature, true},
};

/// How far a value lies outside, ≤ 0 inside.
double beyond(const Range& range, bool lower, double value) {
  const double above = value - range.high;
  return lower ? std::max(above, range.low - value) : above;
}

} // namespace

template<int dim> void MeasuredRangeWatch::look(const ExplicitSolver<dim>& solver) {
  const std::vector<plasticity::Material>& materials = solver.model().materials;
  const State<dim>& state = solver.state();
  const std::array<const Field*, quantities.size()> fields{
      &state.point.plastic_strain, &state.point.plastic_rate, &state.point.temperature};
  warnings_.resize(materials.size() * quantities.size());
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const auto limits = [&](std::size_t m) { return materials[m].measured.*quantities[q].range; };
    const auto wanted = [&](std::size_t m) {
      return limits(m).bounded() && warnings_[m * quantities.size() + q].empty();
    };
    std::vector<Range> open(materials.size());
    bool any = false;
    for (std::size_t m = 0; m < materials.size(); ++m)
      if (wanted(m)) open[m] = limits(m), any = true;
    if (!any) continue;
    std::vector<double> most(materials.size(), 0.0);
    std::vector<std::size_t> worst(materials.size(), 0);
    for (std::size_t p = 0; p < state.point.size(); ++p) {
      const auto m = index_of(state.point.material[p]);
      if (const double out = beyond(open[m], quantities[q].lower, (*fields[q])[p]); out > most[m])
        most[m] = out, worst[m] = p;
    }
    for (std::size_t m = 0; m < materials.size(); ++m) {
      if (!(most[m] > 0.0)) continue;
      const auto [name, unit, range, lower] = quantities[q];
      const std::size_t node = node_of(solver, worst[m]);
      warnings_[m * quantities.size() + q] =
          fmt::format("the {} at node {} at {} is {:.5g}{}, outside the range {:g} to {:g}{} in which the "
                      "constants of {} "
                      "were measured, at step {}, t = {:.6g} s: its law is an extrapolation there",
                      name, node, show_place<dim>(state.node.position, node), (*fields[q])[worst[m]], unit,
                      open[m].low, open[m].high, unit, materials[m].name, state.step, state.time);
    }
  }
}

template void MeasuredRangeWatch::look(const ExplicitSolver<2>&);
template void MeasuredRangeWatch::look(const ExplicitSolver<3>&);

} // namespace cnem::app
