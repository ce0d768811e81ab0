#include "core/heat_curves.hpp"

#include "core/error.hpp"
#include "core/piecewise_linear.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {

namespace {

/// ∫ factor dT at each point, equal to the temperature at the first one.
NumberList integrals(const NumberList& at, const NumberList& factor) {
  NumberList sums;
  sums.size = at.size;
  for (int i = 0; i < at.size; ++i)
    sums.value[i] = i == 0 ? at.value[0]
                           : sums.value[i - 1] + 0.5 * (factor.value[i - 1] + factor.value[i]) *
                                                     (at.value[i] - at.value[i - 1]);
  return sums;
}

/// The piece that x is in: −1 before the first point, size − 1 beyond the last.
int piece_of(const NumberList& at, double x) {
  return static_cast<int>(std::upper_bound(at.value, at.value + at.size, x) - at.value) - 1;
}

double integral(const NumberList& at, const NumberList& factor, const NumberList& sums, double x) {
  const int i = piece_of(at, x), last = at.size - 1;
  if (i < 0) return sums.value[0] + factor.value[0] * (x - at.value[0]);
  const double s = x - at.value[i];
  if (i == last) return sums.value[last] + factor.value[last] * s;
  const double slope = (factor.value[i + 1] - factor.value[i]) / (at.value[i + 1] - at.value[i]);
  return sums.value[i] + s * (factor.value[i] + 0.5 * slope * s);
}

} // namespace

void HeatCurves::complete() {
  if (at.size == 0 && specific_heat.size == 0 && conductivity.size == 0) return;
  if (at.size == 0) throw InputError("found factors without temperatures, expected factors_at beside them");
  if (specific_heat.size == 0 && conductivity.size == 0)
    throw InputError("found temperatures without factors, expected specific_heat_factors or "
                     "conductivity_factors beside them");
  for (NumberList* factor : {&specific_heat, &conductivity})
    if (factor->size == 0) {
      factor->size = at.size;
      std::fill_n(factor->value, at.size, 1.0);
    }
  check_points("factors_at", at, "specific_heat_factors", specific_heat);
  check_points("factors_at", at, "conductivity_factors", conductivity);
  enthalpy_ = integrals(at, specific_heat);
  potential_ = integrals(at, conductivity);
  // both ratios of straight lines are monotone between points
  quickest = infinite;
  for (int i = 0; i < at.size; ++i)
    quickest = std::min({quickest, specific_heat.value[i], specific_heat.value[i] / conductivity.value[i]});
}

double HeatCurves::enthalpy(double temperature) const {
  return given() ? integral(at, specific_heat, enthalpy_, temperature) : temperature;
}

double HeatCurves::specific_heat_factor(double temperature) const {
  return piecewise_linear(at, specific_heat, temperature);
}

double HeatCurves::potential(double temperature) const {
  return given() ? integral(at, conductivity, potential_, temperature) : temperature;
}

double HeatCurves::temperature_of(double enthalpy) const {
  if (!given()) return enthalpy;
  const int i = piece_of(enthalpy_, enthalpy), last = at.size - 1;
  if (i < 0) return at.value[0] + (enthalpy - enthalpy_.value[0]) / specific_heat.value[0];
  const double rise = enthalpy - enthalpy_.value[i], c = specific_heat.value[i];
  if (i == last) return at.value[last] + rise / c;
  // the root of c s + ½ slope s² = rise that stays where the slope is 0
  const double slope = (specific_heat.value[i + 1] - c) / (at.value[i + 1] - at.value[i]);
  return at.value[i] + 2.0 * rise / (c + std::sqrt(c * c + 2.0 * slope * rise));
}

} // namespace cnem
