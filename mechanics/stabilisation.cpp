#include "mechanics/stabilisation.hpp"

namespace cnem {

template<int dim> void EdgeDefect<dim>::reset(const Field& shear_modulus) {
  if (modulus_.size() != shear_modulus.size()) modulus_ = shear_modulus;
  modulus_before_ = modulus_;
}

template<int dim>
void EdgeDefect<dim>::update_modulus(const Field& shear_modulus, const Field& flow_stress,
                                     const Field& plastic_strain, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    modulus_before_[i] = modulus_[i];
    const double elastic_limit = flow_stress[i] / (3.0 * shear_modulus[i]);
    if (plastic_strain[i] > 0.0)
      modulus_[i] = shear_modulus[i] * elastic_limit / (elastic_limit + plastic_strain[i]);
  }
}

template<int dim>
typename EdgeDefect<dim>::Energy
EdgeDefect<dim>::apply(const StabilisationLinks<dim>& links, const DiscreteOperators<dim>& operators,
                       const Fields<dim>& reference, const Fields<dim>& position,
                       const Fields<tensor_size<dim>>& deformation, Fields<tensor_size<dim>>& piola,
                       Fields<dim>& force, std::size_t begin, std::size_t end) const {
  const auto X = pointers(reference);
  const auto x = pointers(position);
  const auto F = pointers(deformation);
  const std::int32_t* neighbour = links.neighbour.data();
  double stored = 0.0, released = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    double fi[dim] = {}, moment[dim][dim] = {};
    for (auto e = static_cast<std::size_t>(links.begin[i]); e < static_cast<std::size_t>(links.begin[i + 1]);
         ++e) {
      const auto j = static_cast<std::size_t>(neighbour[e]);
      double dX[dim], r[dim], r2 = 0.0;
      for (std::size_t k = 0; k < dim; ++k) dX[k] = X[k][j] - X[k][i];
      for (std::size_t a = 0; a < dim; ++a) {
        r[a] = x[a][j] - x[a][i];
        for (std::size_t k = 0; k < dim; ++k) r[a] -= 0.5 * (F[a * dim + k][i] + F[a * dim + k][j]) * dX[k];
        r2 += r[a] * r[a];
      }
      const double scale = 0.5 * alpha_ * links.weight[e];
      const double k_now = scale * (modulus_[i] + modulus_[j]);
      const double k_fall = scale * (modulus_before_[i] + modulus_before_[j]) - k_now;
      stored += k_now * r2;
      released += k_fall * r2;
      for (std::size_t a = 0; a < dim; ++a) {
        const double kr = k_now * r[a];
        fi[a] += kr;
        for (std::size_t k = 0; k < dim; ++k) moment[a][k] += kr * dX[k];
      }
    }
    const double half_inverse_volume = 0.5 / operators.volume[i];
    for (std::size_t a = 0; a < dim; ++a) {
      force[a][i] += fi[a];
      for (std::size_t k = 0; k < dim; ++k) piola[a * dim + k][i] -= half_inverse_volume * moment[a][k];
    }
  }
  return {0.25 * stored, 0.25 * released}; // ½ of ½ Σ k|r|²: every link is seen from both its ends
}

template<int dim> void EdgeDefect<dim>::archive(Archive& archive) {
  archive.field("solver/point/penalty_modulus", "Pa", modulus_);
  archive.field("solver/point/penalty_modulus_before", "Pa", modulus_before_);
}

template class EdgeDefect<2>;
template class EdgeDefect<3>;

} // namespace cnem
