#include "mechanics/loads.hpp"

namespace cnem {

template<int dim>
Loads<dim>::Loads(std::vector<Traction<dim>> tractions, std::vector<Pressure<dim>> pressures,
                  std::array<TimeTable, dim> acceleration, const std::vector<Vec<dim>>& initial)
    : tractions_(std::move(tractions)), pressures_(std::move(pressures)),
      acceleration_(std::move(acceleration)) {
  for (const TimeTable& component : acceleration_) body_force_ |= !component.empty();
  for (const Traction<dim>& traction : tractions_) {
    std::vector<double>& share = traction_share_.emplace_back();
    for (const Facet<dim>& facet : traction.facets) {
      const Vec<dim>& a = initial[static_cast<std::size_t>(facet.node[0])];
      const Vec<dim>& b = initial[static_cast<std::size_t>(facet.node[1])];
      share.push_back(0.5 * (b - a).norm());
    }
  }
  resize_all(force_, initial.size());
}

template<int dim> void Loads<dim>::evaluate(double time, const Fields<dim>& position, const Field& mass) {
  if (empty()) return;
  for (std::size_t k = 0; k < dim; ++k) {
    const double acceleration = acceleration_[k](time);
    for (std::size_t i = 0; i < mass.size(); ++i) force_[k][i] = mass[i] * acceleration;
  }
  for (std::size_t t = 0; t < tractions_.size(); ++t)
    for (std::size_t k = 0; k < dim; ++k) {
      const double value = tractions_[t].value[k](time);
      for (std::size_t f = 0; f < tractions_[t].facets.size(); ++f)
        for (const std::int32_t node : tractions_[t].facets[f].node)
          force_[k][static_cast<std::size_t>(node)] += value * traction_share_[t][f];
    }
  for (const Pressure<dim>& pressure : pressures_) {
    const double value = pressure.value(time);
    for (const Facet<dim>& facet : pressure.facets) {
      const auto a = static_cast<std::size_t>(facet.node[0]), b = static_cast<std::size_t>(facet.node[1]);
      const Vec2 edge(position[0][b] - position[0][a], position[1][b] - position[1][a]);
      const Vec2 half = -0.5 * value * right_normal(edge);
      for (const std::size_t node : {a, b})
        for (std::size_t k = 0; k < dim; ++k) force_[k][node] += half[static_cast<Eigen::Index>(k)];
    }
  }
}

template<int dim>
std::vector<typename Loads<dim>::FacetTraction>
Loads<dim>::facet_tractions(double time, const Fields<dim>& position) const {
  std::vector<FacetTraction> list;
  for (const Traction<dim>& traction : tractions_) {
    Vec<dim> t;
    for (std::size_t k = 0; k < dim; ++k) t[static_cast<Eigen::Index>(k)] = traction.value[k](time);
    for (const Facet<dim>& facet : traction.facets) list.push_back({facet, t});
  }
  for (const Pressure<dim>& pressure : pressures_)
    for (const Facet<dim>& facet : pressure.facets) {
      const auto a = static_cast<std::size_t>(facet.node[0]), b = static_cast<std::size_t>(facet.node[1]);
      const Vec2 edge(position[0][b] - position[0][a], position[1][b] - position[1][a]);
      list.push_back({facet, -pressure.value(time) * right_normal(edge).normalized()});
    }
  return list;
}

template class Loads<2>;

} // namespace cnem
