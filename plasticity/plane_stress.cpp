#include "plasticity/plane_stress.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::plasticity {

namespace {

constexpr std::ptrdiff_t width = 32; // points whose state is held at a time
constexpr int most_iterations = 60;
constexpr double tolerance = 1e-13; ///< of λ + 2μ

/// What a return map changes of some points, to begin from it again.
class Held {
public:
  Held(const StressPoints<2>& points, std::ptrdiff_t begin, std::ptrdiff_t count)
      : fields_{points.inverse_plastic_cauchy_green[0],
                points.inverse_plastic_cauchy_green[1],
                points.inverse_plastic_cauchy_green[2],
                points.inverse_plastic_cauchy_green[3],
                points.plastic_strain,
                points.plastic_rate,
                points.equivalent_stress,
                points.plastic_work},
        begin_(begin), count_(count) {
    for (int k = 0; k < number; ++k) std::copy_n(fields_[k] + begin, count, value_[k]);
    std::copy_n(points.thickness + begin, count, thickness_);
  }
  void restore() const {
    for (int k = 0; k < number; ++k) std::copy_n(value_[k], count_, fields_[k] + begin_);
  }

  double thickness(std::ptrdiff_t p) const { return thickness_[p - begin_]; }

private:
  static constexpr int number = 8;
  double* fields_[number];
  double value_[number][width], thickness_[width];
  std::ptrdiff_t begin_, count_;
};

} // namespace

std::ptrdiff_t update_plane_stress(PlaneReturn given, const Material& material, const StressPoints<2>& points,
                                   std::ptrdiff_t begin, std::ptrdiff_t end, double dt) {
  StressPoints<2> with = points;
  with.deformation[4] = points.thickness;
  const double modulus = material.wave_modulus();
  for (std::ptrdiff_t first = begin; first < end; first += width) {
    const std::ptrdiff_t stop = std::min(first + width, end), count = stop - first;
    const Held start(points, first, count);
    double last_strain[width], last_stress[width]; // of the iteration before
    const auto thickest = [&](std::ptrdiff_t p) {
      const bool broken = points.softening && points.softening[p] == 1.0;
      return broken ? std::max(start.thickness(p), 1.0) : infinite;
    };
    for (int iteration = 0;; ++iteration) {
      const std::ptrdiff_t bad = given(material, with, first, stop, dt);
      if (bad >= 0) return bad;
      bool all = true;
      for (std::ptrdiff_t k = 0; k < count; ++k) {
        const std::ptrdiff_t p = first + k;
        double& thickness = points.thickness[p];
        const double stress = points.piola[4][p] * thickness / points.stress_free[p]; // τ_zz
        if (std::abs(stress) <= tolerance * modulus || (stress < 0.0 && thickness >= thickest(p))) continue;
        if (!(iteration < most_iterations)) return p;
        all = false;
        // it grows with ln F_zz by λ + 2μ at most, in flow by no less than its volumetric part
        double slope = modulus;
        const double strain = std::log(thickness);
        if (iteration > 0 && strain != last_strain[k])
          slope = std::clamp((stress - last_stress[k]) / (strain - last_strain[k]), 0.05 * modulus, modulus);
        last_strain[k] = strain, last_stress[k] = stress;
        thickness = std::min(thickness * std::exp(-stress / slope), thickest(p));
      }
      if (all) break;
      start.restore();
    }
  }
  return -1;
}

} // namespace cnem::plasticity
