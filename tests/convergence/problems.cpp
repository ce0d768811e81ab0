#include "problems.hpp"
#include "core/index.hpp"

#include "clouds/generate.hpp"
#include "cnem/scni.hpp"
#include "methods/fe_simplices.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace cnem::convergence {

namespace {

CurvePiece line(const Vec2& from, const Vec2& to, const std::string& name) {
  return {from, to, {0, 0}, 0.0, false, name};
}
CurvePiece arc(const Vec2& from, const Vec2& to, bool clockwise, const std::string& name) {
  return {from, to, {0, 0}, from.norm(), clockwise, name};
}

Cloud<2> generate(std::vector<CurvePiece> pieces, double spacing) {
  clouds::DomainShape shape;
  shape.outer.pieces = std::move(pieces);
  return clouds::generate_cloud(shape, {spacing, {}}, {}).cloud;
}

/// Kirsch: infinite plate under unit tension along x, hole of radius 1.
Exact kirsch(const plasticity::Elasticity& elastic, const Vec2& x) {
  const double r = x.norm(), t = std::atan2(x.y(), x.x()), mu = elastic.mu(),
               kappa = 3.0 - 4.0 * elastic.poisson;
  const double a2 = 1.0 / (r * r), a4 = a2 * a2;
  Exact e;
  const double c2 = std::cos(2 * t), c4 = std::cos(4 * t), s2 = std::sin(2 * t), s4 = std::sin(4 * t);
  e.stress(0, 0) = 1.0 - a2 * (1.5 * c2 + c4) + 1.5 * a4 * c4;
  e.stress(1, 1) = -a2 * (0.5 * c2 - c4) - 1.5 * a4 * c4;
  e.stress(0, 1) = e.stress(1, 0) = -a2 * (0.5 * s2 + s4) + 1.5 * a4 * s4;
  const double f = 1.0 / (8.0 * mu), ir = 1.0 / r, ir3 = ir * ir * ir;
  e.displacement.x() =
      f * (r * (kappa + 1) * std::cos(t) + 2 * ir * ((1 + kappa) * std::cos(t) + std::cos(3 * t)) -
           2 * ir3 * std::cos(3 * t));
  e.displacement.y() =
      f * (r * (kappa - 3) * std::sin(t) + 2 * ir * ((1 - kappa) * std::sin(t) + std::sin(3 * t)) -
           2 * ir3 * std::sin(3 * t));
  return e;
}

/// Lamé: inner radius 1, outer 2, unit inner pressure, plane strain.
Exact lame(const plasticity::Elasticity& elastic, const Vec2& x) {
  const double r2 = x.squaredNorm(), a = 1.0 / 3.0, b = 4.0 / 3.0; // σ_r = a − b/r², σ_t = a + b/r²
  const Vec2 n = x.normalized();
  Exact e;
  e.stress = (a - b / r2) * n * n.transpose() + (a + b / r2) * (Mat2::Identity() - n * n.transpose());
  const double mu = elastic.mu(), nu = elastic.poisson;
  e.displacement = (a * (1 - 2 * nu) * std::sqrt(r2) + b / std::sqrt(r2)) / (2 * mu) * n;
  return e;
}

/// Timoshenko's cantilever, plane stress: length 8, height 2, end shear force 1 (down).
Exact timoshenko(const plasticity::Elasticity& elastic, const Vec2& x) {
  const double L = 8, D = 2, I = D * D * D / 12, E = elastic.young, nu = elastic.poisson;
  const double X = x.x(), y = x.y(), k = 1.0 / (6 * E * I);
  Exact e;
  e.displacement = {k * y * ((6 * L - 3 * X) * X + (2 + nu) * (y * y - D * D / 4)),
                    -k * (3 * nu * y * y * (L - X) + (4 + 5 * nu) * D * D * X / 4 + (3 * L - X) * X * X)};
  e.stress(0, 0) = (L - X) * y / I;
  e.stress(0, 1) = e.stress(1, 0) = -(D * D / 4 - y * y) / (2 * I);
  return e;
}

/// External forces from exact tractions on facets that are not held, in the components that are free.
Fields<2> forces(const Problem& problem, const Cloud<2>& cloud) {
  Fields<2> force;
  resize_all(force, index_of(cloud.nodes()));
  constexpr std::array<double, 3> s{0.1127016653792583, 0.5, 0.8872983346207417},
      w{5.0 / 18, 8.0 / 18, 5.0 / 18};
  for (const Facet<2>& facet : cloud.facets) {
    const Vec2 &a = cloud.position[facet.node[0]], &b = cloud.position[facet.node[1]];
    for (std::size_t g = 0; g < 3; ++g) {
      const Vec2 t = w[g] * problem.exact(a + s[g] * (b - a)).stress * right_normal(b - a);
      for (std::size_t k = 0; k < 2; ++k) {
        force[k][index_of(facet.node[0])] += (1.0 - s[g]) * t[static_cast<Eigen::Index>(k)];
        force[k][index_of(facet.node[1])] += s[g] * t[static_cast<Eigen::Index>(k)];
      }
    }
  }
  return force;
}

Supports<2> supports(const Problem& problem, const Cloud<2>& cloud) {
  std::vector<Support<2>> list;
  std::set<std::pair<NodeIndex, Eigen::Index>> done;
  for (const Problem::Held& held : problem.held)
    for (const Facet<2>& facet : cloud.facets)
      if (cloud.piece_names[facet.piece] == held.piece)
        for (const NodeIndex i : facet.node)
          for (const Eigen::Index k : held.components)
            if (done.emplace(i, k).second)
              list.push_back({held.piece,
                              Support<2>::Kind::displacement,
                              Vec2::Unit(k),
                              TimeTable(problem.exact(cloud.position[i]).displacement[k]),
                              {i}});
  return Supports<2>(std::move(list), index_of(cloud.nodes()));
}

/// σ : D⁻¹ : σ in the plane problem.
double complementary(const Problem& problem, const Mat2& s) {
  const double mu = problem.elasticity.mu(), nu = problem.elasticity.poisson;
  const double share = problem.out_of_plane == OutOfPlane::stress_free ? nu / (1 + nu) : nu;
  return (s.squaredNorm() - share * s.trace() * s.trace()) / (2 * mu);
}

} // namespace

