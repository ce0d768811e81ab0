#include "mechanics/terms/stress_annealing.hpp"

#include "core/index.hpp"
#include "mechanics/terms/link_smoother.hpp"
#include "mechanics/terms/list.hpp"
#include "plasticity/log_strain.hpp"
#include "plasticity/return_map.hpp"

#include <cassert>
#include <cmath>

namespace cnem {

namespace {

constexpr double least_strain = 1e-3;    ///< ε̄p of what has flowed
constexpr double least_increment = 1e-4; ///< Δε̄p of what flows
constexpr double lasting = 3.0;          ///< τ over the time in flow: measured, docs/pressure_exchange.md
constexpr double amount = 100.0;         ///< A, the same
constexpr double longest = 5.0;          ///< t over τ

} // namespace

double annealing_due(double idle, double elapsed, double flow_time) {
  const double time = lasting * flow_time;
  return idle < longest * time ? amount * std::exp(-idle / time) * std::expm1(elapsed / time) : 0.0;
}

/// s of each node, 0 where it takes no part.
template<int dim> Field StressAnnealing<dim>::shares(const PointState<dim>& point) {
  Field share(point.size(), 0.0);
  for (std::size_t i = 0; i < share.size(); ++i) {
    const double strain = point.plastic_strain[i];
    const bool flows = strain - strain_before_[i] > least_increment;
    strain_before_[i] = strain;
    idle_[i] = flows ? 0.0 : idle_[i] + elapsed_;
    if (flows) flow_time_[i] += elapsed_;
    const bool whole = !point.damaged.on() || point.softening[i] == 0.0;
    if (strain > least_strain && idle_[i] > 0.0 && whole)
      share[i] = annealing_due(idle_[i], elapsed_, flow_time_[i]);
  }
  elapsed_ = 0.0;
  return share;
}

template<int dim> void StressAnnealing<dim>::stressed(const Body<dim>& body, Booked& booked) {
  const StabilisationLinks<dim>& links = body.approximation.links;
  if (links.neighbour.empty()) return;
  PointState<dim>& point = body.state.point;
  const Field share = shares(point);
  Field mass(point.size());
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] = body.operators().volume[i] * point.stress_free[i];
  const LinkSmoother<dim> smoother(links, body.reference, share, point.material, mass, strength_);
  if (smoother.nodes().empty()) return;
  const double before = integral<dim>(body, point.stored_energy);
  std::vector<typename LinkSmoother<dim>::Values> strains;
  strains.reserve(smoother.nodes().size());
  Fields<symmetric_size<dim>>& elastic_tensor = point.inverse_plastic_cauchy_green;
  std::vector<typename LinkSmoother<dim>::Values> causes; // of stress: without expansion by heat
  for (const std::int32_t node : smoother.nodes()) {
    const std::size_t i = index_of(node);
    strains.push_back(plasticity::logarithm<dim>(plasticity::at_point<dim>(elastic_tensor, i)));
    causes.push_back(strains.back());
    causes.back().template head<3>() -= 2.0 * body.material_of(i).thermal_strain(point.temperature[i]);
  }
  const auto change = smoother.change(causes);
  for (std::size_t a = 0; a < change.size(); ++a) {
    const auto i = index_of(smoother.nodes()[a]);
    const plasticity::Symmetric<dim> annealed = plasticity::exponential<dim>(
        plasticity::within_yield<dim>(body.material_of(i), (strains[a] + change[a]).matrix(), point, i, 1.0));
    for (std::size_t k = 0; k < elastic_tensor.size(); ++k)
      elastic_tensor[k][i] = annealed[static_cast<Eigen::Index>(k)];
    point.volume_drift[i] += 0.5 * change[a].template head<3>().sum();
  }
  const std::ptrdiff_t bad =
      plasticity::update_stress(body.model.materials, point.material, plasticity::stress_points(point), 0,
                                static_cast<std::ptrdiff_t>(point.size()), 0.0);
  assert(bad < 0);
  static_cast<void>(bad);
  const double lost = before - integral<dim>(body, point.stored_energy);
  dissipated_.value += lost;
  booked.elastic += lost;
}

template<int dim> std::unique_ptr<Term<dim>> stress_annealing(const Model<dim>& model) {
  if (!(model.stress_annealing > 0.0)) return nullptr;
  return std::make_unique<StressAnnealing<dim>>(model.stress_annealing);
}

template std::unique_ptr<Term<2>> stress_annealing(const Model<2>&);
template std::unique_ptr<Term<3>> stress_annealing(const Model<3>&);

} // namespace cnem
