#include "evaluate/shear_zone.hpp"

#include "evaluate/material_point.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cnem::evaluate {

namespace {

constexpr double rate_constant = 5.9; ///< C0, of Oxley's experiments
constexpr double degree = std::numbers::pi / 180.0;

/// The root of a function that rises from below 0 to above it.
template<class F> double root(const F& f, double low, double high, double at_low, double at_high) {
  std::uintmax_t most = 100;
  const auto [a, b] = boost::math::tools::toms748_solve(f, low, high, at_low, at_high,
                                                        boost::math::tools::eps_tolerance<double>(48), most);
  return 0.5 * (a + b);
}

class PlaneBalance {
public:
  PlaneBalance(const plasticity::Material& material, const ShearZoneCut& cut)
      : material_(material), cut_(cut), friction_(std::atan(cut.friction)) {}

  /// tan θ less what the shear plane can bear: 0 at the angle that is taken.
  double unbalance(double phi) {
    at_angle(phi);
    constexpr double step = 1e-4;
    const double low = zone_.strain * (1.0 - step), high = zone_.strain * (1.0 + step);
    const double hardening = (stress(high) - stress(low)) / (2.0 * step * zone_.flow_stress);
    return std::tan(phi + friction_ - cut_.rake) - 1.0 - 2.0 * (0.25 * std::numbers::pi - phi) +
           rate_constant * hardening;
  }

  ShearZone at_angle(double phi) {
    const double along = std::cos(cut_.rake) / std::cos(phi - cut_.rake); // Vs/V
    zone_.shear_angle = phi;
    zone_.strain = 0.5 * along / std::sin(phi) / std::numbers::sqrt3;
    zone_.rate = rate_constant * along * cut_.speed * std::sin(phi) / cut_.feed / std::numbers::sqrt3;
    heat(phi, along);
    const double k = zone_.flow_stress / std::numbers::sqrt3, theta = phi + friction_ - cut_.rake;
    const double force = k * cut_.feed / (std::sin(phi) * std::cos(theta));
    zone_.Fc = force * std::cos(friction_ - cut_.rake);
    zone_.Ft = force * std::sin(friction_ - cut_.rake);
    zone_.chip_thickness = cut_.feed * std::cos(phi - cut_.rake) / std::sin(phi);
    return zone_;
  }

private:
  double stress(double strain) const {
    return flow_stress_of(material_, strain, zone_.rate, zone_.temperature);
  }

  /// Temperature and flow stress in the plane, which depend on each other.
  void heat(double phi, double along) {
    zone_.temperature = cut_.temperature;
    zone_.flow_stress = stress(zone_.strain);
    if (!(material_.specific_heat > 0.0)) return;
    const double capacity = material_.density * material_.specific_heat;
    double into_workpiece = 0.0;
    if (material_.conductivity > 0.0) {
      const double peclet = capacity * cut_.speed * cut_.feed / material_.conductivity * std::tan(phi);
      const double lg = std::log10(peclet);
      into_workpiece = std::clamp(peclet <= 10.0 ? 0.5 - 0.35 * lg : 0.3 - 0.15 * lg, 0.0, 1.0);
    }
    const double per_stress = (1.0 - into_workpiece) * material_.taylor_quinney * along /
                              (std::numbers::sqrt3 * capacity * std::sin(phi));
    const auto excess = [&](double rise) {
      return rise - per_stress * flow_stress_of(material_, zone_.strain, zone_.rate, cut_.temperature + rise);
    };
    const double most = per_stress * zone_.flow_stress, at_most = excess(most);
    if (!(most > 0.0)) return;
    // A metal that does not soften becomes as warm as its cold flow stress makes it.
    zone_.temperature += at_most > 0.0 ? root(excess, 0.0, most, -most, at_most) : most;
    zone_.flow_stress = stress(zone_.strain);
  }

  const plasticity::Material& material_;
  ShearZoneCut cut_;
  double friction_; ///< rad
  ShearZone zone_;
};

} // namespace

std::optional<ShearZone> shear_zone(const plasticity::Material& material, const ShearZoneCut& cut) {
  if (!material.hardening) return std::nullopt;
  PlaneBalance zone(material, cut);
  const double low = degree, high = 89.0 * degree - std::max(0.0, std::atan(cut.friction) - cut.rake);
  if (!(high > low)) return std::nullopt;
  double from = low, at_from = zone.unbalance(low), to = high;
  const double at_high = zone.unbalance(high);
  // Metal that hardens strongly bears less than it has to at very small angles too, where its strain is that
  // of no chip: the larger of two roots is the chip's. Two that are nearer than a degree lie about an angle
  // of least unbalance.
  std::array<double, 3> angle{high, high, high}, value{at_high, at_high, at_high}; // the last ones, falling
  for (double phi = high - degree; at_from >= 0.0 && phi > low; phi -= degree) {
    angle = {angle[1], angle[2], phi};
    value = {value[1], value[2], zone.unbalance(phi)};
    from = phi, at_from = value[2], to = angle[1];
    if (at_from < 0.0 || !(value[1] <= value[0] && value[1] <= value[2])) continue;
    constexpr int bits = 20; // of the angle: the roots are found to their own precision
    const auto [least, at_least] = boost::math::tools::brent_find_minima(
        [&](double between) { return zone.unbalance(between); }, angle[2], angle[0], bits);
    if (at_least < 0.0) from = least, at_from = at_least, to = angle[0];
  }
  if (!(at_from < 0.0 && at_high > 0.0)) return std::nullopt;
  return zone.at_angle(
      root([&](double phi) { return zone.unbalance(phi); }, from, to, at_from, zone.unbalance(to)));
}

} // namespace cnem::evaluate
