// Nanoseconds per stress point of the return map: 304L (paper 004) flowing plastically in every point, plane
// strain and space, for every instruction set of this machine, and other hardening laws and sheet in plane
// strain. The number of points is that of a small run (fits L2 and L3 caches).
#include "plasticity/return_map.hpp"
#include "core/machine/isa.hpp"
#include "plasticity/hardening_laws.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace cnem;
using namespace cnem::plasticity;

Material steel(const Hardening& hardening) {
  Material m;
  m.name = "304L";
  m.density = 7850.0;
  m.elasticity = {210e9, 0.33};
  m.hardening = hardening;
  return m;
}

const Hill48 sheet{.r0 = 1.9, .r45 = 0.7, .r90 = 2.4};
const JohnsonCook paper{253e6, 685e6, 0.312, 0.0973, 1.0, 2.044, 296.0, 1698.0};

std::vector<std::pair<std::string, Hardening>> other_laws() {
  const NumberList strain{{0.0, 0.01, 0.05, 0.2, 0.7, 1.6}, 6};
  const NumberList stress{{310e6, 402e6, 480e6, 566e6, 671e6, 702e6}, 6};
  return {{"linear", Linear{400e6, 100e6}},
          {"voce", Voce{450e6, 129e6, 715e6, 16.93}},
          {"swift", Swift{950e6, 0.012, 0.21}},
          {"hockett-sherby", HockettSherby{130e6, 320e6, 4.7, 0.81}},
          {"goijaerts", Goijaerts{420e6, 133e6, 0.0567, 406e6, 70.7e6}},
          {"zerilli-armstrong-bcc", ZerilliArmstrongBcc{65e6, 1033e6, 0.00698, 0.000415, 266e6, 0.289}},
          {"zerilli-armstrong-fcc", ZerilliArmstrongFcc{65e6, 890e6, 0.0028, 0.000115}},
          {"calamaz", Calamaz{253e6, 685e6, 0.312, 1.6, 0.4, 6.0, 1.0, 0.0973, 1.0, 2.044, 296.0, 1698.0}},
          {"table", Tabulated{.strain = strain, .stress = stress, .C = 0.02, .Tmelt = 1750.0}}};
}

template<int dim> PointState<dim> points(std::size_t n) {
  PointState<dim> s;
  resize_all(s.deformation, n);
  resize_all(s.inverse_plastic_cauchy_green, n);
  resize_all(s.piola, n);
  for (Field* f : {&s.plastic_strain, &s.plastic_rate, &s.equivalent_stress, &s.pressure, &s.stored_energy,
                   &s.plastic_work, &s.dissipation, &s.stress_free})
    f->assign(n, 0.0);
  s.temperature.assign(n, 350.0);
  s.strength.assign(n, 1.0);
  s.oriented.switch_on(true);
  s.oriented.rest(n);
  for (std::size_t c : {0, 1, 2}) s.inverse_plastic_cauchy_green[c].assign(n, 1.0);
  return s;
}

/// Simple shear at 5·10⁴ /s, ±`jitter` from point to point and step to step.
template<int dim> void shear(PointState<dim>& s, double gamma, double jitter, std::size_t step) {
  constexpr std::size_t last = dim == 2 ? 4 : 8, yy = dim == 2 ? 3 : 4;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double noise = std::sin(static_cast<double>(i * 7919 + step * 104729));
    s.deformation[0][i] = s.deformation[yy][i] = s.deformation[last][i] = 1.0;
    s.deformation[1][i] =
        gamma * (0.8 + 0.4 * static_cast<double>(i) / static_cast<double>(s.size())) + jitter * noise;
  }
}

template<int dim>
void return_map(benchmark::State& state, Isa isa, double jitter, const Hardening& hardening,
                const std::optional<Hill48>& anisotropy) {
  set_isa(isa);
  const std::size_t n = 20000;
  Material material = steel(hardening);
  material.anisotropy = anisotropy;
  PointState<dim> s = points<dim>(n);
  const StressPoints<dim> p = stress_points(s);
  const double dt = 1e-8, increment = 5e-4;
  double gamma = 0.0;
  std::size_t step = 0;
  const auto advance = [&] {
    gamma += increment;
    shear(s, gamma, jitter * increment, ++step);
  };
  const auto update = [&] { update_stress(material, p, 0, static_cast<std::ptrdiff_t>(n), dt); };
  for (int k = 0; k < 400; ++k) {
    advance();
    update();
  }
  double seconds = 0.0;
  for (auto _ : state) {
    advance();
    const auto start = std::chrono::steady_clock::now();
    update();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    state.SetIterationTime(taken.count());
    seconds += taken.count();
  }
  state.counters["ns_per_point"] =
      1e9 * seconds / static_cast<double>(state.iterations()) / static_cast<double>(n);
}

} // namespace

int main(int argc, char** argv) {
  for (Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (!isa_supported(isa)) continue;
    const std::string name(isa_name(isa));
    const std::optional<Hill48> isotropic;
    benchmark::RegisterBenchmark(("plane/steady/" + name).c_str(), return_map<2>, isa, 0.0, paper, isotropic)
        ->UseManualTime();
    benchmark::RegisterBenchmark(("plane/noisy_rate/" + name).c_str(), return_map<2>, isa, 0.3, paper,
                                 isotropic)
        ->UseManualTime();
    benchmark::RegisterBenchmark(("space/steady/" + name).c_str(), return_map<3>, isa, 0.0, paper, isotropic)
        ->UseManualTime();
    benchmark::RegisterBenchmark(("plane/sheet/" + name).c_str(), return_map<2>, isa, 0.0, paper, sheet)
        ->UseManualTime();
    benchmark::RegisterBenchmark(("space/sheet/" + name).c_str(), return_map<3>, isa, 0.0, paper, sheet)
        ->UseManualTime();
    for (const auto& [law, hardening] : other_laws())
      benchmark::RegisterBenchmark(("plane/" + law + "/" + name).c_str(), return_map<2>, isa, 0.0, hardening,
                                   isotropic)
          ->UseManualTime();
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