Problem plate_with_hole() {
  Problem p;
  p.name = "plate_with_hole";
  p.title = "Plate with a hole, a quarter of 5 × 5 radii, exact tractions, plane strain, ν = 0.3";
  p.elasticity = {1.0, 0.3};
  p.spacings = {0.2, 0.1, 0.05};
  p.cloud = [](double h) {
    return generate({line({1, 0}, {5, 0}, "bottom"), line({5, 0}, {5, 5}, "free"),
                     line({5, 5}, {0, 5}, "free"), line({0, 5}, {0, 1}, "left"),
                     arc({0, 1}, {1, 0}, true, "hole")},
                    h);
  };
  p.exact = [e = p.elasticity](const Vec2& x) { return kirsch(e, x); };
  p.held = {{"bottom", {1}}, {"left", {0}}};
  return p;
}

Problem thick_cylinder() {
  Problem p;
  p.name = "thick_cylinder";
  p.title = "Thick cylinder, radii 1 and 2, inner pressure, a quarter, plane strain, ν = 0.3";
  p.elasticity = {1.0, 0.3};
  p.spacings = {0.2, 0.1, 0.05};
  p.cloud = [](double h) {
    return generate({line({1, 0}, {2, 0}, "bottom"), arc({2, 0}, {0, 2}, false, "outer"),
                     line({0, 2}, {0, 1}, "left"), arc({0, 1}, {1, 0}, true, "inner")},
                    h);
  };
  p.exact = [e = p.elasticity](const Vec2& x) { return lame(e, x); };
  p.held = {{"bottom", {1}}, {"left", {0}}};
  return p;
}

Problem cantilever() {
  Problem p;
  p.name = "cantilever";
  p.title = "Timoshenko's cantilever, 8 × 2, exact displacements at the root, plane stress, ν = 0.3";
  p.elasticity = {1000.0, 0.3};
  p.out_of_plane = OutOfPlane::stress_free;
  p.spacings = {0.4, 0.2, 0.1};
  p.cloud = [](double h) {
    return generate({line({0, -1}, {8, -1}, "free"), line({8, -1}, {8, 1}, "free"),
                     line({8, 1}, {0, 1}, "free"), line({0, 1}, {0, -1}, "root")},
                    h);
  };
  p.exact = [e = p.elasticity](const Vec2& x) { return timoshenko(e, x); };
  p.held = {{"root", {0, 1}}};
  return p;
}

Problem affine_patch() {
  Problem p;
  p.name = "affine_patch";
  p.title = "Affine patch: a notched plate under a linear displacement";
  p.elasticity = {1.0, 0.3};
  p.spacings = {0.2, 0.1};
  p.cloud = [](double h) {
    return generate({line({0, 0}, {1, 0}, "held"), line({1, 0}, {1, 1}, "held"),
                     line({1, 1}, {0.6, 1}, "held"), line({0.6, 1}, {0.5, 0.4}, "free"),
                     line({0.5, 0.4}, {0.4, 1}, "free"), line({0.4, 1}, {0, 1}, "held"),
                     line({0, 1}, {0, 0}, "held")},
                    h);
  };
  p.exact = [e = p.elasticity](const Vec2& x) {
    Mat2 gradient;
    gradient << 0.3, 0.1, -0.2, 0.5;
    Exact exact;
    exact.displacement = gradient * x;
    exact.stress =
        e.mu() * (gradient + gradient.transpose()) + e.lambda() * gradient.trace() * Mat2::Identity();
    return exact;
  };
  p.held = {{"held", {0, 1}}};
  return p;
}

Cloud<2> cook_cloud(int n) {
  clouds::DomainShape shape;
  shape.outer.pieces = {line({0, 0}, {48, 44}, "bottom"), line({48, 44}, {48, 60}, "right"),
                        line({48, 60}, {0, 44}, "top"), line({0, 44}, {0, 0}, "left")};
  clouds::CloudOptions options;
  options.pattern = clouds::Pattern::list;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double s = i / double(n), t = j / double(n);
      options.nodes.emplace_back(48 * s, (1 - t) * 44 * s + t * (44 + 16 * s));
    }
  return clouds::generate_cloud(shape, {}, options).cloud;
}

