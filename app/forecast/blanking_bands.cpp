#include "app/forecast/blanking_bands.hpp"

#include "adapt/indicated_fields.hpp"
#include "app/plausibility/list.hpp"
#include "app/plausibility/tool_gap.hpp"
#include "core/geometry/revolution.hpp"
#include "input/usual_tools.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cnem::app {

namespace {

std::optional<input::BlankingReport> cut_of(const input::Case& input) {
  return input.report.blanking ? input.report.blanking : input::usual_blanking(input);
}

/// The material of the workpiece that is cut.
const plasticity::Material& metal(const input::Case& input) { return *materials_in_use(input).front(); }

bool of_temperature(const input::Case& input) {
  return input.adapt.indicator == adapt::indicated_field("temperature");
}

/// ‖f‖/f₀ of the field of the indicator over the workpiece: f₀ is what a band adds in its middle, `flowing`
/// (m²) the area of all bands on which f² is that large in the mean. Temperatures count from 0 K.
double norm_of_field(const input::Case& input, double area, double flowing) {
  if (!of_temperature(input)) return std::sqrt(flowing);
  const plasticity::Material& material = metal(input);
  const double start = input.initial.temperature;
  constexpr double strain = 1.0, rate = 1e4; // of a band when it breaks
  const double heated = material.hardening
                            ? material.taylor_quinney * material.hardening->flow_stress(strain, rate, start) *
                                  strain / (material.density * material.specific_heat)
                            : 1.0;
  return std::sqrt(flowing + std::pow(start / heated, 2) * area);
}

std::vector<Band> blanking_bands(const input::Case& input, const std::vector<evaluate::Clearance>& cuts,
                                 const WantedNodes& wanted, double area, double nodes) {
  const input::Adaptation& rules = input.adapt;
  std::vector<Band> bands;
  constexpr double decay = 0.1;      // of the thickness, over which the field falls by e
  constexpr double constant = 0.245; // of a hexagonal cell: its share of ∫|f − f_h|² is (0.245 h² |∇f|)²
  constexpr double within = 1.5,
                   kept = 1.05; // of the finest spacing: one more mark makes it; as clouds keep it
  for (const evaluate::Clearance& cut : cuts) {
    const double w = decay * cut.thickness;
    const double flowing = w * cut.thickness * static_cast<double>(cuts.size());
    const double limit = rules.tolerance * norm_of_field(input, area, flowing) / std::sqrt(nodes);
    const auto error = [&](double spacing) { return constant * spacing * spacing / w; };
    const double coarse = wanted.spacing_at(cut.at);
    const auto rung = [&](double steeper) { // where the gradient is so many times f₀/w
      double spacing = coarse;
      while (spacing > rules.h_min && steeper * error(spacing) > limit)
        spacing = std::max(0.5 * spacing, rules.h_min);
      return spacing;
    };
    const double finest = rung(1.0), half_gap = std::max(0.5 * cut.gap, 1e-3 * w);
    const double at_edges = of_temperature(input) ? finest : rung(std::max(1.0, w / half_gap));
    if (at_edges >= coarse) continue;
    double before = coarse; // the rung that is refined to the finest
    while (0.5 * before > within * finest) before *= 0.5;
    const double far = w * std::max(0.0, std::log(error(before) / limit));
    bands.push_back({.at = cut.at,
                     .across = cut.across,
                     .width = std::max(0.0, cut.gap) + 2.0 * far,
                     .spacing = kept * finest,
                     .least = at_edges});
  }
  return bands;
}

} // namespace

std::vector<evaluate::Clearance> foretold_cuts(const input::Case& input, const ExplicitSolver<2>& solver) {
  const auto asked = cut_of(input);
  if (!asked) return {};
  return clearances(input, solver, *asked);
}

RefinedBands refined_bands(const input::Case& input, const std::vector<evaluate::Clearance>& cuts,
                           const WantedNodes& wanted, const adapt::Structure& structure, double first,
                           double count) {
  const double area = std::accumulate(structure.cells.volume.begin(), structure.cells.volume.end(), 0.0);
  const double most = std::max(static_cast<double>(input.adapt.max_nodes), first);
  RefinedBands refined{.nodes = first};
  constexpr int rounds = 40;
  for (int k = 0; k < rounds; ++k) { // the more nodes, the less each may err
    const std::vector<Band> bands = blanking_bands(input, cuts, wanted, area, refined.nodes);
    refined.finest = wanted.spacing_at(cuts.front().at);
    for (const Band& one : bands) refined.finest = std::min(refined.finest, one.least);
    const double next = std::min(most, count + wanted.added(bands));
    if (std::abs(next - refined.nodes) < 1.0) break;
    refined.nodes = 0.5 * (refined.nodes + next);
  }
  return refined;
}

double flow_begins(const input::Case& input, const ExplicitSolver<2>& solver,
                   const evaluate::Clearance& cut) {
  const auto asked = cut_of(input);
  const plasticity::Material& material = metal(input);
  const contact::Tool<2>& punch = solver.conditions().contact.tools()[as<ToolIndex>(asked->punch)];
  if (!material.hardening || material.ply || (punch.drive && !punch.drive->spring)) return 0.0;
  const double flow = starting_flow_stress(input, material, 0.0);
  const double stroke = std::max(0.0, StartingSurface<2>(solver).gap(*punch.shape, Vec2::Zero()).distance) +
                        cut.thickness * flow / (std::sqrt(3.0) * material.elasticity.mu());
  constexpr int samples = 1000;
  for (int k = 1; k <= samples; ++k)
    if (const double t = k * input.time.end / samples; led_stroke(solver, *asked, t).norm() >= stroke)
      return t;
  return input.time.end;
}

} // namespace cnem::app
