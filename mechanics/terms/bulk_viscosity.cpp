#include "mechanics/terms/bulk_viscosity.hpp"

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
                               double dt, Field& jacobian, Field& pressure, Field& flow_stress,
                               const EdgePoints& edge, ColumnStress<dim>& total, std::size_t begin,
                               std::size_t end) {
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
  points.plastic_rate = point.plastic_rate.data();
  points.equivalent_stress = point.equivalent_stress.data();
  points.flow_stress = flow_stress.data();
  points.edge = edge;
  return viscous(points, viscosity, dt, static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end));
}

#define CNEM_INSTANTIATE(dim)                                                                                \
  template ViscousSums add_bulk_viscosity<dim>(const BulkViscosity&, const DiscreteOperators<dim>&,          \
                                               const PointState<dim>&, const Field&, const Field&, double,   \
                                               Field&, Field&, Field&, const EdgePoints&,                    \
                                               ColumnStress<dim>&, std::size_t, std::size_t);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem
