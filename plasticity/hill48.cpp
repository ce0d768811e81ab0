#include "plasticity/hill48.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>
#include <variant>

namespace cnem::plasticity {

bool HillCoefficients::convex() const {
  return G + H > 0.0 && F * G + G * H + H * F > 0.0 && L > 0.0 && M > 0.0 && N > 0.0;
}

HillCoefficients Hill48::coefficients() const {
  const double G = 1.0 / (1.0 + r0), H = r0 * G, F = H / r90;
  return {F, G, H, L, M, (F + G) * (r45 + 0.5)};
}

HillCoefficients HillRatios::coefficients() const {
  const auto by_square = [](double R) { return 1.0 / (R * R); };
  const double a = by_square(R11), b = by_square(R22), c = by_square(R33);
  return {0.5 * (b + c - a),    0.5 * (c + a - b),    0.5 * (a + b - c),
          1.5 * by_square(R23), 1.5 * by_square(R13), 1.5 * by_square(R12)};
}

HillCoefficients Anisotropy::coefficients() const {
  return std::visit([](const auto& law) { return law.coefficients(); }, static_cast<const variant&>(*this));
}

HillForm Anisotropy::form() const {
  return std::visit([](const auto& law) { return hill_form(law.coefficients(), law.rolling, law.normal); },
                    static_cast<const variant&>(*this));
}

Axis Anisotropy::normal() const {
  return std::visit([](const auto& law) { return law.normal; }, static_cast<const variant&>(*this));
}

HillForm hill_form(const HillCoefficients& c, Axis rolling, Axis normal) {
  const int along = static_cast<int>(rolling), across = static_cast<int>(normal);
  double opposite[3], shear[3]; // of the plane that an axis of the model is normal to
  for (const auto& [axis, difference, of_shear] :
       {std::tuple{along, c.F, c.L}, {3 - along - across, c.G, c.M}, {across, c.H, c.N}}) {
    opposite[axis] = difference;
    shear[axis] = of_shear;
  }

  // the quadratic form of the normal stresses on two directions that leave the mean alone
  const double first[] = {std::sqrt(0.5), -std::sqrt(0.5), 0.0};
  const double second[] = {std::sqrt(1.0 / 6.0), std::sqrt(1.0 / 6.0), -std::sqrt(2.0 / 3.0)};
  const auto product = [&](const double(&a)[3], const double(&b)[3]) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      sum += opposite[k] * (a[i] - a[j]) * (b[i] - b[j]);
    }
    return sum;
  };
  const double mean = 0.5 * (product(first, first) + product(second, second));
  const double half = 0.5 * (product(first, first) - product(second, second));
  const double mixed = product(first, second), radius = std::hypot(half, mixed);
  const double angle = 0.5 * std::atan2(mixed, half), c0 = std::cos(angle), s0 = std::sin(angle);

  HillForm form{};
  for (int k = 0; k < 3; ++k) {
    form.axis[0][k] = c0 * first[k] + s0 * second[k];
    form.axis[1][k] = c0 * second[k] - s0 * first[k];
  }
  const double values[] = {mean + radius, product(form.axis[1], form.axis[1]), shear[2], shear[0], shear[1]};
  std::copy(std::begin(values), std::end(values), form.value);
  return form;
}

double hill_stress(const HillForm& form, const double (&stress)[6]) {
  double sum = 0.0;
  for (int k = 0; k < 2; ++k) {
    double a = 0.0;
    for (int i = 0; i < 3; ++i) a += form.axis[k][i] * stress[i];
    sum += form.value[k] * a * a;
  }
  for (int k = 0; k < 3; ++k) sum += 2.0 * form.value[2 + k] * stress[3 + k] * stress[3 + k];
  return std::sqrt(sum);
}

double least_slope(const HillForm& form) {
  return *std::min_element(std::begin(form.value), std::end(form.value));
}

} // namespace cnem::plasticity
