#include "plasticity/failure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cnem::plasticity {

namespace {

constexpr double square(double x) { return x * x; }
constexpr double positive_part(double x) { return std::max(x, 0.0); }

} // namespace

double Failure::longest_length(const PlyConstants& elastic, int mode) const {
  if (degradation == Degradation::sudden || (mode == ply_shear && criterion != FailureCriterion::max_stress))
    return infinite;
  const double along = criterion == FailureCriterion::larc02 ? elastic.E1 * eps1t : Xt;
  const double strength[] = {along, Xc, Yt, Yc, S};
  const double modulus[] = {elastic.E1, elastic.E1, elastic.E2, elastic.E2, elastic.G12};
  return 2.0 * energy(mode) * modulus[mode] / square(strength[mode]);
}

FailureForm::FailureForm(const Failure& law, const PlyConstants& elastic)
    : law_(law), shear_modulus_(elastic.G12) {
  const double a = law.alpha0, c = std::cos(a), tangent = std::tan(2.0 * a);
  transverse_shear_ = law.Yc * c * (std::sin(a) + c / tangent);
  eta_along_ = -law.S * std::cos(2.0 * a) / (law.Yc * c * c);
  const double ratio = law.S / law.Xc, k = ratio + eta_along_;
  kink_ = std::atan((1.0 - std::sqrt(std::max(0.0, 1.0 - 4.0 * k * ratio))) / (2.0 * k));
  if (law.criterion != FailureCriterion::larc02) return;
  for (std::size_t n = 0; n < planes; ++n) {
    const Plane own = plane(static_cast<double>(n) * std::numbers::pi / 180.0);
    across_[n] = own.across, along_[n] = own.along, held_[n] = own.held;
  }
}

FailureForm::Plane FailureForm::plane(double angle) const {
  const double s = std::sin(angle), c = std::cos(angle), eta_transverse = -1.0 / std::tan(2.0 * law_.alpha0);
  return {std::max(0.0, c * (s - eta_transverse * c)) / transverse_shear_, c / law_.S,
          eta_along_ * c * c / law_.S};
}

void FailureForm::indices(const double (&strain)[3], const double (&stress)[3],
                          double (&index)[ply_modes]) const {
  std::fill(std::begin(index), std::end(index), 0.0);
  constexpr double rounding = 1e-9; // of a strength: what is smaller has no sign
  const double s1 = std::abs(stress[0]) > rounding * law_.Xc ? stress[0] : 0.0,
               s2 = std::abs(stress[1]) > rounding * law_.Yc ? stress[1] : 0.0, shear = std::abs(stress[2]);
  if (law_.criterion == FailureCriterion::larc02) return larc(strain, s1, s2, shear, index);
  const double sheared = square(shear / law_.S);
  const bool alone = law_.criterion == FailureCriterion::max_stress;
  if (s1 >= 0.0)
    index[fibre_tension] = square(s1 / law_.Xt) + (alone ? 0.0 : sheared);
  else
    index[fibre_compression] = square(s1 / law_.Xc);
  if (s2 >= 0.0)
    index[matrix_tension] = square(s2 / law_.Yt) + (alone ? 0.0 : sheared);
  else if (alone)
    index[matrix_compression] = square(s2 / law_.Yc);
  else
    index[matrix_compression] =
        positive_part(square(s2 / (2.0 * transverse_shear_)) +
                      (square(law_.Yc / (2.0 * transverse_shear_)) - 1.0) * s2 / law_.Yc + sheared);
  if (alone) index[ply_shear] = sheared;
}

/// The largest over the planes of fracture; between planes of whole degrees where a parabola has its vertex.
double FailureForm::matrix_crushing(double s2, double shear) const {
  const auto on = [&](double across, double along, double held) {
    return square(-s2 * across) + square(positive_part(shear * along + s2 * held));
  };
  std::array<double, planes> value;
  for (std::size_t n = 0; n < planes; ++n) value[n] = on(across_[n], along_[n], held_[n]);
  const auto best = static_cast<std::size_t>(std::max_element(value.begin(), value.end()) - value.begin());
  if (best == 0 || best + 1 == value.size()) return value[best];
  const double before = value[best - 1], after = value[best + 1];
  const double curvature = before - 2.0 * value[best] + after;
  if (!(curvature < 0.0)) return value[best];
  const double vertex = static_cast<double>(best) + 0.5 * (before - after) / curvature;
  const Plane at = plane(vertex * std::numbers::pi / 180.0);
  return std::max(value[best], on(at.across, at.along, at.held));
}

void FailureForm::larc(const double (&strain)[3], double s1, double s2, double shear,
                       double (&index)[ply_modes]) const {
  // in the frame of fibres that are misaligned in a kink
  const double psi = (shear + (shear_modulus_ - law_.Xc) * kink_) / (shear_modulus_ + s1 - s2);
  const double s = std::sin(psi), c = std::cos(psi);
  const double turned2 = s * s * s1 + c * c * s2 - 2.0 * s * c * shear,
               turned_shear = s * c * (s2 - s1) + (c * c - s * s) * shear;
  const auto pulled = [&](double across, double along) {
    return square(across / law_.Yt) + square(along / law_.S);
  };
  if (s1 < 0.0)
    index[fibre_compression] = turned2 < 0.0
                                   ? positive_part(std::abs(turned_shear) + eta_along_ * turned2) / law_.S
                                   : pulled(turned2, turned_shear);
  index[fibre_tension] = s1 < 0.0 ? 0.0 : positive_part(strain[0]) / law_.eps1t;
  if (s2 >= 0.0)
    index[matrix_tension] = pulled(s2, shear);
  else if (s1 >= -law_.Yc)
    index[matrix_compression] = matrix_crushing(s2, shear);
  else
    index[matrix_compression] =
        turned2 >= 0.0 ? pulled(turned2, turned_shear) : matrix_crushing(turned2, std::abs(turned_shear));
}

FailureForm::Opening FailureForm::opening(int mode, const double (&strain)[3],
                                          const double (&stress)[3]) const {
  const bool larc02 = law_.criterion == FailureCriterion::larc02,
             hashin = law_.criterion == FailureCriterion::hashin;
  double square_of_strain = 0.0, work = 0.0;
  const auto add = [&](double e, double s) {
    square_of_strain += e * e;
    work += e * s;
  };
  const auto pull = [&](int k) { add(positive_part(strain[k]), positive_part(stress[k])); };
  const auto push = [&](int k) { add(positive_part(-strain[k]), positive_part(-stress[k])); };
  bool sheared = larc02 || hashin;
  switch (mode) {
  case fibre_tension:
    pull(0), sheared = hashin;
    break;
  case fibre_compression:
    push(0), sheared = larc02;
    break;
  case matrix_tension:
    pull(1);
    break;
  case matrix_compression:
    push(1);
    break;
  default:
    sheared = true;
  }
  if (sheared) add(strain[2], stress[2]);
  const double norm = std::sqrt(square_of_strain);
  return {norm, norm > 0.0 ? work / norm : 0.0};
}

} // namespace cnem::plasticity
