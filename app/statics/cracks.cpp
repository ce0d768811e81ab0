#include "app/statics/cracks.hpp"

#include "app/statics/static_model.hpp"
#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>

namespace cnem::app {

namespace {

std::vector<fracture::CrackTip> tips_of(const input::Case& input, const Cloud<2>& cloud) {
  std::vector<fracture::CrackPath> paths;
  for (const input::Crack& crack : input.domain.cracks) paths.push_back({crack.name, crack.path, crack.tips});
  return fracture::find_tips(cloud, paths);
}

double enrichment_radius(const input::Case& input, const fracture::CrackTip& tip) {
  if (!input.fracture.enrichment || input.method.name != "cnem") return 0.0;
  const double room = 0.9 * std::min({tip.straight, tip.clearance});
  return std::min(
      room, input.fracture.enrichment_radius.value_or(std::max(0.3 * tip.half_length, 2.5 * tip.spacing)));
}

/// Doubted beyond it: spread of K, and spacing over length of a crack that is not enriched.
constexpr double tolerance = 0.01;

/// σ√(πR), σ² the mean of σ:σ over the points within R of the tip.
double load_scale(const fracture::CrackTip& tip, double radius, const fracture::ElasticField& field) {
  double area = 0.0, square = 0.0;
  for (std::size_t p = 0; p < field.position.size(); ++p) {
    if ((field.position[p] - tip.position).norm() > radius) continue;
    const auto s = [&](std::size_t k) { return field.stress[k][p]; };
    area += field.operators.volume[p];
    square += field.operators.volume[p] * (s(0) * s(0) + s(1) * s(1) + 2.0 * s(3) * s(3));
  }
  return area > 0.0 ? std::sqrt(square / area * std::numbers::pi * radius) : 0.0;
}

} // namespace

Cracks::Cracks(const input::Case& input, const Cloud<2>& cloud, const Approximation<2>& approximation)
    : tips(tips_of(input, cloud)) {
  for (const fracture::CrackTip& tip : tips) {
    enrichment_radius.push_back(app::enrichment_radius(input, tip));
    constexpr double fewest = 2.0; // spacings
    if (const double outer = rings(input.fracture, tip).back().outer; outer < fewest * tip.spacing)
      throw input.error(
          "fracture.integral.outer",
          fmt::format("found {:.3g} m, expected at least {:g} spacings of the cloud at tip '{}', "
                      "{:.3g} m: within fewer the stress is not known",
                      outer, fewest, tip.name, fewest * tip.spacing));
  }
  try {
    enriched =
        fracture::enrich(cloud, approximation, tips, enrichment_radius, input.method.options.functions);
  } catch (const GeometryError& error) { throw input.error("fracture.enrichment", error.what()); }
}

Fields<2> Cracks::load(const input::Case& input, const Problem<2>& model, const Fields<2>& position) {
  for (const auto& load : model.loads.facet_tractions(input.time.end, position))
    loads.push_back({load.facet.node, model.cloud.position[load.facet.node[0]],
                     model.cloud.position[load.facet.node[1]], load.traction});
  Vec2 body_force = Vec2::Zero();
  for (std::size_t k = 0; k < 2; ++k)
    if (const auto& acceleration = input.loads.body_force[k])
      body_force[static_cast<Eigen::Index>(k)] =
          model.materials.front().density * (*acceleration)(input.time.end);
  return fracture::forces_on_functions(enriched, tips, model.loads.force(), loads, body_force);
}

std::vector<fracture::Ring> rings(const input::Fracture& spec, const fracture::CrackTip& tip) {
  std::vector<fracture::Ring> list = fracture::default_rings(tip);
  if (spec.integral_outer || spec.integral_inner) {
    const double outer =
        spec.integral_outer.value_or(std::max(list.back().outer, 2.0 * spec.integral_inner.value_or(0.0)));
    const double inner = spec.integral_inner.value_or(0.5 * outer);
    const double share = inner / outer;
    for (fracture::Ring& ring : list) ring = {share * ring.outer, ring.outer};
    std::erase_if(list, [&](const fracture::Ring& ring) { return ring.outer >= outer; });
    list.push_back({inner, outer});
  }
  list.insert(list.begin(), {0.0, list.back().outer});
  return list;
}

std::vector<TipResult> evaluate_tips(const StaticModel<2>& model, const StaticSolution<2>& solution) {
  const auto& elastic = model.setup.problem.materials.front().elasticity;
  const fracture::PlaneElasticity plane =
      plane_stress(model.input) ? fracture::PlaneElasticity::plane_stress(elastic.young, elastic.poisson)
                                : fracture::PlaneElasticity::plane_strain(elastic.young, elastic.poisson);
  // K is that of the displacements beyond those of free expansion, which are linear in the place.
  const double free =
      (plane_stress(model.input) ? 1.0 : 1.0 + elastic.poisson) * model.problem().thermal_strain;
  Fields<5> gradient = solution.gradient;
  for (const std::size_t k : {0U, 3U})
    for (double& g : gradient[k]) g -= free;
  const fracture::ElasticField field{model.cracks.enriched.operators, model.setup.problem.cloud.position,
                                     model.cracks.enriched.position, gradient, solution.stress};
  std::vector<TipResult> results;
  for (std::size_t t = 0; t < model.cracks.tips.size(); ++t) {
    const fracture::CrackTip& tip = model.cracks.tips[t];
    TipResult result;
    result.name = tip.name;
    result.enriched = model.cracks.enrichment_radius[t] > 0.0;
    result.spacing_over_half_length = tip.spacing / tip.half_length;
    std::vector<fracture::StressIntensity> found;
    for (const fracture::Ring& ring : rings(model.input.fracture, tip)) {
      found.push_back(fracture::stress_intensity(tip, ring, plane, field, model.cracks.loads));
      result.ring = ring;
    }
    result.intensity = found.back();
    if (!std::isfinite(std::hypot(found.back().K_I, found.back().K_II)))
      throw DivergenceError(
          fmt::format("the stress intensity at tip '{}' is not a number, at ({:.6g}, {:.6g}) m", tip.name,
                      tip.position.x(), tip.position.y()),
          -1, "stress intensity");
    for (const auto& k : found)
      result.difference =
          std::max(result.difference, std::hypot(k.K_I - found.back().K_I, k.K_II - found.back().K_II));
    const double size = std::hypot(found.back().K_I, found.back().K_II);
    if (size > 0.0) result.spread = result.difference / size;
    result.scale = load_scale(tip, result.ring.outer, field);
    results.push_back(std::move(result));
  }
  return results;
}

std::string doubt(const TipResult& tip) {
  const bool spreads = tip.spread > tolerance && tip.difference > tolerance * tip.scale;
  if (!tip.enriched && (spreads || tip.spacing_over_half_length > tolerance))
    return fmt::format(
        "the stress intensity at tip '{}' may be off by several per cent: it is not enriched, its "
        "spacing is {:.2g}% of the crack's half-length, and K changes by {:.2g}% from domain to "
        "domain; enrich it (method.name = \"cnem\", fracture.enrichment) or refine the cloud there",
        tip.name, 100.0 * tip.spacing_over_half_length, 100.0 * tip.spread);
  if (spreads)
    return fmt::format(
        "the stress intensity at tip '{}' changes by {:.2g}% from domain to domain: refine the "
        "cloud at the tip, or set fracture.integral",
        tip.name, 100.0 * tip.spread);
  return {};
}

std::vector<std::string> closed_cracks(const StaticModel<2>& model, const StaticSolution<2>& solution) {
  const Cloud<2>& cloud = model.setup.problem.cloud;
  std::vector<std::string> warnings;
  for (const input::Crack& crack : model.input.domain.cracks) {
    std::map<NodeIndex, Vec2> normal; // of nodes on the left face, out of the right one
    for (const Facet<2>& facet : cloud.facets)
      if (cloud.piece_names[facet.piece] == crack.name + "+")
        for (const NodeIndex i : facet.node)
          normal.try_emplace(i, Vec2::Zero()).first->second +=
              left_normal(cloud.position[facet.node[1]] - cloud.position[facet.node[0]]).normalized();
    double largest = 0.0, overlap = 0.0;
    int pairs = 0, closed = 0;
    std::vector<std::pair<double, Vec2>> openings;
    for (const auto& twin : cloud.twins)
      for (const bool swap : {false, true}) {
        const NodeIndex left = twin[swap ? 1 : 0], right = twin[swap ? 0 : 1];
        const auto found = normal.find(left);
        if (found == normal.end()) continue;
        const Vec2 jump(solution.displacement[0][index_of(left)] - solution.displacement[0][index_of(right)],
                        solution.displacement[1][index_of(left)] - solution.displacement[1][index_of(right)]);
        largest = std::max(largest, jump.norm());
        openings.emplace_back(jump.dot(found->second.normalized()), cloud.position[left]);
        break;
      }
    Vec2 where = Vec2::Zero();
    for (const auto& [opening, x] : openings) {
      ++pairs;
      if (opening >= -1e-3 * largest) continue;
      ++closed;
      if (-opening > overlap) {
        overlap = -opening;
        where = x;
      }
    }
    if (closed > 0)
      warnings.push_back(
          fmt::format("crack '{}' closes: its faces overlap at {} of {} places, most by {:.3g} m at "
                      "({:.4g}, {:.4g}) m; a static analysis does not hold them apart",
                      crack.name, closed, pairs, overlap, where.x(), where.y()));
  }
  return warnings;
}

} // namespace cnem::app
