#include "app/statics/static_model.hpp"

#include "app/plausibility/plausibility.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "mechanics/kinematics.hpp"

#include <Eigen/LU>
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

bool plane_stress(const input::Case& input) {
  return input.analysis.kinematics == input::Analysis::Kinematics::plane_stress;
}

} // namespace

StaticModel::StaticModel(const input::Case& in) : input(in), setup(build<2>(in)) {
  for (std::string& doubt : doubts(in)) setup.warnings.push_back(std::move(doubt));
  if (const plasticity::Material& metal = setup.problem.materials.front();
      metal.expansion != 0.0 && metal.thermal_strain(in.initial.temperature) == 0.0)
    setup.warnings.push_back(fmt::format(
        "material '{}' has a heat.expansion and does not expand: initial.temperature is that at which it has "
        "no thermal strain, {:g} K; say from which it comes with heat.reference_temperature",
        metal.name, metal.expansion_reference));
  Problem<2>& model = setup.problem;
  const Cloud<2>& cloud = model.cloud;
  try {
    approximation = model.method->rebuild(cloud);
  } catch (const GeometryError& error) { throw input.error("domain", error.what()); }
  tips = tips_of(input, cloud);
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
  resize_all(position, index_of(cloud.nodes()));
  Field mass = approximation.mechanics.node_volume();
  for (double& m : mass) m *= model.materials.front().density;
  for (std::size_t i = 0; i < index_of(cloud.nodes()); ++i)
    for (std::size_t k = 0; k < 2; ++k) position[k][i] = cloud.position[i][static_cast<Eigen::Index>(k)];
  model.loads.evaluate(input.time.end, position, mass);
  for (const auto& load : model.loads.facet_tractions(input.time.end, position))
    loads.push_back({load.facet.node, cloud.position[load.facet.node[0]], cloud.position[load.facet.node[1]],
                     load.traction});
  Vec2 body_force = Vec2::Zero();
  for (std::size_t k = 0; k < 2; ++k)
    if (const auto& acceleration = input.loads.body_force[k])
      body_force[static_cast<Eigen::Index>(k)] =
          model.materials.front().density * (*acceleration)(input.time.end);
  force = fracture::forces_on_functions(enriched, tips, model.loads.force(), loads, body_force);
}

