#pragma once
// Logarithm and exponential of symmetric tensors, for the averaging of elastic states (paper 004, (31)).
#include "core/fields/state.hpp"
#include "plasticity/material.hpp"

#include <Eigen/Core>

namespace cnem::plasticity {

/// Components of a symmetric tensor as in core/fields/state.hpp: 2D xx, yy, zz, xy; 3D xx, yy, zz, xy, yz,
/// zx.
template<int dim> using Symmetric = Eigen::Matrix<double, symmetric_size<dim>, 1>;

/// The tensor of point p.
template<int dim> Symmetric<dim> at_point(const Fields<symmetric_size<dim>>& fields, std::size_t p) {
  Symmetric<dim> a;
  for (std::size_t k = 0; k < fields.size(); ++k) a[static_cast<Eigen::Index>(k)] = fields[k][p];
  return a;
}

/// ln b of a positive definite tensor. NaN where it is not.
template<int dim> Symmetric<dim> logarithm(const Symmetric<dim>& b);
/// exp h.
template<int dim> Symmetric<dim> exponential(const Symmetric<dim>& h);

/// σ_eq in Pa of point p with ln b_e = 2 ε_e: von Mises', 2μ √(3/2) |dev ε_e|, or that of an anisotropic
/// material on a new reference, its axes turned by F₀.
template<int dim>
double equivalent_stress(const Material& material, const Symmetric<dim>& log_elastic,
                         const PointState<dim>& point, std::size_t p);

/// ln b_e whose deviatoric part is drawn back so that σ_eq, `stress` before, does not exceed `yield` (Pa).
/// The volume change stays.
template<int dim> Symmetric<dim> limited_to(const Symmetric<dim>& log_elastic, double yield, double stress);

/// The same of point p of a material with its strain, rate and temperature: no further than `share` of its
/// flow stress.
template<int dim>
Symmetric<dim> within_yield(const Material& material, const Symmetric<dim>& log_elastic,
                            const PointState<dim>& point, std::size_t p, double share);

} // namespace cnem::plasticity
