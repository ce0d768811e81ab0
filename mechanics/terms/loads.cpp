#include "mechanics/terms/loads.hpp"

namespace cnem {

template<int dim>
Loads<dim>::Loads(std::vector<Traction<dim>> tractions, std::vector<Pressure<dim>> pressures,
                  std::array<TimeTable, dim> acceleration, const std::vector<Vec<dim>>& initial, Space space)
    : tractions_(std::move(tractions)), pressures_(std::move(pressures)),
      acceleration_(std::move(acceleration)), space_(space) {
  for (const TimeTable& component : acceleration_) body_force_ |= !component.empty();
  share_out(initial);
}

template<int dim> void Loads<dim>::resample(const Cloud<dim>& cloud, const Fields<dim>& initial) {
  for (Traction<dim>& traction : tractions_) renew_facets(cloud, traction.facets);
  for (Pressure<dim>& pressure : pressures_) renew_facets(cloud, pressure.facets);
  std::vector<Vec<dim>> position(cloud.position.size());
  for (std::size_t i = 0; i < position.size(); ++i)
    for (std::size_t k = 0; k < dim; ++k) position[i][static_cast<Eigen::Index>(k)] = initial[k][i];
  share_out(position);
}

template<int dim> void Loads<dim>::share_out(const std::vector<Vec<dim>>& initial) {
  traction_share_.clear();
  for (const Traction<dim>& traction : tractions_) {
    std::vector<std::array<double, dim>>& share = traction_share_.emplace_back();
    for (const Facet<dim>& facet : traction.facets) {
      const Vec<dim>& a = initial[static_cast<std::size_t>(facet.node[0])];
      const Vec<dim>& b = initial[static_cast<std::size_t>(facet.node[1])];
      share.push_back(end_areas(space_, a, b));
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
        for (std::size_t end = 0; end < dim; ++end)
          force_[k][static_cast<std::size_t>(tractions_[t].facets[f].node[end])] +=
              value * traction_share_[t][f][end];
    }
  for (const Pressure<dim>& pressure : pressures_) {
    const double value = pressure.value(time);
    for (const Facet<dim>& facet : pressure.facets) {
      const auto a = static_cast<std::size_t>(facet.node[0]), b = static_cast<std::size_t>(facet.node[1]);
      const Vec2 start(position[0][a], position[1][a]), end(position[0][b], position[1][b]);
      const std::array<double, 2> area = end_areas(space_, start, end);
      const Vec2 push = -value * right_normal(end - start).normalized();
      for (std::size_t k = 0; k < dim; ++k) {
        force_[k][a] += area[0] * push[static_cast<Eigen::Index>(k)];
        force_[k][b] += area[1] * push[static_cast<Eigen::Index>(k)];
      }
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
