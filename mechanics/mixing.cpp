#include "mechanics/mixing.hpp"
#include "core/index.hpp"

#include "plasticity/damage.hpp"
#include "plasticity/log_strain.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {

namespace {

/// What ln b_e has of volume change beside thermal expansion: pressure is −κ times it.
template<int dim>
double dilatation(const plasticity::Symmetric<dim>& log_elastic, const plasticity::Material& material,
                  double temperature) {
  return 0.5 * log_elastic.template head<3>().sum() - 3.0 * material.thermal_strain(temperature);
}

} // namespace

template<int dim>
Field held_tension(const std::vector<plasticity::Material>& materials, const PointState<dim>& point) {
  if (!point.damaged.on()) return {};
  Field held(point.size());
  for (std::size_t p = 0; p < held.size(); ++p) {
    const auto log_elastic =
        plasticity::logarithm<dim>(plasticity::at_point<dim>(point.inverse_plastic_cauchy_green, p));
    const double tension =
        dilatation<dim>(log_elastic, materials[index_of(point.material[p])], point.temperature[p]) -
        point.opening[p];
    held[p] = tension > 0.0 ? (1.0 - point.softening[p]) * tension * tension : 0.0;
  }
  return held;
}

template<int dim>
void mix_elastic(const PointRows& parcels, const Field& mass, const Field& tension,
                 const Field& elastic_volume, const std::vector<plasticity::Material>& materials,
                 PointState<dim>& point) {
  Fields<symmetric_size<dim>> mixed;
  for (std::size_t k = 0; k < mixed.size(); ++k) mixed[k].resize(parcels.size());
  for (std::size_t p = 0; p < parcels.size(); ++p) {
    const auto first = index_of(parcels.begin[p]), last = index_of(parcels.begin[p + 1]);
    auto elastic =
        plasticity::at_point<dim>(point.inverse_plastic_cauchy_green, index_of(parcels.from[first]));
    const plasticity::Material& material = materials[index_of(point.material[p])];
    if (last - first > 1 && !material.ply) {
      elastic.setZero();
      double total = 0.0, volume = 0.0;
      for (std::size_t e = first; e < last; ++e) {
        const auto k = index_of(parcels.from[e]);
        const double share = parcels.weight[e] * mass[k];
        const auto part =
            plasticity::logarithm<dim>(plasticity::at_point<dim>(point.inverse_plastic_cauchy_green, k));
        elastic += share * part;
        volume += share * std::exp(0.5 * part.template head<3>().sum());
        total += share;
      }
      elastic /= total;
      // in plane stress what has opened has flowed
      const double softening = material.damage && !point.thin.on() ? point.softening[p] : 0.0;
      if (softening > 0.0 || !elastic_volume.empty()) { // gaps are volumes, which add
        const double dilated = elastic_volume.empty() ? volume / total : elastic_volume[p];
        elastic.template head<3>().array() +=
            2.0 / 3.0 * (std::log(dilated) - 0.5 * elastic.template head<3>().sum());
      }
      if (softening > 0.0 && softening < 1.0) {
        double& opening = point.opening[p];
        opening = std::max(opening, dilatation<dim>(elastic, material, point.temperature[p]) -
                                        std::sqrt(tension[p] / (1.0 - softening)));
      }
      const double pressure =
          -material.elasticity.kappa() * dilatation<dim>(elastic, material, point.temperature[p]);
      elastic = plasticity::within_yield<dim>(
          material, elastic, point, p,
          material.damage ? plasticity::flow_share<dim>(material, point, p, pressure) : 1.0);
      elastic = plasticity::exponential<dim>(elastic);
    }
    for (std::size_t k = 0; k < mixed.size(); ++k) mixed[k][p] = elastic[static_cast<Eigen::Index>(k)];
  }
  point.inverse_plastic_cauchy_green = std::move(mixed);
}

template Field held_tension<2>(const std::vector<plasticity::Material>&, const PointState<2>&);
template Field held_tension<3>(const std::vector<plasticity::Material>&, const PointState<3>&);
template void mix_elastic<2>(const PointRows&, const Field&, const Field&, const Field&,
                             const std::vector<plasticity::Material>&, PointState<2>&);
template void mix_elastic<3>(const PointRows&, const Field&, const Field&, const Field&,
                             const std::vector<plasticity::Material>&, PointState<3>&);

} // namespace cnem