std::vector<Method> methods() {
  std::vector<Method> list;
  for (const double alpha : {0.05, 0.0}) {
    const std::string suffix = alpha > 0 ? "" : ", not stabilised";
    for (int points = 1; points <= 3; ++points)
      list.push_back({"Sibson, " + std::to_string(points) + (points > 1 ? " points" : " point") + suffix,
                      std::make_shared<scni::Cnem>(scni::Options{scni::Functions::sibson, points}), alpha});
    list.push_back({"Laplace, 2 points" + suffix,
                    std::make_shared<scni::Cnem>(scni::Options{scni::Functions::laplace, 2}), alpha});
  }
  list.push_back({"FE triangles", std::make_shared<methods::FeTriangles>(), 0.0});
  return list;
}

Errors solve(const Problem& problem, const Method& method, double spacing) {
  const Cloud<2> cloud = problem.cloud(spacing);
  const Approximation<2> approximation = method.method->rebuild(cloud);
  const Supports<2> held = supports(problem, cloud);
  const Fields<2> force = forces(problem, cloud);
  const StaticSolution<2> solution = solve_statics<2>({.operators = approximation.mechanics,
                                                       .position = cloud.position,
                                                       .links = approximation.links,
                                                       .link_points = approximation.mechanics,
                                                       .elasticity = problem.elasticity,
                                                       .out_of_plane = problem.out_of_plane,
                                                       .stabilisation = method.stabilisation,
                                                       .supports = held,
                                                       .force = force});
  Errors errors;
  errors.nodes = cloud.nodes();
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    const Vec2 exact = problem.exact(cloud.position[i]).displacement;
    const double volume = approximation.node_volume[i];
    error += volume * (Vec2(solution.displacement[0][i], solution.displacement[1][i]) - exact).squaredNorm();
    size += volume * exact.squaredNorm();
  }
  errors.l2 = std::sqrt(error / size);

  error = size = 0.0;
  const CellGeometry<2>& cells = approximation.cells;
  for (std::size_t p = 0; p + 1 < cells.begin.size(); ++p) {
    Mat2 stress;
    stress << solution.stress[0][p], solution.stress[3][p], solution.stress[3][p], solution.stress[1][p];
    const auto first = index_of(cells.begin[p]), last = index_of(cells.begin[p + 1]);
    Vec2 centre = Vec2::Zero();
    for (std::size_t k = first; k < last; ++k)
      centre += cells.vertex[index_of(cells.index[k])] / double(last - first);
    for (std::size_t k = first; k < last; ++k) {
      const Vec2 a = cells.vertex[index_of(cells.index[k])],
                 b = cells.vertex[index_of(cells.index[k + 1 < last ? k + 1 : first])];
      const double weight = cross(a - centre, b - centre) / 6.0; // a third of the triangle's area
      for (const Vec2& x : {Vec2(0.5 * (a + b)), Vec2(0.5 * (b + centre)), Vec2(0.5 * (centre + a))}) {
        const Mat2 exact = problem.exact(x).stress;
        error += weight * complementary(problem, stress - exact);
        size += weight * complementary(problem, exact);
      }
    }
  }
  errors.energy = std::sqrt(error / size);
  return errors;
}

double cook_tip(const Method& method, const plasticity::Elasticity& elasticity, int n) {
  const Cloud<2> cloud = cook_cloud(n);
  const Approximation<2> approximation = method.method->rebuild(cloud);
  std::vector<NodeIndex> left;
  Fields<2> force;
  resize_all(force, index_of(cloud.nodes()));
  NodeIndex tip{};
  for (const NodeIndex i : cloud.position.indices()) {
    const Vec2& x = cloud.position[i];
    if (x.x() == 0.0) left.push_back(i);
    if ((x - Vec2(48, 52)).norm() < (cloud.position[tip] - Vec2(48, 52)).norm()) tip = i;
  }
  for (const Facet<2>& facet : cloud.facets)
    if (cloud.piece_names[facet.piece] == "right")
      for (const NodeIndex i : facet.node)
        force[1][index_of(i)] +=
            0.5 / 16.0 * (cloud.position[facet.node[1]] - cloud.position[facet.node[0]]).norm();
  const Supports<2> held({{"left", Support<2>::Kind::displacement, Vec2(1, 0), TimeTable(0.0), left},
                          {"left", Support<2>::Kind::displacement, Vec2(0, 1), TimeTable(0.0), left}},
                         index_of(cloud.nodes()));
  return solve_statics<2>({.operators = approximation.mechanics,
                           .position = cloud.position,
                           .links = approximation.links,
                           .link_points = approximation.mechanics,
                           .elasticity = elasticity,
                           .stabilisation = method.stabilisation,
                           .supports = held,
                           .force = force})
      .displacement[1][index_of(tip)];
}

} // namespace cnem::convergence
