#include "mechanics/terms/bulk_viscosity.hpp"

#include "core/index.hpp"
#include "core/machine/isa.hpp"
#include "core/machine/parallel.hpp"
#include "mechanics/terms/list.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace cnem {

namespace {

template<int dim>
ViscousSums viscous(const ViscousPoints<dim>& points, const BulkViscosity& viscosity, double dt,
                    std::ptrdiff_t begin, std::ptrdiff_t end) {
  CNEM_ON_ACTIVE_ISA(viscous_stress(points, viscosity.quadratic, viscosity.linear, dt, begin, end));
}

} // namespace

template<int dim>
void set_length_shares(const DiscreteOperators<dim>& operators, const Field& density, const Field& mass,
                       const Ties<dim>& ties, Field& share) {
  const auto points = index_of(operators.points);
  const auto gradient = [&](std::size_t e) {
    Vec<dim> b;
    for (std::size_t k = 0; k < dim; ++k) b[as<Eigen::Index>(k)] = operators.gradient[k][e];
    return b;
  };
  Field inertia = mass, all(mass.size(), 0.0); // [node] Σ_q V_q |b_qJ|²
  for (std::size_t p = 0; p < points; ++p)
    for (auto e = index_of(operators.row_begin[p]); e < index_of(operators.row_begin[p + 1]); ++e)
      all[index_of(operators.node[e])] += operators.volume[p] * gradient(e).squaredNorm();
  ties.each_group([&](std::span<const NodeIndex> nodes) {
    for (Field* field : {&inertia, &all}) {
      double sum = 0.0;
      for (const NodeIndex i : nodes) sum += (*field)[index_of(i)];
      for (const NodeIndex i : nodes) (*field)[index_of(i)] = sum;
    }
  });
  share.resize(points);
  for_each_block(points, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const double volume = operators.volume[p];
      Mat<dim> sum = Mat<dim>::Zero();
      for (auto e = index_of(operators.row_begin[p]); e < index_of(operators.row_begin[p + 1]); ++e) {
        const Vec<dim> b = gradient(e);
        const auto node = index_of(operators.node[e]);
        const double beside = std::min(2.0, all[node] / (volume * b.squaredNorm()));
        sum += beside / inertia[node] * b * b.transpose();
      }
      Eigen::SelfAdjointEigenSolver<Mat<dim>> axes;
      axes.computeDirect(sum, Eigen::EigenvaluesOnly);
      const double extent = operators.of_revolution()
                                ? volume / (2.0 * std::numbers::pi * operators.radius[p])
                                : volume,
                   length = dim == 2 ? std::sqrt(extent) : std::cbrt(extent);
      share[p] =
          1.0 / std::max(1.0, 0.5 * length * std::sqrt(density[p] * volume * axes.eigenvalues()[dim - 1]));
    }
  });
}

template<int dim>
ViscousSums add_bulk_viscosity(const BulkViscosity& viscosity, const DiscreteOperators<dim>& operators,
                               const Field& length_share, PointState<dim>& point, double dt,
                               const EdgePoints& edge, ColumnStress<dim>& total, std::size_t begin,
                               std::size_t end) {
  ViscousPoints<dim> points{};
  for (std::size_t c = 0; c < point.piola.size(); ++c) {
    points.deformation[c] = point.deformation[c].data();
    points.piola[c] = point.piola[c].data();
  }
  points.density = point.density.data();
  points.wave_modulus = point.wave_modulus.data();
  points.volume = operators.volume.data();
  points.length_share = length_share.data();
  points.radius = operators.of_revolution() ? operators.radius.data() : nullptr;
  points.jacobian = point.jacobian.data();
  points.pressure = point.viscous_pressure.data();
  points.columns = total.columns.data();
  points.out_of_plane = total.out_of_plane.data();
  points.plastic_rate = point.plastic_rate.data();
  points.equivalent_stress = point.equivalent_stress.data();
  points.flow_stress = point.flow_stress.data();
  points.edge = edge;
  return viscous(points, viscosity, dt, static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end));
}

namespace {

template<int dim> class ViscousTerm : public Term<dim> {
public:
  std::vector<Energy*> energies() override { return {&dissipated_}; }
  double critical_damping() const override { return damping_; }
  void archive(Archive& archive) override { archive.number("solver/viscosity_ratio", "1", damping_); }
  void attach(const Body<dim>& body) override {
    set_length_shares(body.operators(), body.state.point.density, body.state.node.inertia(),
                      body.conditions.ties, length_share_);
  }
  void begin_step(const Body<dim>&) override { damping_ = 0.0; }
  void begin_stress(const Body<dim>&, const DuePoints& due) override {
    sums_.assign(due.ranges.size(), {0.0, 0.0});
  }
  void after_stress(const Body<dim>& body, const DuePoints& due, const LevelRange& range) override {
    sums_[due.index(range)] =
        add_bulk_viscosity<dim>(body.model.viscosity, body.operators(), length_share_, body.state.point,
                                due.own(range), body.edge, body.stress, range.begin, range.end);
  }
  void end_stress(const Body<dim>&, const DuePoints&) override {
    double dissipated = 0.0;
    for (const ViscousSums& sum : sums_) {
      dissipated += sum.dissipated;
      damping_ = std::max(damping_, sum.damping);
    }
    dissipated_.value += dissipated;
  }

private:
  Energy dissipated_{"viscosity", EnergyKind::dissipated};
  Field length_share_;   ///< [point] of the reference
  double damping_ = 0.0; ///< largest share of critical damping in the macro step
  std::vector<ViscousSums> sums_;
};

} // namespace

template<int dim> std::unique_ptr<Term<dim>> bulk_viscosity(const Model<dim>&) {
  return std::make_unique<ViscousTerm<dim>>();
}

template std::unique_ptr<Term<2>> bulk_viscosity(const Model<2>&);
template std::unique_ptr<Term<3>> bulk_viscosity(const Model<3>&);
template void set_length_shares(const DiscreteOperators<2>&, const Field&, const Field&, const Ties<2>&,
                                Field&);
template void set_length_shares(const DiscreteOperators<3>&, const Field&, const Field&, const Ties<3>&,
                                Field&);
template ViscousSums add_bulk_viscosity<3>(const BulkViscosity&, const DiscreteOperators<3>&, const Field&,
                                           PointState<3>&, double, const EdgePoints&, ColumnStress<3>&,
                                           std::size_t, std::size_t);

} // namespace cnem
