#include "mechanics/terms/loads.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"

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
      std::array<Vec<dim>, dim> corner;
      for (std::size_t a = 0; a < dim; ++a) corner[a] = initial[index_of(facet.node[a])];
      share.push_back(corner_areas<dim>(space_, corner));
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
          force_[k][index_of(tractions_[t].facets[f].node[end])] += value * traction_share_[t][f][end];
    }
  for (const Pressure<dim>& pressure : pressures_) {
    const double value = pressure.value(time);
    for (const Facet<dim>& facet : pressure.facets) {
      const auto corner = corners_of<dim>(facet, position);
      const std::array<double, dim> area = corner_areas<dim>(space_, corner);
      const Vec<dim> push = -value * area_normal<dim>(corner).normalized();
      for (std::size_t k = 0; k < dim; ++k)
        for (std::size_t a = 0; a < dim; ++a)
          force_[k][index_of(facet.node[a])] += area[a] * push[static_cast<Eigen::Index>(k)];
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
      const Vec<dim> outwards = area_normal<dim>(corners_of<dim>(facet, position)).normalized();
      list.push_back({facet, -pressure.value(time) * outwards});
    }
  return list;
}

template class Loads<2>;
template class Loads<3>;

} // namespace cnem
