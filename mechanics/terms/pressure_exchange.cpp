#include "mechanics/terms/pressure_exchange.hpp"

#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "mechanics/terms/list.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {
namespace {

template<int dim> std::vector<char> boundary_nodes(const std::vector<Facet<dim>>& facets, std::size_t nodes) {
  std::vector<char> on_boundary(nodes, 0);
  for (const Facet<dim>& facet : facets)
    for (const NodeIndex node : facet.node) on_boundary[index_of(node)] = 1;
  return on_boundary;
}

/// Of a record, in doubles.
template<int dim> constexpr std::size_t stride = dim + 6;

constexpr double most_drift = 0.05; ///< of Σ δθ: measured, docs/pressure_exchange.md

/// Times the largest difference of pressure that a node has with its neighbours: a gradient that is taken
/// over no more than their distance adds as much again. That of a cell much smaller than those beside it is
/// taken further, and would make more of the jump in each step.
constexpr double most_beyond = 2.0;

/// What a node lets of an exchange pass that changes its volume by `flow` times something positive.
double room_to_drift(double drift, double flow) {
  return drift * flow > 0.0 ? std::max(0.0, 1.0 - std::abs(drift) / most_drift) : 1.0;
}

/// F⁻ᵀ as PointState lays tensors.
template<int dim>
std::array<double, tensor_size<dim>> inverse_transposed(const Fields<tensor_size<dim>>& f, std::size_t p) {
  if constexpr (dim == 2) {
    const double plane = f[0][p] * f[3][p] - f[1][p] * f[2][p];
    return {f[3][p] / plane, -f[2][p] / plane, -f[1][p] / plane, f[0][p] / plane, 1.0 / f[4][p]};
  } else {
    std::array<double, 9> result = cofactors<3>(f, p);
    const double determinant = jacobian<3>(f, p);
    for (double& component : result) component /= determinant;
    return result;
  }
}

/// Adds δθ to the logarithmic elastic volume of point p, with all that follows from it.
template<int dim>
void swell(PointState<dim>& point, ColumnStress<dim>& stress, std::size_t p, double kappa, double dtheta) {
  const double root = std::exp(-dtheta / 3.0), scale = 1.0 / (root * root), shrink = root * root * root;
  const double tension = -point.pressure[p];
  std::array<double, tensor_size<dim>> change = inverse_transposed<dim>(point.deformation, p);
  for (std::size_t c = 0; c < change.size(); ++c) {
    const double before = point.piola[c][p];
    point.piola[c][p] = shrink * (before + kappa * dtheta * point.stress_free[p] * change[c]);
    change[c] = point.piola[c][p] - before;
  }
  for (std::size_t i = 0; i < dim; ++i)
    for (std::size_t k = 0; k < dim; ++k)
      stress.columns[(p * dim + k) * beside<dim> + i] += change[i * dim + k];
  if constexpr (dim == 2) stress.out_of_plane[p] += change[4];
  for (Field& component : point.inverse_plastic_cauchy_green) component[p] *= scale;
  point.stored_energy[p] += dtheta * (tension + 0.5 * kappa * dtheta);
  point.pressure[p] -= kappa * dtheta;
  point.stress_free[p] *= shrink;
}

} // namespace

template<int dim> void PressureExchange<dim>::reset(Field bulk_modulus) {
  bulk_modulus_ = std::move(bulk_modulus);
  record_.assign(stride<dim> * bulk_modulus_.size(), 0.0);
}

template<int dim> void PressureExchange<dim>::remember(const Field& pressure, const DuePoints& due) {
  before_.resize(pressure.size());
  for_each_range(due.ranges, [&](const LevelRange& range) {
    for (std::size_t i = range.begin; i < range.end; ++i) before_[i] = pressure[i];
  });
}

