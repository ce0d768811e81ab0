#include "mechanics/bulk_viscosity.hpp"

#include "core/isa.hpp"

namespace cnem {

namespace {

template<int dim>
ViscousSums viscous(const ViscousPoints<dim>& points, const BulkViscosity& viscosity, double dt,
                    std::ptrdiff_t begin, std::ptrdiff_t end) {
  CNEM_ON_ACTIVE_ISA(viscous_stress(points, viscosity.quadratic, viscosity.linear, dt, begin, end));
}

} // namespace

template<int dim>
ViscousSums add_bulk_viscosity(const BulkViscosity& viscosity, const DiscreteOperators<dim>& operators,
                               const PointState<dim>& point, const Field& density, const Field& wave_modulus,
                               double dt, Field& jacobian, Field& pressure, ColumnStress<dim>& total,
                               std::size_t begin, std::size_t end) {
  ViscousPoints<dim> points{};
  for (std::size_t c = 0; c < point.piola.size(); ++c) {
    points.deformation[c] = point.deformation[c].data();
    points.piola[c] = point.piola[c].data();
  }
  points.density = density.data();
  points.wave_modulus = wave_modulus.data();
  points.volume = operators.volume.data();
  points.radius = operators.of_revolution() ? operators.radius.data() : nullptr;
  points.jacobian = jacobian.data();
  points.pressure = pressure.data();
  points.columns = total.columns.data();
  points.out_of_plane = total.out_of_plane.data();
  return viscous(points, viscosity, dt, static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end));
}

template ViscousSums add_bulk_viscosity<2>(const BulkViscosity&, const DiscreteOperators<2>&,
                                           const PointState<2>&, const Field&, const Field&, double, Field&,
                                           Field&, ColumnStress<2>&, std::size_t, std::size_t);
template ViscousSums add_bulk_viscosity<3>(const BulkViscosity&, const DiscreteOperators<3>&,
                                           const PointState<3>&, const Field&, const Field&, double, Field&,
                                           Field&, ColumnStress<3>&, std::size_t, std::size_t);

} // namespace cnem
