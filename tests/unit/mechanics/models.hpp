#pragma once
// Bodies for tests of the solver: rectangles of a method and a material.
#include "cnem/scni.hpp"
#include "mechanics/explicit_solver.hpp"
#include "methods/efg.hpp"
#include "methods/fe_simplices.hpp"
#include "methods/hybrid.hpp"
#include "methods/sph.hpp"
#include "plasticity/hardening_laws.hpp"
#include "tests/clouds.hpp"
#include "tests/index_literals.hpp"

#include <cmath>
#include <functional>
#include <ostream>

namespace cnem::testing {

using namespace literals;

enum class Method { cnem, triangles, sph, hybrid, efg, mls };
inline void PrintTo(Method method, std::ostream* out) {
  const char* const names[] = {"cnem", "triangles", "sph", "hybrid", "efg", "mls"};
  *out << names[static_cast<int>(method)];
}

inline std::unique_ptr<Discretisation<2>> make(Method method, Space space = Space::plane) {
  if (method == Method::triangles) return std::make_unique<methods::FeTriangles>(space);
  if (method == Method::sph) return std::make_unique<methods::Sph>();
  if (method == Method::efg) return std::make_unique<methods::Efg>();
  if (method == Method::hybrid) // both kinds of functions in a jittered cloud of 1 mm
    return std::make_unique<methods::Hybrid>(1.1e-3, 2, space);
  scni::Options options{.space = space};
  if (method == Method::mls) options.support = 2.5;
  return std::make_unique<scni::Cnem>(options);
}

inline plasticity::Material steel() {
  plasticity::Material material;
  material.name = "steel";
  material.density = 7850.0;
  material.elasticity = {210e9, 0.33};
  material.specific_heat = 500.0;
  material.conductivity = 15.0;
  return material;
}

inline plasticity::Material steel_304L() {
  plasticity::Material material = steel();
  material.conductivity = 5.86;
  material.hardening = plasticity::JohnsonCook{.A = 253e6,
                                               .B = 685e6,
                                               .n = 0.312,
                                               .C = 0.0973,
                                               .rate0 = 1.0,
                                               .m = 2.044,
                                               .T0 = 296.0,
                                               .Tmelt = 1698.0};
  return material;
}

/// Rectangle [0, a] × [0, b] with its four sides as pieces 0 bottom, 1 right, 2 top, 3 left.
inline Cloud<2> rectangle(double a, double b, double spacing, Lattice lattice = Lattice::hexagonal,
                          double jitter = 0.1, std::uint64_t seed = 1) {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {a, 0}, {a, b}, {0, b}}, spacing);
  cloud.piece_names = {"bottom", "right", "top", "left"};
  for (Facet<2>& facet : cloud.facets) {
    const Vec2 middle = 0.5 * (cloud.position[static_cast<std::size_t>(facet.node[0])] +
                               cloud.position[static_cast<std::size_t>(facet.node[1])]);
    const double distance[4] = {middle.y(), a - middle.x(), b - middle.y(), middle.x()};
    facet.piece = as<PieceIndex>(std::min_element(distance, distance + 4) - distance);
  }
  fill(cloud, lattice, spacing, jitter, 0.5 * spacing, seed);
  return cloud;
}

inline std::vector<NodeIndex> nodes_on(const Cloud<2>& cloud, PieceIndex piece) {
  std::vector<NodeIndex> nodes;
  for (const Facet<2>& facet : cloud.facets)
    if (facet.piece == piece) nodes.insert(nodes.end(), facet.node.begin(), facet.node.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

inline Problem<2> model_of(Cloud<2> cloud, Method method, plasticity::Material material) {
  Problem<2> model;
  model.method = make(method);
  model.supports = Supports<2>({}, static_cast<std::size_t>(cloud.nodes()));
  model.loads = Loads<2>({}, {}, {}, cloud.position);
  model.cloud = std::move(cloud);
  model.materials = {std::move(material)};
  model.thermal = false;
  return model;
}

inline ExplicitSolver<2> start(Problem<2> model, const std::function<Vec2(const Vec2&)>& velocity,
                               double temperature = 296.0) {
  Fields<2> v;
  resize_all(v, static_cast<std::size_t>(model.cloud.nodes()));
  for (std::size_t i = 0; i < v[0].size(); ++i) {
    const Vec2 at = velocity(model.cloud.position[i]);
    v[0][i] = at.x();
    v[1][i] = at.y();
  }
  Field t(v[0].size(), temperature);
  return ExplicitSolver<2>(std::move(model), std::move(v), std::move(t));
}

/// kg/m
inline double total_mass(const ExplicitSolver<2>& solver) {
  double mass = 0.0;
  for (const double m : solver.state().node.mass) mass += m;
  return mass;
}

inline double sum_of_products(const Field& a, const Field& b) {
  double total = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) total += a[i] * b[i];
  return total;
}

/// What a term tells of the present state; NaN when none does under this name.
inline double metric_of(const ExplicitSolver<2>& solver, const std::string& name) {
  for (const Metric& metric : solver.metrics())
    if (metric.name == name) return metric.value;
  return std::nan("");
}

/// Linear and angular momentum of the nodes about the origin, at t_n.
struct Momenta {
  Vec2 linear = Vec2::Zero();
  double angular = 0.0;
};
inline Momenta momenta(const ExplicitSolver<2>& solver) {
  const NodeState<2>& node = solver.state().node;
  Momenta sum;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const Vec2 mv = node.mass[i] * Vec2(node.velocity[0][i], node.velocity[1][i]);
    sum.linear += mv;
    sum.angular += cross(Vec2(node.position[0][i], node.position[1][i]), mv);
  }
  return sum;
}

} // namespace cnem::testing