template<int dim>
typename PressureExchange<dim>::Change
PressureExchange<dim>::apply(const DiscreteOperators<dim>& operators, const StabilisationLinks<dim>& links,
                             const Field& reference, const DuePoints& due, PointState<dim>& point,
                             ColumnStress<dim>& stress) {
  constexpr std::size_t stride = cnem::stride<dim>, increment = dim + 1, strength = dim + 2, room = dim + 3,
                        drift = dim + 4, largest = dim + 5;
  const auto whole = [&](std::size_t i) { return !point.damaged.on() || point.softening[i] == 0.0; };
  const auto level_of = [&](std::size_t i) { return level_.empty() ? 0 : int{level_[i]}; };
  const std::int32_t *row = operators.row_begin.data(), *first = links.begin.data();
  const NodeIndex *node = operators.node.data(), *neighbour = links.neighbour.data();
  const double *pressure = point.pressure.data(), *weight = links.weight.data();
  const auto gradient = pointers(operators.gradient);
  for_each_range(due.ranges, [&](const LevelRange& range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      double* own = record_.data() + stride * i;
      own[increment] = 0.0;
      if (level_of(i) > due.activity || !(point.plastic_rate[i] > 0.0) || !whole(i)) continue;
      double g[dim] = {}, most = 0.0;
      for (std::int32_t e = row[i]; e < row[i + 1]; ++e) {
        const double jump = pressure[index_of(point_of(node[e]))] - pressure[i];
        most = std::max(most, std::abs(jump));
        for (std::size_t k = 0; k < dim; ++k) g[k] += gradient[k][e] * jump;
      }
      for (std::size_t k = 0; k < dim; ++k) own[1 + k] = g[k];
      own[0] = pressure[i];
      own[increment] = point.plastic_rate[i] * due.dt;
      own[strength] = point.equivalent_stress[i];
      own[room] = operators.volume[i] / (first[i + 1] - first[i]);
      own[drift] = point.volume_drift[i];
      own[largest] = most;
    }
  });
  std::vector<Change> energy(due.ranges.size());
  for_each_range(due.ranges, [&](const LevelRange& range) {
    Change& sum = energy[due.index(range)];
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const double* own = record_.data() + stride * i;
      const int level = level_of(i);
      if (own[increment] == 0.0) continue;
      const double kappa = bulk_modulus_[i];
      double flow = 0.0;
      for (std::int32_t e = first[i]; e < first[i + 1]; ++e) {
        const auto j = index_of(neighbour[e]);
        const double* other = record_.data() + stride * j;
        if (level_of(j) > due.activity || other[increment] == 0.0 || bulk_modulus_[j] != kappa) continue;
        double linear = 0.0, distance2 = 0.0;
        for (std::size_t k = 0; k < dim; ++k) {
          const double X = reference[beside<dim> * j + k] - reference[beside<dim> * i + k];
          linear += (own[1 + k] + other[1 + k]) * X;
          distance2 += X * X;
        }
        const double difference = other[0] - own[0], beyond = difference - 0.5 * linear;
        const double jump =
            std::abs(beyond) <= most_beyond * std::max(own[largest], other[largest]) ? beyond : difference;
        const double flowed =
            std::min(own[increment], other[increment]) * (1 << std::max(level, level_of(j)));
        const double plastic =
            alpha_ * weight[e] * distance2 * 3.0 * flowed / (own[strength] + other[strength]);
        const double free = std::min(room_to_drift(own[drift], -jump), room_to_drift(other[drift], jump));
        flow += std::min(plastic, 0.5 * std::min(own[room], other[room]) / kappa) * free * jump;
      }
      if (flow == 0.0) continue;
      const double volume = operators.volume[i], dtheta = -flow / volume, stress_free = point.stress_free[i];
      swell<dim>(point, stress, i, kappa, dtheta);
      const double traded = volume * (stress_free - point.stress_free[i]);
      sum.dissipated += volume * stress_free * 0.5 * (before_[i] + point.pressure[i]) * dtheta +
                        traded * point.stored_energy[i];
      sum.plastic += traded * point.plastic_work[i];
      point.volume_drift[i] += dtheta;
    }
  });
  Change total;
  for (const Change& part : energy) {
    total.dissipated += part.dissipated;
    total.plastic += part.plastic;
  }
  return total;
}

