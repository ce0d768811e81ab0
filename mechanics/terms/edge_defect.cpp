#include "mechanics/terms/edge_defect.hpp"

#include "core/index.hpp"
#include "core/machine/isa.hpp"
#include "mechanics/failing_links.hpp"
#include "mechanics/terms/list.hpp"

#include <algorithm>

namespace cnem {

template<int dim>
void EdgeDefect<dim>::store_records(const Fields<tensor_size<dim>>& deformation, const Field& reference,
                                    std::size_t begin, std::size_t end) {
  using Record = EdgeRecord<dim>;
  if (record_.size() != Record::size * modulus_.size()) record_.assign(Record::size * modulus_.size(), 0.0);
  const auto F = pointers(deformation);
  for (std::size_t i = begin; i < end; ++i) {
    double* own = record_.data() + Record::size * i;
    for (std::size_t a = 0; a < dim; ++a)
      for (std::size_t k = 0; k < dim; ++k) own[k * beside<dim> + a] = Record::share * F[a * dim + k][i];
    own[Record::modulus] = modulus_[i];
    own[Record::modulus_before] = modulus_before_[i];
    for (std::size_t k = 0; k < dim; ++k) own[Record::place + k] = reference[beside<dim> * i + k];
  }
}

template<int dim> void EdgeDefect<dim>::hold_moduli(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i)
    record_[EdgeRecord<dim>::size * i + EdgeRecord<dim>::modulus] = modulus_[i] = modulus_before_[i];
}

namespace {

template<int dim>
EdgeEnergy defect(const LinkRows& links, double alpha, const Field& volume, const Field& position,
                  const Field& record, Field& stress, double* const* force, std::size_t begin,
                  std::size_t end) {
  CNEM_ON_ACTIVE_ISA(edge_defect<dim>(links, alpha, volume.data(), position.data(), record.data(),
                                      stress.data(), force, static_cast<std::ptrdiff_t>(begin),
                                      static_cast<std::ptrdiff_t>(end)));
}

EdgeEnergy failing_defect(const LinkRows& links, double alpha, const Field& volume, const Field& position,
                          const Field& record, Field& stress, double* const* force, std::size_t begin,
                          std::size_t end) {
  CNEM_ON_ACTIVE_ISA(failing_edge_defect(links, alpha, volume.data(), position.data(), record.data(),
                                         stress.data(), force, static_cast<std::ptrdiff_t>(begin),
                                         static_cast<std::ptrdiff_t>(end)));
}

} // namespace

template<int dim>
EdgeEnergy EdgeDefect<dim>::apply(const StabilisationLinks<dim>& links, const Field& volume,
                                  const Field& position, ColumnStress<dim>& stress, Fields<dim>& force,
                                  std::size_t begin, std::size_t end) const {
  if constexpr (dim == 2)
    if (failing_)
      return failing_defect({links.begin.data(), links.neighbour.data(), links.weight.data()}, alpha_, volume,
                            position, record_, stress.columns, pointers(force).data(), begin, end);
  return defect<dim>({links.begin.data(), links.neighbour.data(), links.weight.data()}, alpha_, volume,
                     position, record_, stress.columns, pointers(force).data(), begin, end);
}

template<int dim> void EdgeDefect<dim>::limit(const Body<dim>& body, StepLimit& limit) {
  if (active(body.approximation.links)) limit.stabilisation += alpha_;
}

template<int dim> void EdgeDefect<dim>::leave(const Body<dim>&) { released_.value += stored_.value; }

template<int dim> void EdgeDefect<dim>::renew(const Body<dim>&) {
  modulus_before_ = modulus_;
  stored_.value = 0.0;
}

template<int dim> void EdgeDefect<dim>::begin_stress(const Body<dim>& body, const DuePoints&) {
  if (active(body.approximation.links)) body.edge = points(body.state.point);
}

template<int dim>
void EdgeDefect<dim>::after_stress(const Body<dim>& body, const DuePoints& due, const LevelRange& range) {
  if (!due.whole && active(body.approximation.links)) hold_moduli(range.begin, range.end);
}

template<int dim> void EdgeDefect<dim>::begin_forces(const Body<dim>& body, int activity) {
  energy_.assign(body.levels.points(activity).size(), {0.0, 0.0});
}

template<int dim>
void EdgeDefect<dim>::add_forces(const Body<dim>& body, int activity, const LevelRange& range) {
  const StabilisationLinks<dim>& links = body.approximation.links;
  if (!active(links)) return;
  const auto from = [&](const StabilisationLinks<dim>& part) {
    return apply(part, body.operators().volume, body.position, body.stress, body.state.node.force,
                 range.begin, range.end);
  };
  EdgeEnergy& sum = energy_[index_of(&range - body.levels.points(activity).data())];
  sum = from(body.levels.own_links(links));
  if (!range.marked || activity <= range.level) return; // twice as heavy as seen from the other end
  const EdgeEnergy coarse = from(body.levels.coarse_links());
  sum = {sum.stored + 0.5 * coarse.stored, sum.released + 0.5 * coarse.released};
}

template<int dim> void EdgeDefect<dim>::end_forces(const Body<dim>& body, int activity) {
  if (activity != body.levels.highest() || !active(body.approximation.links)) return;
  stored_.value = 0.0;
  for (const EdgeEnergy& e : energy_) {
    stored_.value += e.stored;
    released_.value += e.released;
  }
}

template<int dim> void EdgeDefect<dim>::restore(const Body<dim>& body) {
  if (active(body.approximation.links))
    store_records(body.state.point.deformation, body.reference, 0, body.state.point.size());
}

template<int dim> std::unique_ptr<Term<dim>> edge_defect(const Model<dim>& model) {
  const bool failing = std::any_of(model.materials.begin(), model.materials.end(),
                                   [](const plasticity::Material& own) { return own.failure.has_value(); });
  return std::make_unique<EdgeDefect<dim>>(model.stabilisation, failing);
}

template std::unique_ptr<Term<2>> edge_defect(const Model<2>&);
template std::unique_ptr<Term<3>> edge_defect(const Model<3>&);
template class EdgeDefect<2>;
template class EdgeDefect<3>;

} // namespace cnem