StaticProblem<2> StaticModel::problem() const {
  return {.operators = enriched.operators,
          .position = setup.problem.cloud.position,
          .links = enriched.links,
          .link_points = approximation.mechanics,
          .elasticity = setup.problem.materials.front().elasticity,
          .out_of_plane = plane_stress(input) ? OutOfPlane::stress_free : OutOfPlane::strain_free,
          .stabilisation = setup.problem.stabilisation,
          .supports = setup.problem.supports,
          .thermal_strain = setup.problem.materials.front().thermal_strain(input.initial.temperature),
          .time = input.time.end,
          .force = force};
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

std::vector<TipResult> evaluate_tips(const StaticModel& model, const StaticSolution<2>& solution) {
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
  const fracture::ElasticField field{model.enriched.operators, model.setup.problem.cloud.position,
                                     model.enriched.position, gradient, solution.stress};
  std::vector<TipResult> results;
  for (std::size_t t = 0; t < model.tips.size(); ++t) {
    const fracture::CrackTip& tip = model.tips[t];
    TipResult result;
    result.name = tip.name;
    result.enriched = model.enrichment_radius[t] > 0.0;
    result.spacing_over_half_length = tip.spacing / tip.half_length;
    std::vector<fracture::StressIntensity> found;
    for (const fracture::Ring& ring : rings(model.input.fracture, tip)) {
      found.push_back(fracture::stress_intensity(tip, ring, plane, field, model.loads));
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

std::vector<std::string> closed_cracks(const StaticModel& model, const StaticSolution<2>& solution) {
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

std::string beyond_yield(const StaticModel& model, const StaticSolution<2>& solution) {
  const plasticity::Material& material = model.setup.problem.materials.front();
  if (!material.hardening) return "";
  const double yield = material.hardening->flow_stress(0.0, 0.0, model.input.initial.temperature);
  const Field& volume = model.enriched.operators.volume;
  double all = 0.0, beyond = 0.0;
  for (std::size_t p = 0; p < volume.size(); ++p) {
    const auto s = [&](std::size_t k) { return solution.stress[k][p]; };
    const double deviator = std::pow(s(0) - s(1), 2) + std::pow(s(1) - s(2), 2) + std::pow(s(2) - s(0), 2);
    const double mises = std::sqrt(0.5 * deviator + 3.0 * s(3) * s(3));
    all += volume[p];
    if ((material.anisotropy ? hill_stress(material.anisotropy->form(), {s(0), s(1), s(2), s(3), 0.0, 0.0})
                             : mises) > yield)
      beyond += volume[p];
  }
  if (beyond == 0.0) return "";
  return fmt::format("static analyses are elastic: the stress is above the yield stress of {}, {:.3g} Pa, in "
                     "{:.2g}% of the body",
                     material.name, yield, 100.0 * beyond / all);
}

State<2> as_state(const StaticModel& model, const StaticSolution<2>& solution) {
  const DiscreteOperators<2>& op = model.approximation.mechanics;
  State<2> state;
  state.time = model.input.time.end;
  const auto nodes = index_of(op.nodes), points = index_of(op.points);
  NodeState<2>& node = state.node;
  node.reference = node.position = node.initial_position = model.position;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < nodes; ++i) node.position[k][i] += solution.displacement[k][i];
  resize_all(node.velocity, nodes);
  node.force = model.force;
  for (Field& component : node.force) component.resize(nodes);
  node.mass = op.node_volume();
  for (double& m : node.mass) m *= model.setup.problem.materials.front().density;
  node.temperature = model.setup.temperature;

  PointState<2>& point = state.point;
  Fields<5> gradient;
  Fields<4> stress;
  resize_all(gradient, points);
  resize_all(stress, points);
  for (std::size_t p = 0; p < index_of(model.enriched.operators.points); ++p) {
    const auto cell = index_of(model.enriched.cell[p]);
    const double share = model.enriched.operators.volume[p] / op.volume[cell];
    for (std::size_t k = 0; k < 5; ++k) gradient[k][cell] += share * solution.gradient[k][p];
    for (std::size_t k = 0; k < 4; ++k) stress[k][cell] += share * solution.stress[k][p];
  }
  point.deformation = gradient;
  for (const std::size_t k : {0U, 3U, 4U})
    for (double& f : point.deformation[k]) f += 1.0;
  resize_all(point.piola, points);
  resize_all(point.inverse_plastic_cauchy_green, points);
  for (Field* field : {&point.plastic_strain, &point.plastic_rate, &point.equivalent_stress, &point.pressure,
                       &point.stored_energy, &point.plastic_work, &point.dissipation, &point.temperature})
    field->assign(points, 0.0);
  point.stress_free.assign(points, 1.0);
  interpolate<2>(op, node.temperature, point.temperature, 0, points);
  for (std::size_t p = 0; p < points; ++p) {
    const double J = jacobian<2>(point.deformation, p);
    Mat2 F, sigma;
    F << point.deformation[0][p], point.deformation[1][p], point.deformation[2][p], point.deformation[3][p];
    sigma << stress[0][p], stress[3][p], stress[3][p], stress[1][p];
    const Mat2 P = J * sigma * F.inverse().transpose();
    for (std::size_t k = 0; k < 4; ++k)
      point.piola[k][p] = P(static_cast<Eigen::Index>(k / 2), static_cast<Eigen::Index>(k % 2));
    point.piola[4][p] = J * stress[2][p] / point.deformation[4][p];
    const double mean = (stress[0][p] + stress[1][p] + stress[2][p]) / 3.0;
    double deviator = 2.0 * stress[3][p] * stress[3][p];
    for (std::size_t k = 0; k < 3; ++k) deviator += (stress[k][p] - mean) * (stress[k][p] - mean);
    point.pressure[p] = -J * mean;
    point.equivalent_stress[p] = J * std::sqrt(1.5 * deviator);
  }
  return state;
}

} // namespace cnem::app
