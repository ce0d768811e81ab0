// Linear statics: patch tests, a tensile bar, energy, and supports that are missing.
#include "cnem/scni.hpp"
#include "core/error.hpp"
#include "mechanics/statics/rigid_motion.hpp"
#include "mechanics/statics/statics.hpp"
#include "methods/fe_simplices.hpp"
#include "tests/clouds.hpp"
#include "tests/index_literals.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace cnem::testing {

using namespace literals;

namespace {

using Kind = Support<2>::Kind;

struct Body {
  Cloud<2> cloud;
  Approximation<2> approximation;
  Supports<2> supports;
  Fields<2> force;

  Body(Cloud<2> c, Discretisation<2>& method, std::vector<Support<2>> list)
      : cloud(std::move(c)), approximation(method.rebuild(cloud)),
        supports(std::move(list), static_cast<std::size_t>(cloud.nodes())) {
    resize_all(force, static_cast<std::size_t>(cloud.nodes()));
  }
  StaticProblem<2> problem(OutOfPlane kind) const {
    return {.operators = approximation.mechanics,
            .position = cloud.position,
            .links = approximation.links,
            .link_points = approximation.mechanics,
            .elasticity = {2.0, 0.3},
            .out_of_plane = kind,
            .supports = supports,
            .force = force};
  }
};

std::vector<std::unique_ptr<Discretisation<2>>> methods() {
  std::vector<std::unique_ptr<Discretisation<2>>> list;
  list.push_back(std::make_unique<scni::Cnem>());
  list.push_back(std::make_unique<methods::FeTriangles>());
  return list;
}

std::vector<NodeIndex> nodes_where(const Cloud<2>& cloud, auto&& wanted) {
  std::vector<NodeIndex> nodes;
  for (const NodeIndex i : cloud.position.indices())
    if (wanted(cloud.position[static_cast<std::size_t>(i)])) nodes.push_back(i);
  return nodes;
}

/// The unit square pulled along x by 1: held at x = 0 along x, and at the origin along y.
Body pulled_square(Discretisation<2>& method) {
  const Cloud<2> cloud = jittered_square(0.1, 0.25, 3);
  const auto left = nodes_where(cloud, [](const Vec2& x) { return x.x() == 0.0; });
  const auto corner = nodes_where(cloud, [](const Vec2& x) { return x.norm() == 0.0; });
  Body body(cloud, method,
            {{"left", Kind::symmetry, Vec2(1, 0), {}, left, {}},
             {"corner", Kind::displacement, Vec2(0, 1), TimeTable(0.0), corner, {}}});
  for (const Facet<2>& facet : body.cloud.facets) {
    const Vec2 a = body.cloud.position[static_cast<std::size_t>(facet.node[0])],
               b = body.cloud.position[static_cast<std::size_t>(facet.node[1])];
    if (a.x() == 1.0 && b.x() == 1.0)
      for (const NodeIndex i : facet.node) body.force[0][static_cast<std::size_t>(i)] += 0.5 * (b - a).norm();
  }
  return body;
}

TEST(Statics, patch_uniaxial_tension_is_exact_in_plane_strain_and_plane_stress) {
  for (const auto& method : methods()) {
    SCOPED_TRACE(method->name());
    const Body body = pulled_square(*method);
    for (const OutOfPlane kind : {OutOfPlane::strain_free, OutOfPlane::stress_free}) {
      const StaticSolution<2> s = solve_statics(body.problem(kind));
      const bool stress = kind == OutOfPlane::stress_free;
      const double E = stress ? 2.0 : 2.0 / (1.0 - 0.09), nu = stress ? 0.3 : 0.3 / 0.7;
      for (std::size_t i = 0; i < body.cloud.position.size(); ++i) {
        EXPECT_NEAR(s.displacement[0][i], body.cloud.position[i].x() / E, 1e-12);
        EXPECT_NEAR(s.displacement[1][i], -nu * body.cloud.position[i].y() / E, 1e-12);
      }
      for (std::size_t p = 0; p < s.stress[0].size(); ++p) {
        EXPECT_NEAR(s.stress[0][p], 1.0, 1e-11);
        EXPECT_NEAR(s.stress[1][p], 0.0, 1e-11);
        EXPECT_NEAR(s.stress[2][p], stress ? 0.0 : 0.3, 1e-11);
        EXPECT_NEAR(s.gradient[4][p], stress ? -0.15 : 0.0, 1e-12);
      }
      EXPECT_NEAR(s.strain_energy, 0.5 / E, 1e-12);
      EXPECT_NEAR(s.external_work, 0.5 / E, 1e-12);
      EXPECT_LT(s.stabilisation_energy, 1e-20);
      EXPECT_LT(s.residual, 1e-12);
      double reaction = 0.0;
      for (const double r : s.reaction[0]) reaction += r;
      EXPECT_NEAR(reaction, -1.0, 1e-12);
    }
  }
}

/// The unit square at another temperature, its sides held along their normals where it is said.
Body warm_square(Discretisation<2>& method, bool across, bool along) {
  const Cloud<2> cloud = jittered_square(0.1, 0.25, 3);
  const auto side = [&](int k, double at) {
    return nodes_where(cloud, [&](const Vec2& x) { return x[k] == at; });
  };
  std::vector<Support<2>> held{{"left", Kind::symmetry, Vec2(1, 0), {}, side(0, 0.0), {}},
                               {"bottom", Kind::symmetry, Vec2(0, 1), {}, side(1, 0.0), {}}};
  if (across) held.push_back({"right", Kind::symmetry, Vec2(1, 0), {}, side(0, 1.0), {}});
  if (along) held.push_back({"top", Kind::symmetry, Vec2(0, 1), {}, side(1, 1.0), {}});
  return {cloud, method, held};
}

TEST(Statics, expands_freely_without_stress_and_presses_on_what_holds_it_as_hooke_says) {
  const double E = 2.0, nu = 0.3, theta = 1e-3;
  std::vector<std::unique_ptr<Discretisation<2>>> planar = methods();
  planar.push_back(std::make_unique<scni::Cnem>(scni::Options{.space = Space::revolution}));
  for (const auto& method : planar)
    for (const OutOfPlane kind : {OutOfPlane::strain_free, OutOfPlane::stress_free})
      for (const int held : {0, 1, 2}) {
        const Body body = warm_square(*method, held > 0, held > 1);
        const bool round = body.approximation.mechanics.of_revolution();
        const bool stress = kind == OutOfPlane::stress_free;
        if (round && (stress || held == 1)) continue;
        StaticProblem<2> problem = body.problem(kind);
        problem.thermal_strain = theta;
        const StaticSolution<2> s = solve_statics(problem);
        const double free = stress || round ? theta : (1.0 + nu) * theta;
        const double moved = held == 2   ? 0.0
                             : held == 0 ? free
                             : stress    ? (1.0 + nu) * theta
                                         : (1.0 + nu) / (1.0 - nu) * theta;
        const double xx = held == 0   ? 0.0
                          : held == 1 ? (stress ? -E * theta : -E * theta / (1.0 - nu))
                          : stress    ? -E * theta / (1.0 - nu)
                                      : -E * theta / (1.0 - 2.0 * nu);
        for (std::size_t i = 0; i < body.cloud.position.size(); ++i) {
          EXPECT_NEAR(s.displacement[0][i], held ? 0.0 : free * body.cloud.position[i].x(), 1e-14);
          EXPECT_NEAR(s.displacement[1][i], moved * body.cloud.position[i].y(), 1e-14);
        }
        for (std::size_t p = 0; p < s.stress[0].size(); ++p) {
          EXPECT_NEAR(s.stress[0][p], xx, 1e-14) << held;
          EXPECT_NEAR(s.stress[1][p], held == 2 ? xx : 0.0, 1e-14) << held;
          if (stress) { EXPECT_EQ(s.stress[2][p], 0.0); }
        }
        EXPECT_NEAR(s.strain_energy + s.stabilisation_energy, s.external_work + s.thermal_work, 1e-16);
        EXPECT_EQ(s.thermal_work > 1e-9, held > 0 || !(stress || round));
        EXPECT_LT(s.residual, 1e-12);
      }
}

TEST(Statics, oblique_symmetry_plane_gives_the_turned_solution) {
  const double angle = 0.6;
  Mat2 turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  scni::Cnem method;
  const Body straight = pulled_square(method);
  Cloud<2> cloud = straight.cloud;
  for (Vec2& x : cloud.position) x = turn * x;
  std::vector<Support<2>> supports = straight.supports.list();
  for (Support<2>& support : supports) {
    support.direction = turn * support.direction;
    support.kind = Kind::symmetry;
  }
  Body turned(cloud, method, supports);
  for (std::size_t i = 0; i < straight.force[0].size(); ++i) {
    turned.force[0][i] = turn(0, 0) * straight.force[0][i];
    turned.force[1][i] = turn(1, 0) * straight.force[0][i];
  }
  const StaticSolution<2> a = solve_statics(straight.problem(OutOfPlane::strain_free)),
                          b = solve_statics(turned.problem(OutOfPlane::strain_free));
  for (std::size_t i = 0; i < straight.force[0].size(); ++i) {
    const Vec2 expected = turn * Vec2(a.displacement[0][i], a.displacement[1][i]);
    EXPECT_NEAR(b.displacement[0][i], expected.x(), 1e-11);
    EXPECT_NEAR(b.displacement[1][i], expected.y(), 1e-11);
  }
}

/// u_r = a r and u_z = b z: constant strains of a body of revolution, loaded on its mantle and its ends.
TEST(Statics, patch_body_of_revolution_under_constant_stress_is_exact) {
  std::vector<std::unique_ptr<Discretisation<2>>> list;
  list.push_back(std::make_unique<scni::Cnem>(scni::Options{.space = Space::revolution}));
  list.push_back(std::make_unique<methods::FeTriangles>(Space::revolution));
  for (const auto& method : list)
    for (const double bore : {0.0, 0.5}) {
      SCOPED_TRACE(method->name());
      Cloud<2> cloud = jittered_square(0.1, 0.25, 3);
      for (Vec2& x : cloud.position) x.x() += bore;
      const auto bottom = nodes_where(cloud, [](const Vec2& x) { return x.y() == 0.0; });
      const auto axis = nodes_where(cloud, [](const Vec2& x) { return x.x() == 0.0; });
      std::vector<Support<2>> supports{{"bottom", Kind::symmetry, Vec2(0, -1), {}, bottom, {}}};
      if (!axis.empty()) supports.push_back({"axis", Kind::symmetry, Vec2(-1, 0), {}, axis, {}});
      Body body(std::move(cloud), *method, std::move(supports));
      const double radial = 3.0, axial = 1.0; // stresses
      for (const Facet<2>& facet : body.cloud.facets) {
        const Vec2 a = body.cloud.position[static_cast<std::size_t>(facet.node[0])],
                   b = body.cloud.position[static_cast<std::size_t>(facet.node[1])];
        const auto area = end_areas(Space::revolution, a, b);
        const Vec2 normal = right_normal(b - a).normalized();
        for (std::size_t end = 0; end < 2; ++end) {
          body.force[0][static_cast<std::size_t>(facet.node[end])] += area[end] * radial * normal.x();
          body.force[1][static_cast<std::size_t>(facet.node[end])] += area[end] * axial * normal.y();
        }
      }
      const StaticSolution<2> s = solve_statics(body.problem(OutOfPlane::strain_free));
      const double E = 2.0, nu = 0.3, e_r = (radial - nu * (radial + axial)) / E,
                   e_z = (axial - 2.0 * nu * radial) / E;
      for (std::size_t i = 0; i < body.cloud.position.size(); ++i) {
        EXPECT_NEAR(s.displacement[0][i], e_r * body.cloud.position[i].x(), 1e-11);
        EXPECT_NEAR(s.displacement[1][i], e_z * body.cloud.position[i].y(), 1e-11);
      }
      for (std::size_t p = 0; p < s.stress[0].size(); ++p) {
        EXPECT_NEAR(s.stress[0][p], radial, 1e-10);
        EXPECT_NEAR(s.stress[1][p], axial, 1e-10);
        EXPECT_NEAR(s.stress[2][p], radial, 1e-10);
        EXPECT_NEAR(s.gradient[4][p], e_r, 1e-11);
      }
      EXPECT_NEAR(s.strain_energy, s.external_work, 1e-12 * s.external_work);
      EXPECT_LT(s.residual, 1e-12);
    }
}

TEST(MissingSupport, of_a_body_of_revolution_is_the_axial_one_alone) {
  scni::Cnem method(scni::Options{.space = Space::revolution});
  Cloud<2> cloud = jittered_square(0.2, 0.25, 3);
  for (Vec2& x : cloud.position) x.x() += 1.0;
  const Body loose(cloud, method, {});
  EXPECT_NE(missing_support(loose.approximation.mechanics, loose.cloud.position, loose.supports)
                .find("translation along (0, 1)"),
            std::string::npos);
  const Body held(cloud, method, {{"node", Kind::displacement, Vec2(0, 1), TimeTable(0.0), {0_node}, {}}});
  EXPECT_EQ(missing_support(held.approximation.mechanics, held.cloud.position, held.supports), "");
}

TEST(MissingSupport, is_named) {
  const Cloud<2> cloud = jittered_square(0.25, 0.2, 1);
  const auto op = scni::Cnem().rebuild(cloud).mechanics;
  const auto left = nodes_where(cloud, [](const Vec2& x) { return x.x() == 0.0; });
  const auto corner = nodes_where(cloud, [](const Vec2& x) { return x.norm() == 0.0; });
  const auto missing = [&](std::vector<Support<2>> list) {
    return missing_support(op, cloud.position,
                           Supports<2>(std::move(list), static_cast<std::size_t>(cloud.nodes())));
  };
  EXPECT_NE(missing({}), "");
  EXPECT_NE(missing({{"left", Kind::symmetry, Vec2(1, 0), {}, left, {}}}).find("displacement in y"),
            std::string::npos);
  EXPECT_NE(missing({{"corner", Kind::displacement, Vec2(1, 0), TimeTable(0.0), corner, {}},
                     {"corner", Kind::displacement, Vec2(0, 1), TimeTable(0.0), corner, {}}})
                .find("rotation about (0, 0) m"),
            std::string::npos);
  EXPECT_EQ(missing({{"left", Kind::symmetry, Vec2(1, 0), {}, left, {}},
                     {"corner", Kind::displacement, Vec2(0, 1), TimeTable(0.0), corner, {}}}),
            "");
}

TEST(MissingSupport, stops_the_solution) {
  scni::Cnem method;
  const Body body(jittered_square(0.25, 0.2, 1), method, {});
  EXPECT_THROW(solve_statics(body.problem(OutOfPlane::strain_free)), InputError);
}

} // namespace
} // namespace cnem::testing
