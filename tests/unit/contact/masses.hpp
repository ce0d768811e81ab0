#pragma once
// A small explicit integrator of masses and springs, so that contact is tested without the solver.
#include "contact/contact.hpp"
#include "contact/curve_shape.hpp"
#include "tests/curves.hpp"
#include "tests/index_literals.hpp"
#include "tests/unit/contact/mass_sums.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace cnem::contact::testing {

inline Mat2 rotation(double angle) {
  Mat2 r;
  r << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return r;
}

inline CurvePiece segment(const Vec2& from, const Vec2& to) {
  CurvePiece piece;
  piece.from = from;
  piece.to = to;
  return piece;
}

inline CurvePiece arc(const Vec2& from, const Vec2& to, const Vec2& centre, bool clockwise = false) {
  CurvePiece piece = segment(from, to);
  piece.centre = centre;
  piece.radius = (from - centre).norm();
  piece.clockwise = clockwise;
  return piece;
}

using namespace cnem::testing::literals;
using cnem::testing::box;
using cnem::testing::polygon;

/// A box with all four corners rounded.
inline Curve rounded_box(const Vec2& low, const Vec2& high, double r) {
  const double x0 = low.x(), y0 = low.y(), x1 = high.x(), y1 = high.y();
  Curve curve;
  curve.pieces = {segment({x0 + r, y0}, {x1 - r, y0}), arc({x1 - r, y0}, {x1, y0 + r}, {x1 - r, y0 + r}),
                  segment({x1, y0 + r}, {x1, y1 - r}), arc({x1, y1 - r}, {x1 - r, y1}, {x1 - r, y1 - r}),
                  segment({x1 - r, y1}, {x0 + r, y1}), arc({x0 + r, y1}, {x0, y1 - r}, {x0 + r, y1 - r}),
                  segment({x0, y1 - r}, {x0, y0 + r}), arc({x0, y0 + r}, {x0 + r, y0}, {x0 + r, y0 + r})};
  return curve;
}

inline Curve rotated(Curve curve, double angle) {
  const Mat2 r = rotation(angle);
  for (CurvePiece& piece : curve.pieces) {
    piece.from = r * piece.from;
    piece.to = r * piece.to;
    piece.centre = r * piece.centre;
  }
  return curve;
}

inline Tool<2> tool(const Curve& curve, const Vec2& velocity = {0, 0}, double friction = 0.0) {
  Tool<2> made;
  made.name = "tool";
  made.shape = std::make_shared<CurveShape>(curve);
  made.motion.velocity = {TimeTable(velocity.x()), TimeTable(velocity.y())};
  made.friction = Coulomb{friction};
  return made;
}

/// Masses, springs with dashpots, a boundary and rigid contact.
struct Masses {
  struct Spring {
    int a, b;
    double stiffness, damping, length;
  };
  Fields<2> x, v;
  Field mass;
  std::vector<Spring> springs;
  std::vector<Facet<2>> facets;
  std::vector<NodeConstraint<2>> constraints;
  Vec2 gravity{0, 0};
  double time = 0.0, dt_before = 0.0;
  double applied_work = 0.0; ///< by gravity and springs on the nodes, same measure as contact's
  std::shared_ptr<RigidContact<2>> contact;
  IndexedVector<BoundaryNodeIndex, double> flow_stress, temperature, melting, effusivity;
  IndexedVector<BoundaryNodeIndex, std::int32_t> material;

  int add(const Vec2& at, double m, const Vec2& velocity = {0, 0}) {
    for (std::size_t k = 0; k < 2; ++k) {
      x[k].push_back(at[static_cast<int>(k)]);
      v[k].push_back(velocity[static_cast<int>(k)]);
    }
    mass.push_back(m);
    return static_cast<int>(mass.size()) - 1;
  }
  Vec2 position(NodeIndex i) const { return position(as<int>(i)); }
  Vec2 position(int i) const { return {x[0][std::size_t(i)], x[1][std::size_t(i)]}; }
  Vec2 velocity(int i) const { return {v[0][std::size_t(i)], v[1][std::size_t(i)]}; }
  void link(int a, int b, double stiffness, double damping = 0.0) {
    springs.push_back({a, b, stiffness, damping, (position(a) - position(b)).norm()});
  }
  void loop(const std::vector<int>& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      facets.push_back({{as<NodeIndex>(nodes[i]), as<NodeIndex>(nodes[(i + 1) % nodes.size()])}, {}});
  }
  /// Four masses of 1 kg/m at the corners of a square body.
  void square(const Vec2& low, double side) {
    const int first = add(low, 1.0);
    for (const Vec2& corner : {Vec2(side, 0), Vec2(side, side), Vec2(0, side)}) add(low + corner, 1.0);
    loop({first, first + 1, first + 2, first + 3});
  }
  /// A body with nine nodes `spacing` apart on the lower side of a disc round the origin; all move alike.
  void under_disc(double radius, double spacing, const Vec2& velocity) {
    std::vector<int> nodes;
    for (int i = -4; i <= 4; ++i) {
      const double angle = i * spacing / radius;
      nodes.push_back(add({-radius * std::sin(angle), -radius * std::cos(angle)}, 1.0, velocity));
    }
    for (const double side : {-0.5, 0.5}) nodes.push_back(add({side, -0.8}, 1.0, velocity));
    loop(nodes);
  }
  void start(std::vector<Tool<2>> tools) {
    contact = std::make_shared<RigidContact<2>>(std::move(tools));
    contact->set_boundary(facets, mass.size(), constraints);
  }

