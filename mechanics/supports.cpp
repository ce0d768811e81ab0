#include "mechanics/supports.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/machine/parallel.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cnem {

template<int dim>
Supports<dim>::Supports(std::vector<Support<dim>> supports, std::size_t nodes)
    : support_(std::move(supports)), reaction_(support_.size(), Vec<dim>::Zero()) {
  resolve(nodes);
}

template<int dim> void Supports<dim>::replace(std::vector<Support<dim>> supports, std::size_t nodes) {
  Supports<dim> others(std::move(supports), nodes);
  others.work_ = work_;
  *this = std::move(others);
}

template<int dim> void Supports<dim>::resample(const Resampling<dim>& change, const Ties<dim>& ties) {
  for (Support<dim>& support : support_)
    support.nodes = ties.with_partners(renumbered(change, std::span<const NodeIndex>(support.nodes),
                                                  std::span<const PieceIndex>(support.pieces)));
  resolve(change.cloud.position.size());
}

template<int dim> void Supports<dim>::resolve(std::size_t nodes) {
  prescribed_.clear();
  constraints_.clear();
  first_held_.assign(1, 0);
  IndexedVector<NodeIndex, std::vector<Prescribed>> held(nodes);
  for (std::size_t s = 0; s < support_.size(); ++s) {
    const bool moving = support_[s].kind != Support<dim>::Kind::symmetry;
    for (const NodeIndex node : support_[s].nodes) {
      auto& mine = held[node];
      Vec<dim> rest = support_[s].direction;
      bool oblique_to_moving = false;
      for (const Prescribed& other : mine) {
        const double along = rest.dot(other.direction);
        const bool other_moves = support_[index_of(other.support)].kind != Support<dim>::Kind::symmetry;
        oblique_to_moving |=
            std::abs(along) > 1e-9 && std::abs(along) < 1.0 - 1e-9 && (moving || other_moves);
        rest -= along * other.direction;
      }
      if (oblique_to_moving)
        throw InputError(fmt::format(
            "support '{}' is oblique to support '{}' at a node they share, expected directions of "
            "prescribed motion that are equal or at right angles",
            support_[s].name, support_[index_of(mine.front().support)].name));
      if (rest.norm() < 1e-9) continue;
      mine.push_back({node, as<std::int32_t>(s), rest.normalized()});
    }
  }
  for (const NodeIndex i : held.indices()) {
    if (held[i].empty()) continue;
    Mat<dim> free = Mat<dim>::Identity();
    for (const Prescribed& p : held[i]) {
      free -= p.direction * p.direction.transpose();
      prescribed_.push_back(p);
    }
    constraints_.push_back({i, free});
    first_held_.push_back(prescribed_.size());
  }
  share_.resize(prescribed_.size());
}

template<int dim>
void Supports<dim>::apply(double time, double dt, double dt_mean, const Field& mass,
                          const Fields<dim>& before, Fields<dim>& velocity) {
  std::vector<double> target(support_.size(), 0.0);
  for (std::size_t s = 0; s < support_.size(); ++s) {
    reaction_[s].setZero();
    const TimeTable& value = support_[s].value;
    if (support_[s].kind == Support<dim>::Kind::velocity)
      target[s] = (value.integral(time + dt) - value.integral(time)) / dt;
    else if (support_[s].kind == Support<dim>::Kind::displacement)
      target[s] = (value(time + dt) - value(time)) / dt;
  }
  for_each_block(constraints_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = first_held_[begin]; h < first_held_[end]; ++h) {
      const Prescribed& p = prescribed_[h];
      const auto i = index_of(p.node);
      const double wanted = target[index_of(p.support)];
      double now = 0.0, was = 0.0;
      for (std::size_t k = 0; k < dim; ++k) {
        now += velocity[k][i] * p.direction[static_cast<Eigen::Index>(k)];
        was += before[k][i] * p.direction[static_cast<Eigen::Index>(k)];
      }
      const double impulse = mass[i] * (wanted - now);
      for (std::size_t k = 0; k < dim; ++k)
        velocity[k][i] += (wanted - now) * p.direction[static_cast<Eigen::Index>(k)];
      share_[h] = {impulse / dt_mean, 0.5 * impulse * (was + wanted)};
    }
  });
  for (std::size_t h = 0; h < prescribed_.size(); ++h) { // in one order, whatever the number of threads
    reaction_[index_of(prescribed_[h].support)] += share_[h].force * prescribed_[h].direction;
    work_ += share_[h].work;
  }
}

template<int dim> void Supports<dim>::archive(Archive& archive) {
  for (std::size_t s = 0; s < reaction_.size(); ++s)
    archive.vector<dim>(fmt::format("solver/supports/{}/reaction", s), "N/m", reaction_[s]);
  archive.number("solver/energy/support_work", "J/m", work_);
}

template<int dim> void Supports<dim>::archive_nodes(Archive& archive, std::size_t nodes) {
  for (std::size_t s = 0; s < support_.size(); ++s)
    archive.integers(fmt::format("solver/supports/{}/nodes", s), support_[s].nodes);
  if (archive.loading()) resolve(nodes);
}

template<int dim> double Supports<dim>::displacement(std::int32_t s, double time) const {
  const Support<dim>& support = support_[index_of(s)];
  switch (support.kind) {
  case Support<dim>::Kind::velocity:
    return support.value.integral(time);
  case Support<dim>::Kind::displacement:
    return support.value(time);
  case Support<dim>::Kind::symmetry:
    break;
  }
  return 0.0;
}

template class Supports<2>;
template class Supports<3>;

} // namespace cnem