template<int dim> void PressureExchange<dim>::attach(const Body<dim>& body) {
  if (!active(body.approximation.links)) return;
  Field bulk_modulus(body.state.point.size());
  for (std::size_t p = 0; p < bulk_modulus.size(); ++p)
    bulk_modulus[p] = body.material_of(p).elasticity.kappa();
  reset(std::move(bulk_modulus));
}

template<int dim> void PressureExchange<dim>::set_levels(const Body<dim>& body) {
  level_.clear();
  if (!active(body.approximation.links) || body.levels.highest() == 0) return;
  const DiscreteOperators<dim>& operators = body.operators();
  const std::vector<std::int8_t>& of_block = body.levels.level();
  level_.resize(index_of(operators.points));
  for (std::size_t i = 0; i < level_.size(); ++i) {
    level_[i] = of_block[i / LocalSteps<dim>::block];
    for (std::int32_t e = operators.row_begin[i]; e < operators.row_begin[i + 1]; ++e)
      level_[i] =
          std::max(level_[i], of_block[index_of(operators.node[index_of(e)]) / LocalSteps<dim>::block]);
  }
}

template<int dim> void PressureExchange<dim>::begin_stress(const Body<dim>& body, const DuePoints& due) {
  if (active(body.approximation.links)) remember(body.state.point.pressure, due);
}

template<int dim> void PressureExchange<dim>::end_stress(const Body<dim>& body, const DuePoints& due) {
  if (!active(body.approximation.links)) return;
  const Change change =
      apply(body.operators(), body.approximation.links, body.reference, due, body.state.point, body.stress);
  dissipated_.value += change.dissipated;
  body.plastic_offset += change.plastic;
}

template<int dim> std::vector<Metric> PressureExchange<dim>::metrics(const BodyView<dim>& body) const {
  double sum = 0.0, most = 0.0;
  const Field& drift = body.state.point.volume_drift;
  for (const double theta : drift) {
    sum += theta * theta;
    most = std::max(most, std::abs(theta));
  }
  return {{"pressure_noise",
           pressure_noise<dim>(body.approximation.links, body.conditions.cloud.facets, body.state.point)},
          {"volume_drift", drift.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(drift.size())),
           "volume_drift", Keep::largest},
          {"max.volume_drift", most, "max.volume_drift", Keep::largest}};
}

template<int dim> std::unique_ptr<Term<dim>> pressure_exchange(const Model<dim>& model) {
  return std::make_unique<PressureExchange<dim>>(model.pressure_exchange);
}

template std::unique_ptr<Term<2>> pressure_exchange(const Model<2>&);
template std::unique_ptr<Term<3>> pressure_exchange(const Model<3>&);
template<int dim>
double pressure_noise(const StabilisationLinks<dim>& links, const std::vector<Facet<dim>>& facets,
                      const PointState<dim>& point) {
  if (links.neighbour.empty()) return 0.0;
  const std::vector<char> on_boundary = boundary_nodes(facets, point.size());
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (on_boundary[i] || !(point.plastic_rate[i] > 0.0) || !(point.equivalent_stress[i] > 0.0)) continue;
    double mean = 0.0;
    for (std::int32_t e = links.begin[i]; e < links.begin[i + 1]; ++e)
      mean += point.pressure[index_of(point_of(links.neighbour[index_of(e)]))];
    mean /= links.begin[i + 1] - links.begin[i];
    sum += std::pow((point.pressure[i] - mean) / point.equivalent_stress[i], 2);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

template class PressureExchange<2>;
template class PressureExchange<3>;
template double pressure_noise<2>(const StabilisationLinks<2>&, const std::vector<Facet<2>>&,
                                  const PointState<2>&);
template double pressure_noise<3>(const StabilisationLinks<3>&, const std::vector<Facet<3>>&,
                                  const PointState<3>&);

} // namespace cnem
