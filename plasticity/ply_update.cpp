#include "plasticity/ply_update.hpp"

#include "plasticity/ply_return.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::plasticity {

namespace {

struct Matrix2 {
  double xx, xy, yx, yy;
  double determinant() const { return xx * yy - xy * yx; }
};
struct Symmetric2 {
  double xx, yy, xy;
};

Matrix2 operator*(const Matrix2& a, const Matrix2& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
          a.yx * b.xy + a.yy * b.yy};
}
Matrix2 transposed(const Matrix2& a) { return {a.xx, a.yx, a.xy, a.yy}; }
Matrix2 whole(const Symmetric2& a) { return {a.xx, a.xy, a.xy, a.yy}; }

/// Components along axes that are turned by an angle, from its cosine and sine.
Symmetric2 along(const Symmetric2& a, double c, double s) {
  return {c * c * a.xx + s * s * a.yy + 2.0 * c * s * a.xy, s * s * a.xx + c * c * a.yy - 2.0 * c * s * a.xy,
          c * s * (a.yy - a.xx) + (c * c - s * s) * a.xy};
}

/// The strain of a measure, and what turns the stress that is conjugate to it into S.
class Strain {
public:
  Strain(const Matrix2& F, StrainMeasure measure) : measure_(measure) {
    const Symmetric2 C{F.xx * F.xx + F.yx * F.yx, F.xy * F.xy + F.yy * F.yy, F.xx * F.xy + F.yx * F.yy};
    if (measure == StrainMeasure::green) {
      value_ = {0.5 * (C.xx - 1.0), 0.5 * (C.yy - 1.0), 0.5 * C.xy};
      return;
    }
    const double mean = 0.5 * (C.xx + C.yy), half = 0.5 * (C.xx - C.yy), radius = std::hypot(half, C.xy);
    const double angle = 0.5 * std::atan2(C.xy, half);
    c_ = std::cos(angle), s_ = std::sin(angle);
    // the smaller from the determinant, which has its digits
    const double det = F.determinant();
    large_ = mean + radius, small_ = det * det / large_;
    const double r = (large_ - small_) / (large_ + small_), r2 = r * r;
    const double series = 1.0 + r2 * (1.0 / 3.0 + r2 * (1.0 / 5.0 + r2 * (1.0 / 7.0 + r2 / 9.0)));
    if (r < 0.999)
      mixed_ = 2.0 / (large_ + small_) * (r < 1e-2 ? series : std::atanh(r) / r);
    else // of debris that has been sheared by 10⁸ r is 1
      mixed_ = std::log(large_ / small_) / (large_ - small_);
    value_ = along({0.5 * std::log(large_), 0.5 * std::log(small_), 0.0}, c_, -s_);
  }

  const Symmetric2& value() const { return value_; }

  /// S_ab = T_ab (ln μ_a − ln μ_b)/(μ_a − μ_b) in the axes of C, μ its eigenvalues (1/μ_a when equal).
  Symmetric2 second_piola(const Symmetric2& stress) const {
    if (measure_ == StrainMeasure::green) return stress;
    const Symmetric2 own = along(stress, c_, s_);
    return along({own.xx / large_, own.yy / small_, own.xy * mixed_}, c_, -s_);
  }

private:
  StrainMeasure measure_;
  Symmetric2 value_{};
  double c_ = 1.0, s_ = 0.0, large_ = 1.0, small_ = 1.0, mixed_ = 1.0;
};

/// Flow stress of a point at the mean rate of a step.
class PointFlow : public StepFlow {
public:
  PointFlow(const Hardening& law, const StressPoints<2>& points, std::ptrdiff_t p, double dt)
      : law_(law), strain_(points.plastic_strain[p]), temperature_(points.temperature[p]),
        factor_(points.strength[p]), by_dt_(1.0 / dt) {}

  double stress(double increment) const override {
    return factor_ * law_.flow_stress(strain_ + increment, increment * by_dt_, temperature_);
  }
  double slope(double increment) const override {
    const double strain = strain_ + increment, rate = increment * by_dt_;
    return factor_ * (law_.hardening_modulus(strain, rate, temperature_) +
                      by_dt_ * law_.rate_modulus(strain, rate, temperature_));
  }

private:
  const Hardening& law_;
  double strain_, temperature_, factor_, by_dt_;
};

class FixedFlow : public StepFlow {
public:
  explicit FixedFlow(double stress) : stress_(stress) {}
  double stress(double) const override { return stress_; }
  double slope(double) const override { return 0.0; }

private:
  double stress_;
};

/// A ply with everything that is the same at all of its points.
class PlyUpdate {
public:
  PlyUpdate(const Material& material, const StressPoints<2>& points, double dt)
      : ply_(*material.ply), points_(points), dt_(dt), elastic_(ply_constants(ply_, points.thickness)),
        intact_(elastic_.stiffness()), cosine_(std::cos(ply_.angle)), sine_(std::sin(ply_.angle)) {
    if (material.failure) form_.emplace(*material.failure, elastic_);
    if (material.hardening) return_.emplace(ply_, material.yield_coefficients(), points.thickness != nullptr);
    hardening_ = material.hardening ? &*material.hardening : nullptr;
    speed_ = std::sqrt(std::max(intact_.Q11, intact_.Q22) / material.density);
  }

  bool point(std::ptrdiff_t p) const {
    const auto tensor = [p](const double* const* field) {
      return Matrix2{field[0][p], field[1][p], field[2][p], field[3][p]};
    };
    const Matrix2 F = tensor(points_.deformation), earlier = tensor(points_.earlier_deformation),
                  total = F * earlier;
    const double before = earlier.determinant(), J = total.determinant();
    if (!(F.determinant() > 0.0 && before > 0.0 && J < 1e300)) return false;
    const Strain strain(total, ply_.measure);
    const Symmetric2 own = along(strain.value(), cosine_, sine_);
    const double e[3] = {own.xx, own.yy, 2.0 * own.xy};
    if (!(std::abs(e[0]) + std::abs(e[1]) + std::abs(e[2]) < 1e100)) return false;
    Nominal result;
    if (!(return_ ? flow(p, e, result) : bear(p, e, result))) return false;
    const auto& s = result.stress;
    const double zz = result.out;
    if (!(std::abs(s[0]) + std::abs(s[1]) + std::abs(s[2]) + std::abs(zz) < 1e300)) return false;
    const Symmetric2 S =
        strain.second_piola(along({s[0], s[1], s[2]}, cosine_, -sine_)); // in the axes of the model
    const Matrix2 first = total * whole(S), piola = first * transposed(earlier),
                  tau = first * transposed(total);
    const double by_volume = 1.0 / before;
    const double components[] = {piola.xx, piola.xy, piola.yx, piola.yy, zz};
    for (int k = 0; k < 5; ++k) points_.piola[k][p] = components[k] * by_volume;
    const double pressure = -(tau.xx + tau.yy + zz) / 3.0;
    points_.pressure[p] = pressure;
    if (!return_) {
      const double xx = tau.xx + pressure, yy = tau.yy + pressure, out = zz + pressure;
      points_.equivalent_stress[p] = std::sqrt(1.5 * (xx * xx + yy * yy + out * out + 2.0 * tau.xy * tau.xy));
    }
    points_.stored_energy[p] = result.energy;
    points_.stress_free[p] = by_volume;
    points_.ply.fibre_angle[p] =
        std::atan2(total.yx * cosine_ + total.yy * sine_, total.xx * cosine_ + total.xy * sine_);
    return true;
  }

  void draw_back(std::ptrdiff_t p, double factor) const {
    const auto& f = points_.earlier_deformation;
    const Strain strain({f[0][p], f[1][p], f[2][p], f[3][p]}, ply_.measure);
    const Symmetric2 own = along(strain.value(), cosine_, sine_);
    double plastic[3];
    for (int k = 0; k < 3; ++k) plastic[k] = points_.ply.flow[k][p];
    const FixedFlow flow_stress(factor * hardening_->flow_stress(points_.plastic_strain[p],
                                                                 points_.plastic_rate[p],
                                                                 points_.temperature[p]));
    const PlyReturn::Result now =
        (*return_)({own.xx, own.yy, 2.0 * own.xy}, plastic, &flow_stress, softening(p));
    for (int k = 0; k < 3; ++k) points_.ply.flow[k][p] += now.flow[k];
  }

private:
  /// ω of what stands closed: what has opened in flow has room to close in.
  double softening(std::ptrdiff_t p) const {
    constexpr double slack = 1e-9;
    const bool closed = points_.ply.flow[0][p] + points_.ply.flow[1][p] <= slack;
    return points_.softening && closed ? points_.softening[p] : 0.0;
  }

  struct Nominal {
    double stress[3], out, energy; ///< Pa, J/m³: σ11, σ22, σ12 and σ33
  };

  /// Elastic, but for what fails.
  bool bear(std::ptrdiff_t p, const double (&e)[3], Nominal& result) const {
    double damage[ply_modes] = {};
    if (form_) fail(p, e, damage);
    const PlyStress borne = damaged_stress(elastic_, e, damage);
    const auto& s = borne.stress;
    result = {
        {s[0], s[1], s[2]}, elastic_.out_of_plane[0] * s[0] + elastic_.out_of_plane[1] * s[1], borne.energy};
    points_.dissipation[p] = 0.0;
    return true;
  }

  /// Back to the yield surface; false, and nothing changes, where no way was found.
  bool flow(std::ptrdiff_t p, const double (&e)[3], Nominal& result) const {
    double before[3];
    for (int k = 0; k < 3; ++k) before[k] = points_.ply.flow[k][p];
    const PointFlow flow_stress(*hardening_, points_, p, dt_);
    const PlyReturn::Result now = (*return_)(e, before, dt_ > 0.0 ? &flow_stress : nullptr, softening(p));
    if (!now.found) return false;
    result = {{now.stress[0], now.stress[1], now.stress[2]}, now.out, now.energy};
    for (int k = 0; k < 3; ++k) points_.ply.flow[k][p] = before[k] + now.flow[k];
    // as work is measured, by the trapezoid
    const double work = 0.5 * (points_.equivalent_stress[p] + now.yield) * now.increment;
    points_.equivalent_stress[p] = now.yield;
    points_.plastic_strain[p] += now.increment;
    points_.plastic_work[p] += work;
    points_.dissipation[p] = work;
    if (dt_ > 0.0) points_.plastic_rate[p] = now.increment / dt_;
    return true;
  }

  /// Damage at the strain e, and what its growth lets go.
  void fail(std::ptrdiff_t p, const double (&e)[3], double (&damage)[ply_modes]) const {
    const PlyPoints& ply = points_.ply;
    double index[ply_modes], before[ply_modes], last[3];
    for (int mode = 0; mode < ply_modes; ++mode) before[mode] = damage[mode] = 1.0 - ply.left[mode][p];
    for (int k = 0; k < 3; ++k) last[k] = ply.strain[k][p];
    double stress[3];
    effective_stress(e, before, stress);
    indices(p, e, before, index);
    for (int mode = 0; mode < ply_modes; ++mode) {
      ply.index[mode][p] = index[mode];
      if (dt_ == 0.0) continue;
      double& begun = ply.begun[mode][p];
      if (begun == 0.0 && index[mode] >= 1.0) {
        const FailureForm::Opening onset = at_onset(p, mode, last, e, before);
        ply.onset_strain[mode][p] = ply.length[p] * onset.strain;
        ply.onset_stress[mode][p] = onset.stress;
        begun = 1.0;
      }
      if (begun == 0.0) continue;
      const double grown =
          form_->law().degradation == Degradation::sudden
              ? std::min(1.0 - (1.0 - before[mode]) * std::exp(-speed_ * dt_ / ply.length[p]),
                         Failure::broken)
              : spent(p, mode, ply.length[p] * form_->opening(mode, e, stress).strain);
      damage[mode] = std::max(grown, before[mode]);
      ply.left[mode][p] = 1.0 - damage[mode];
      ply.damage[mode][p] = std::min(damage[mode], Failure::broken);
    }
    double release = 0.0;
    const auto let_go = [&](const double(&at)[3]) {
      return damaged_stress(elastic_, at, before).energy - damaged_stress(elastic_, at, damage).energy;
    };
    if (dt_ != 0.0 && !std::equal(std::begin(damage), std::end(damage), std::begin(before)))
      release = 0.5 * (let_go(last) + let_go(e)); // as work is measured, by the trapezoid
    ply.release[p] = release;
    for (int k = 0; k < 3; ++k) ply.strain[k][p] = e[k];
  }

  /// d of an opening δ that has passed δ0: the stress falls linearly to none at δf = 2G/σ0, but for a
  /// hundredth of σ0, which keeps matter in its place.
  double spent(std::ptrdiff_t p, int mode, double delta) const {
    const double first = points_.ply.onset_strain[mode][p], stress = points_.ply.onset_stress[mode][p];
    if (!(delta > first)) return 0.0;
    const double last = 2.0 * form_->law().energy(mode) / stress;
    const double falling = last > first ? last * (delta - first) / (delta * (last - first)) : 1.0;
    return std::min(falling, 1.0 - (1.0 - Failure::broken) * first / delta);
  }

