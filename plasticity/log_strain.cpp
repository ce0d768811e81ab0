#include "plasticity/log_strain.hpp"

#include "plasticity/material_frame.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace cnem::plasticity {

namespace {

using Tensor = Eigen::Matrix3d;

template<int dim> Tensor full(const Symmetric<dim>& a) {
  Tensor t = Tensor::Zero();
  t.diagonal() = a.template head<3>();
  t(0, 1) = t(1, 0) = a[3];
  if constexpr (dim == 3) {
    t(1, 2) = t(2, 1) = a[4];
    t(0, 2) = t(2, 0) = a[5];
  }
  return t;
}

template<int dim> Symmetric<dim> packed(const Tensor& t) {
  Symmetric<dim> a;
  a.template head<3>() = t.diagonal();
  a[3] = t(0, 1);
  if constexpr (dim == 3) {
    a[4] = t(1, 2);
    a[5] = t(0, 2);
  }
  return a;
}

template<int dim, class Function> Symmetric<dim> isotropic(const Symmetric<dim>& a, const Function& f) {
  const Eigen::SelfAdjointEigenSolver<Tensor> spectrum(full<dim>(a));
  const Tensor& axis = spectrum.eigenvectors();
  return packed<dim>(axis * spectrum.eigenvalues().unaryExpr(f).asDiagonal() * axis.transpose());
}

} // namespace

template<int dim> Symmetric<dim> logarithm(const Symmetric<dim>& b) {
  return isotropic<dim>(b, [](double v) { return std::log(v); });
}

template<int dim> Symmetric<dim> exponential(const Symmetric<dim>& h) {
  return isotropic<dim>(h, [](double v) { return std::exp(v); });
}

namespace {

template<int dim> Symmetric<dim> deviator_of(const Symmetric<dim>& log_elastic) {
  Symmetric<dim> deviator = log_elastic;
  deviator.template head<3>().array() -= log_elastic.template head<3>().sum() / 3.0;
  return deviator;
}

} // namespace

template<int dim>
double equivalent_stress(const Material& material, const Symmetric<dim>& log_elastic,
                         const PointState<dim>& point, std::size_t p) {
  const Symmetric<dim> deviator = deviator_of<dim>(log_elastic);
  const double mu = material.elasticity.mu();
  if (!material.anisotropy) {
    // ε_e is half the logarithm; shear components stand for two entries of the tensor
    const double norm = std::sqrt(deviator.template head<3>().squaredNorm() +
                                  2.0 * deviator.template tail<symmetric_size<dim> - 3>().squaredNorm());
    return mu * std::sqrt(1.5) * norm;
  }
  double unit[tensor_size<dim>], earlier[tensor_size<dim>], strain[symmetric_size<dim>],
      turned[symmetric_size<dim>], stress[6] = {};
  for (std::size_t k = 0; k < tensor_size<dim>; ++k) {
    unit[k] = rest_unit_general<dim>[k];
    earlier[k] = point.earlier_deformation[k][p];
  }
  for (int k = 0; k < symmetric_size<dim>; ++k) strain[k] = deviator[k];
  generic::MaterialFrame<dim, double>(unit, earlier).enter(strain, turned);
  for (int k = 0; k < symmetric_size<dim>; ++k) stress[k] = mu * turned[k];
  return hill_stress(material.anisotropy->form(), stress);
}

template<int dim> Symmetric<dim> limited_to(const Symmetric<dim>& log_elastic, double yield, double stress) {
  if (stress <= yield) return log_elastic;
  Symmetric<dim> deviator = deviator_of<dim>(log_elastic);
  deviator *= yield / stress;
  deviator.template head<3>().array() += log_elastic.template head<3>().sum() / 3.0;
  return deviator;
}

template<int dim>
Symmetric<dim> within_yield(const Material& material, const Symmetric<dim>& log_elastic,
                            const PointState<dim>& point, std::size_t p, double share) {
  if (!material.hardening) return log_elastic;
  const double yield =
      share * point.strength[p] *
      material.hardening->flow_stress(point.plastic_strain[p], point.plastic_rate[p], point.temperature[p]);
  return limited_to<dim>(log_elastic, yield, equivalent_stress<dim>(material, log_elastic, point, p));
}

#define CNEM_INSTANTIATE(dim)                                                                                \
  template Symmetric<dim> logarithm<dim>(const Symmetric<dim>&);                                             \
  template Symmetric<dim> exponential<dim>(const Symmetric<dim>&);                                           \
  template double equivalent_stress<dim>(const Material&, const Symmetric<dim>&, const PointState<dim>&,     \
                                         std::size_t);                                                       \
  template Symmetric<dim> limited_to<dim>(const Symmetric<dim>&, double, double);                            \
  template Symmetric<dim> within_yield<dim>(const Material&, const Symmetric<dim>&, const PointState<dim>&,  \
                                            std::size_t, double);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem::plasticity