  void step(double dt) {
    const double dt_mean = 0.5 * (dt_before + dt);
    std::vector<Vec2> force(mass.size(), Vec2::Zero());
    for (std::size_t i = 0; i < mass.size(); ++i) force[i] = mass[i] * gravity;
    for (const Spring& s : springs) {
      const Vec2 d = position(s.b) - position(s.a), e = d.normalized();
      const double pull =
          s.stiffness * (d.norm() - s.length) + s.damping * e.dot(velocity(s.b) - velocity(s.a));
      force[std::size_t(s.a)] += pull * e;
      force[std::size_t(s.b)] -= pull * e;
    }
    for (const NodeConstraint<2>& c : constraints) force[index_of(c.node)] = c.free * force[index_of(c.node)];
    std::vector<Vec2> before;
    for (int i = 0; i < int(mass.size()); ++i) before.push_back(velocity(i));
    contact->remember(v);
    for (std::size_t i = 0; i < mass.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        v[k][i] += dt_mean * force[i][int(k)] / mass[i];
        x[k][i] += dt * v[k][i];
      }
    contact->correct({.time = time,
                      .dt = dt,
                      .dt_mean = dt_mean,
                      .position = x,
                      .velocity = v,
                      .mass = mass,
                      .material = material,
                      .flow_stress = flow_stress,
                      .temperature = temperature,
                      .melting = melting,
                      .effusivity = effusivity});
    for (int i = 0; i < int(mass.size()); ++i)
      applied_work += 0.5 * dt_mean * force[std::size_t(i)].dot(before[std::size_t(i)] + velocity(i));
    time += dt;
    dt_before = dt;
  }

  Vec2 momentum() const { return momentum_of<2>(mass, v); }
  double kinetic() const { return kinetic_of<2>(mass, v); }
  double total_mass() const {
    double sum = 0.0;
    for (const double m : mass) sum += m;
    return sum;
  }
  Vec2 centre() const {
    Vec2 sum = Vec2::Zero();
    for (int i = 0; i < int(mass.size()); ++i) sum += mass[std::size_t(i)] * position(i);
    return sum / total_mass();
  }
};

/// A rectangular block of nx × ny nodes from `low`, spacing h, turned about the origin, with springs between
/// neighbours and across. Total mass 1.
inline Masses block(int nx, int ny, double h, const Vec2& low, double stiffness, double damping = 0.0,
                    double angle = 0.0, const Vec2& velocity = {0, 0}) {
  Masses made;
  const Mat2 r = rotation(angle);
  const double m = 1.0 / ((nx - 1) * (ny - 1));
  const auto share = [](int i, int n) { return i == 0 || i == n - 1 ? 0.5 : 1.0; };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      made.add(r * (low + Vec2(i * h, j * h)), m * share(i, nx) * share(j, ny), velocity);
  const auto id = [&](int i, int j) { return j * nx + i; };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      if (i + 1 < nx) made.link(id(i, j), id(i + 1, j), stiffness, damping);
      if (j + 1 < ny) made.link(id(i, j), id(i, j + 1), stiffness, damping);
      if (i + 1 < nx && j + 1 < ny) {
        made.link(id(i, j), id(i + 1, j + 1), stiffness, damping);
        made.link(id(i + 1, j), id(i, j + 1), stiffness, damping);
      }
    }
  std::vector<int> loop;
  for (int i = 0; i + 1 < nx; ++i) loop.push_back(id(i, 0));
  for (int j = 0; j + 1 < ny; ++j) loop.push_back(id(nx - 1, j));
  for (int i = nx - 1; i > 0; --i) loop.push_back(id(i, ny - 1));
  for (int j = ny - 1; j > 0; --j) loop.push_back(id(0, j));
  made.loop(loop);
  return made;
}

} // namespace cnem::contact::testing
