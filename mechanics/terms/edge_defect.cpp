#include "mechanics/terms/edge_defect.hpp"

#include "core/isa.hpp"

namespace cnem {

template<int dim> void EdgeDefect<dim>::reset(const Field& shear_modulus) {
  if (modulus_.size() != shear_modulus.size()) modulus_ = shear_modulus;
  modulus_before_ = modulus_;
}

template<int dim>
void EdgeDefect<dim>::store_records(const Fields<tensor_size<dim>>& deformation, std::size_t begin,
                                    std::size_t end) {
  constexpr std::size_t stride = dim * dim + 2;
  if (record_.size() != stride * modulus_.size()) record_.resize(stride * modulus_.size());
  const auto F = pointers(deformation);
  for (std::size_t i = begin; i < end; ++i) {
    double* own = record_.data() + stride * i;
    for (std::size_t a = 0; a < dim; ++a)
      for (std::size_t k = 0; k < dim; ++k) own[k * dim + a] = F[a * dim + k][i];
    own[dim * dim] = modulus_[i];
    own[dim * dim + 1] = modulus_before_[i];
  }
}

template<int dim> void EdgeDefect<dim>::hold_moduli(std::size_t begin, std::size_t end) {
  constexpr std::size_t stride = dim * dim + 2;
  for (std::size_t i = begin; i < end; ++i)
    record_[stride * i + dim * dim] = modulus_[i] = modulus_before_[i];
}

namespace {

template<int dim>
EdgeEnergy defect(const LinkRows& links, double alpha, const Field& volume, const Field& reference,
                  const Field& position, const Field& record, Field& stress, double* const* force,
                  std::size_t begin, std::size_t end) {
  CNEM_ON_ACTIVE_ISA(edge_defect<dim>(links, alpha, volume.data(), reference.data(), position.data(),
                                      record.data(), stress.data(), force, static_cast<std::ptrdiff_t>(begin),
                                      static_cast<std::ptrdiff_t>(end)));
}

} // namespace

template<int dim>
EdgeEnergy EdgeDefect<dim>::apply(const StabilisationLinks<dim>& links, const Field& volume,
                                  const Field& reference, const Field& position, ColumnStress<dim>& stress,
                                  Fields<dim>& force, std::size_t begin, std::size_t end) const {
  return defect<dim>({links.begin.data(), links.neighbour.data(), links.weight.data()}, alpha_, volume,
                     reference, position, record_, stress.columns, pointers(force).data(), begin, end);
}

template<int dim> void EdgeDefect<dim>::archive(Archive& archive) {
  archive.field("solver/point/penalty_modulus", "Pa", modulus_);
  archive.field("solver/point/penalty_modulus_before", "Pa", modulus_before_);
}

template class EdgeDefect<2>;
template class EdgeDefect<3>;

} // namespace cnem