  /// Nominal stress over what is left of the members that bear it: Q ε until something fails. Later Q ε would
  /// have a matrix that opens break its fibres, by a contraction that it does not hand on any more.
  void effective_stress(const double (&e)[3], const double (&damage)[ply_modes], double (&stress)[3]) const {
    const PlyStress nominal = damaged_stress(elastic_, e, damage);
    stress[0] = nominal.stress[0] / nominal.left.fibre;
    stress[1] = nominal.stress[1] / nominal.left.matrix;
    stress[2] = nominal.stress[2] / nominal.left.shear;
  }

  /// Where matter is weaker of the stress over its strength.
  void indices(std::ptrdiff_t p, const double (&e)[3], const double (&damage)[ply_modes],
               double (&index)[ply_modes]) const {
    const double by = 1.0 / points_.strength[p];
    const double strain[3] = {by * e[0], by * e[1], by * e[2]};
    double stress[3];
    effective_stress(strain, damage, stress);
    form_->indices(strain, stress, index);
  }

  /// Where the index of a mode is 1 on the way from one strain to another.
  FailureForm::Opening at_onset(std::ptrdiff_t p, int mode, const double (&from)[3], const double (&to)[3],
                                const double (&damage)[ply_modes]) const {
    double low = 0.0, high = 1.0, strain[3], stress[3];
    const auto place = [&](double t) {
      for (int k = 0; k < 3; ++k) strain[k] = from[k] + t * (to[k] - from[k]);
    };
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (low + high);
      place(middle);
      double index[ply_modes];
      indices(p, strain, damage, index);
      (index[mode] >= 1.0 ? high : low) = middle;
    }
    place(high);
    effective_stress(strain, damage, stress);
    return form_->opening(mode, strain, stress);
  }

  const Orthotropic& ply_;
  const StressPoints<2>& points_;
  double dt_;
  PlyConstants elastic_;
  PlyStiffness intact_;
  double cosine_, sine_;
  std::optional<FailureForm> form_;
  std::optional<PlyReturn> return_; ///< of plies that flow
  const Hardening* hardening_ = nullptr;
  double speed_; ///< m/s, of the fastest waves
};

} // namespace

double shear_left(const double (&damage)[ply_modes]) {
  double left = 1.0;
  for (const double d : damage) left *= 1.0 - d;
  constexpr double least = 1e-6;
  return std::max(left, least);
}

PlyStress damaged_stress(const PlyConstants& elastic, const double (&strain)[3],
                         const double (&damage)[ply_modes]) {
  PlyShares left;
  left.shear = shear_left(damage);
  PlyStress best{};
  double least = infinite; // what a stress has of the wrong sign: rounding alone, where one is zero
  for (const int fibre : {fibre_tension, fibre_compression})
    for (const int matrix : {matrix_tension, matrix_compression}) {
      left.fibre = 1.0 - damage[fibre], left.matrix = 1.0 - damage[matrix];
      PlyStress now{.stress = {}, .energy = 0.0, .left = left};
      elastic.stiffness(left).stress(strain, now.stress);
      const double wrong = std::max({0.0, fibre == fibre_tension ? -now.stress[0] : now.stress[0],
                                     matrix == matrix_tension ? -now.stress[1] : now.stress[1]});
      if (wrong < least) least = wrong, best = now;
      if (least == 0.0) break;
    }
  for (int k = 0; k < 3; ++k) best.energy += 0.5 * best.stress[k] * strain[k];
  return best;
}

void draw_back(const Material& material, const StressPoints<2>& points, std::ptrdiff_t p, double factor) {
  PlyUpdate(material, points, 0.0).draw_back(p, factor);
}

std::ptrdiff_t update_plies(const Material& material, const StressPoints<2>& points, std::ptrdiff_t begin,
                            std::ptrdiff_t end, double dt) {
  const PlyUpdate update(material, points, dt);
  std::ptrdiff_t first_bad = -1;
  for (std::ptrdiff_t p = begin; p < end; ++p)
    if (!update.point(p) && first_bad < 0) first_bad = p;
  return first_bad;
}

} // namespace cnem::plasticity
