#pragma once
// The integrator of masses and springs in space.
#include "contact/contact.hpp"
#include "space_shapes.hpp"
#include "tests/unit/contact/mass_sums.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace cnem::contact::testing {

inline Tool<3> tool(std::shared_ptr<const ToolShape<3>> shape, const Vec3& velocity = {0, 0, 0},
                    double friction = 0.0) {
  Tool<3> made;
  made.name = "tool";
  made.shape = std::move(shape);
  made.motion.velocity = {TimeTable(velocity.x()), TimeTable(velocity.y()), TimeTable(velocity.z())};
  made.friction = Coulomb{friction};
  return made;
}

struct SpaceMasses {
  struct Spring {
    int a, b;
    double stiffness, damping, length;
  };
  Fields<3> x, v;
  Field mass;
  std::vector<Spring> springs;
  std::vector<Facet<3>> facets;
  std::vector<NodeConstraint<3>> constraints;
  IndexedVector<BoundaryNodeIndex, double> flow_stress;
  double time = 0.0, dt_before = 0.0;
  std::shared_ptr<RigidContact<3>> contact;

  int nodes() const { return static_cast<int>(mass.size()); }
  int add(const Vec3& at, double m, const Vec3& velocity = {0, 0, 0}) {
    for (std::size_t k = 0; k < 3; ++k) {
      x[k].push_back(at[static_cast<int>(k)]);
      v[k].push_back(velocity[static_cast<int>(k)]);
    }
    mass.push_back(m);
    return nodes() - 1;
  }
  Vec3 position(int i) const { return {x[0][std::size_t(i)], x[1][std::size_t(i)], x[2][std::size_t(i)]}; }
  Vec3 velocity(int i) const { return {v[0][std::size_t(i)], v[1][std::size_t(i)], v[2][std::size_t(i)]}; }
  void set_velocity(const Vec3& to) {
    for (std::size_t k = 0; k < 3; ++k) std::fill(v[k].begin(), v[k].end(), to[static_cast<int>(k)]);
  }
  void link(int a, int b, double stiffness, double damping) {
    springs.push_back({a, b, stiffness, damping, (position(a) - position(b)).norm()});
  }
  void facet(int a, int b, int c) {
    facets.push_back({{as<NodeIndex>(a), as<NodeIndex>(b), as<NodeIndex>(c)}, {}});
  }
  void start(std::vector<Tool<3>> tools, BodyContactLaw bodies = {}) {
    contact = std::make_shared<RigidContact<3>>(std::move(tools), Space::plane, bodies);
    contact->set_boundary(facets, mass.size(), constraints);
  }
  void step(double dt) {
    const double dt_mean = 0.5 * (dt_before + dt);
    std::vector<Vec3> force(mass.size(), Vec3::Zero());
    for (const Spring& s : springs) {
      const Vec3 d = position(s.b) - position(s.a), e = d.normalized();
      const double pull =
          s.stiffness * (d.norm() - s.length) + s.damping * e.dot(velocity(s.b) - velocity(s.a));
      force[std::size_t(s.a)] += pull * e;
      force[std::size_t(s.b)] -= pull * e;
    }
    for (const NodeConstraint<3>& c : constraints) force[index_of(c.node)] = c.free * force[index_of(c.node)];
    contact->remember(v);
    for (std::size_t i = 0; i < mass.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        v[k][i] += dt_mean * force[i][int(k)] / mass[i];
        x[k][i] += dt * v[k][i];
      }
    contact->correct({.time = time,
                      .dt = dt,
                      .dt_mean = dt_mean,
                      .position = x,
                      .velocity = v,
                      .mass = mass,
                      .flow_stress = flow_stress});
    time += dt;
    dt_before = dt;
  }
  Vec3 momentum() const { return momentum_of<3>(mass, v); }
  double kinetic() const { return kinetic_of<3>(mass, v); }
};

/// A block of n nodes along each axis from `low`, spacing h, with springs along edges and both diagonals of
/// each side of the cubes, and its surface in triangles. Total mass 1.
inline SpaceMasses space_block(const std::array<int, 3>& n, double h, const Vec3& low, double stiffness,
                               double damping) {
  SpaceMasses made;
  const double m = 1.0 / ((n[0] - 1) * (n[1] - 1) * (n[2] - 1));
  const auto id = [&](int i, int j, int k) { return (k * n[1] + j) * n[0] + i; };
  const auto share = [&](int i, std::size_t axis) { return i == 0 || i == n[axis] - 1 ? 0.5 : 1.0; };
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        made.add(low + h * Vec3(i, j, k), m * share(i, 0) * share(j, 1) * share(k, 2));
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        for (const auto& [a, b, c] : std::vector<std::array<int, 3>>{{1, 0, 0},
                                                                     {0, 1, 0},
                                                                     {0, 0, 1},
                                                                     {1, 1, 0},
                                                                     {1, -1, 0},
                                                                     {1, 0, 1},
                                                                     {1, 0, -1},
                                                                     {0, 1, 1},
                                                                     {0, 1, -1}})
          if (i + a < n[0] && j + b >= 0 && j + b < n[1] && k + c >= 0 && k + c < n[2])
            made.link(id(i, j, k), id(i + a, j + b, k + c), stiffness, damping);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t one = (axis + 1) % 3, other = (axis + 2) % 3;
    for (const bool high : {false, true})
      for (int p = 0; p + 1 < n[one]; ++p)
        for (int q = 0; q + 1 < n[other]; ++q) {
          const auto corner = [&](int dp, int dq) {
            std::array<int, 3> at{};
            at[axis] = high ? n[axis] - 1 : 0;
            at[one] = p + dp;
            at[other] = q + dq;
            return id(at[0], at[1], at[2]);
          };
          const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (high)
            made.facet(a, b, c), made.facet(a, c, d);
          else
            made.facet(a, c, b), made.facet(a, d, c);
        }
  }
  return made;
}

} // namespace cnem::contact::testing
