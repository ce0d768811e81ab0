// Plies in the step: wave moduli, the length that energies of failure are spread over, what damage lets go.
#include "core/index.hpp"
#include "mechanics/opening_width.hpp"
#include "mechanics/terms/list.hpp"
#include "plasticity/ply_update.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace cnem {

namespace {

template<int dim> class Plies : public Term<dim> {
public:
  explicit Plies(const Model<dim>& model)
      : failing_(std::any_of(model.materials.begin(), model.materials.end(),
                             [](const plasticity::Material& own) { return own.failure.has_value(); })) {}

  std::vector<Energy*> energies() override { return {&released_}; }
  void limit(const Body<dim>& body, StepLimit& limit) override;
  void carried(const Body<dim>& body) override;
  void renew(const Body<dim>& body) override;
  void begin_stress(const Body<dim>&, const DuePoints& due) override { sums_.assign(due.ranges.size(), 0.0); }
  void after_stress(const Body<dim>& body, const DuePoints& due, const LevelRange& range) override;
  void end_stress(const Body<dim>&, const DuePoints&) override {
    for (const double energy : sums_) released_.value += energy;
  }

private:
  bool failing_;
  std::vector<double> sums_; ///< [range] J/m
  Energy released_{"failure", EnergyKind::dissipated};
};

/// The largest eigenvalue of C of the whole deformation since the stress-free state.
template<int dim> double largest_square(const PointState<dim>& point, std::size_t p) {
  const auto& f = point.deformation;
  const auto& e = point.earlier_deformation;
  const double xx = f[0][p] * e[0][p] + f[1][p] * e[2][p], xy = f[0][p] * e[1][p] + f[1][p] * e[3][p],
               yx = f[2][p] * e[0][p] + f[3][p] * e[2][p], yy = f[2][p] * e[1][p] + f[3][p] * e[3][p];
  const double a = xx * xx + yx * yx, b = xy * xy + yy * yy, c = xx * xy + yx * yy;
  return 0.5 * (a + b) + std::hypot(0.5 * (a - b), c);
}

/// Per present volume. Stress that is linear in Green's strain stiffens with the stretch; stresses stiffen
/// what turns.
template<int dim> void Plies<dim>::limit(const Body<dim>& body, StepLimit&) {
  PointState<dim>& point = body.state.point;
  for (std::size_t p = 0; p < point.size(); ++p) {
    const plasticity::Material& material = body.material_of(p);
    if (!material.ply) continue;
    const bool green = material.ply->measure == plasticity::StrainMeasure::green;
    const double square = green ? largest_square(point, p) : 1.0;
    point.wave_modulus[p] = (square * square * material.wave_modulus(body.model.plane_stress) +
                             2.0 * point.equivalent_stress[p]) *
                            point.stress_free[p] / point.jacobian[p];
  }
}

/// Onsets of mixed matter are means over what has begun.
template<int dim> void Plies<dim>::carried(const Body<dim>& body) {
  if (!failing_) return;
  PointState<dim>& point = body.state.point;
  for (std::size_t mode = 0; mode < point.begun.size(); ++mode)
    for (std::size_t p = 0; p < point.size(); ++p) {
      double& begun = point.begun[mode][p];
      if (begun == 0.0) continue;
      point.onset_strain[mode][p] /= begun;
      point.onset_stress[mode][p] /= begun;
      begun = 1.0;
    }
}

/// Half of the width over which point p spreads openings along its fibres or across them, the larger of both,
/// m, in the stress-free state: the spacing in a square lattice. On a straight side of the body, where cells
/// are half as large, it is that of cracks that run into it.
double size_of_openings(const Body<2>& body, std::size_t p) {
  const auto& f = body.state.point.earlier_deformation;
  const Mat<2> F = (Mat<2>() << f[0][p], f[1][p], f[2][p], f[3][p]).finished(),
               back = F.inverse().transpose();
  const double angle = body.material_of(p).ply->angle;
  const Vec2 fibre(std::cos(angle), std::sin(angle)), across = left_normal(fibre);
  const auto width = [&](const Vec2& n) {
    return opening_width(body.operators(), body.reference, p, F * n, back * n);
  };
  return 0.5 * std::max(width(fibre), width(across));
}

template<int dim> void Plies<dim>::renew(const Body<dim>& body) {
  if (!failing_) return;
  PointState<dim>& point = body.state.point;
  if constexpr (dim == 2)
    for (std::size_t p = 0; p < point.size(); ++p) {
      const auto& law = body.material_of(p).failure;
      if (law) point.failure_length[p] = law->band * size_of_openings(body, p);
    }
}

/// What is left of the shear stiffness is left of the penalty of the edge defect too.
template<int dim>
void Plies<dim>::after_stress(const Body<dim>& body, const DuePoints& due, const LevelRange& range) {
  if (!failing_) return;
  const PointState<dim>& point = body.state.point;
  const Field& volume = body.operators().volume;
  double sum = 0.0;
  for (std::size_t p = range.begin; p < range.end; ++p) {
    const plasticity::Material& material = body.material_of(p);
    if (!material.failure) continue;
    sum += volume[p] * point.stress_free[p] * point.failure_release[p];
    if (!body.edge.record) continue;
    double damage[plasticity::ply_modes];
    for (std::size_t mode = 0; mode < plasticity::ply_modes; ++mode)
      damage[mode] = 1.0 - point.ply_left[mode][p];
    body.edge.record[EdgeRecord<dim>::size * p + EdgeRecord<dim>::modulus] = body.edge.modulus[p] =
        plasticity::shear_left(damage) * material.shear_modulus();
  }
  sums_[due.index(range)] = sum;
}

} // namespace

template<int dim> std::unique_ptr<Term<dim>> plies(const Model<dim>& model) {
  if (std::none_of(model.materials.begin(), model.materials.end(),
                   [](const plasticity::Material& own) { return own.ply.has_value(); }))
    return nullptr;
  return std::make_unique<Plies<dim>>(model);
}

template std::unique_ptr<Term<2>> plies(const Model<2>&);
template std::unique_ptr<Term<3>> plies(const Model<3>&);

} // namespace cnem
