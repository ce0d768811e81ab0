// Cohesive law at a point against closed forms: loading, unloading, reloading, compression, mixed modes.
#include "core/error.hpp"
#include "plasticity/cohesive.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cnem::plasticity {
namespace {

constexpr double um = 1e-6, MPa = 1e6;

/// Flax and PLA: paper 001.
CohesiveLaw flax() {
  CohesiveLaw law{.stiffness = 38e12, .strength = 18e6, .energy = 28.0};
  law.complete();
  return law;
}
CohesiveLaw mixed() {
  CohesiveLaw law{.stiffness = 1e14,
                  .strength = 30e6,
                  .shear_strength = 50e6,
                  .energy = 200.0,
                  .shear_energy = 700.0,
                  .eta = 2.1};
  law.complete();
  return law;
}

/// Goes along a path of separations; damage, dissipation and work of the mean tractions.
struct Point {
  CohesiveLaw law;
  Vec2 separation = Vec2::Zero();
  double damage = 0.0, dissipated = 0.0, work = 0.0;

  void go(const Vec2& to, int steps = 1) {
    const Vec2 start = separation;
    for (int k = 1; k <= steps; ++k) {
      const Vec2 next = start + (to - start) * (static_cast<double>(k) / steps);
      const double d = law.damage_at(next, damage);
      work += 0.5 * (traction() + law.traction(next, d)).dot(next - separation);
      dissipated += law.dissipated(separation, next, d - damage);
      damage = d;
      separation = next;
    }
  }
  Vec2 traction() const { return law.traction(separation, damage); }
};

void expect_near(const Vec2& got, double n, double s) {
  EXPECT_NEAR(got.x(), n, 1e-10 * 18e6);
  EXPECT_NEAR(got.y(), s, 1e-10 * 18e6);
}

TEST(Cohesive, path_of_the_reference) { // shared reference: composites.md, to its digits
  Point point{flax()};
  point.go({0.3 * um, 0});
  EXPECT_EQ(point.damage, 0.0);
  expect_near(point.traction(), 11.4 * MPa, 0.0);
  point.go({0.6 * um, 0});
  EXPECT_NEAR(point.damage, 0.248337, 5e-7);
  EXPECT_NEAR(point.traction().x() / MPa, 17.1379, 5e-5);
  const double before = point.damage;
  point.go({-0.1 * um, 0.3 * um});
  EXPECT_EQ(point.damage, before);
  expect_near(point.traction(), -3.8 * MPa, (1.0 - before) * 11.4 * MPa);
  EXPECT_NEAR(point.traction().y() / MPa, 8.5690, 5e-5);
}

TEST(Cohesive, loads_unloads_and_reloads_in_a_pure_mode) {
  const CohesiveLaw law = mixed();
  for (const bool shear : {false, true}) {
    const double t0 = shear ? 50e6 : 30e6, G = shear ? 700.0 : 200.0;
    const double first = t0 / 1e14, last = 2.0 * G / t0;
    const auto at = [&](double x) { return shear ? Vec2(0, x) : Vec2(x, 0); };
    const auto traction = [&](const Point& point) { return point.traction()[shear ? 1 : 0]; };
    Point point{law};
    point.go(at(first), 3);
    EXPECT_NEAR(traction(point), t0, 1e-10 * t0);
    EXPECT_NEAR(point.damage, 0.0, 1e-14);
    point.go(at(0.4 * last), 50);
    const double top = t0 * 0.6 * last / (last - first);
    EXPECT_NEAR(traction(point), top, 1e-10 * t0);
    point.go(at(0.1 * last), 7);
    EXPECT_NEAR(traction(point), 0.25 * top, 1e-10 * t0);
    point.go(at(0.4 * last), 5);
    EXPECT_NEAR(traction(point), top, 1e-10 * t0);
    EXPECT_NEAR(point.dissipated, 0.5 * (t0 * 0.4 * last - top * first), 1e-10 * G);
    point.go(at(1.1 * last), 1000);
    EXPECT_EQ(point.damage, 1.0);
    EXPECT_EQ(traction(point), 0.0);
    EXPECT_NEAR(point.work, point.dissipated, 1e-12 * G);
    EXPECT_NEAR(point.dissipated, G, 1e-3 * G); // the last step goes past the end
    if (shear) {
      point.go(at(-2.0 * last), 3);
      EXPECT_EQ(traction(point), 0.0);
    }
  }
}

TEST(Cohesive, mixed_modes_follow_benzeggagh_and_kenane) {
  const CohesiveLaw law = mixed();
  for (const double mode : {0.1, 0.35, 0.5, 0.8}) { // of shear in the energy
    const double G = 200.0 + 500.0 * std::pow(mode, 2.1);
    const Vec2 way(std::sqrt(1.0 - mode), std::sqrt(mode));
    const double t0 = 1.0 / std::sqrt((1.0 - mode) / (30e6 * 30e6) + mode / (50e6 * 50e6)),
                 last = 2.0 * G / t0;
    Point point{law};
    point.go(t0 / 1e14 * way);
    EXPECT_NEAR(point.damage, 0.0, 1e-12);
    point.go(0.5 * last * way, 20);
    const double expected = t0 * 0.5 * last / (last - t0 / 1e14);
    EXPECT_NEAR(point.traction().x(), expected * way.x(), 1e-10 * t0);
    EXPECT_NEAR(point.traction().y(), expected * way.y(), 1e-10 * t0);
    point.go(last * way, 20);
    EXPECT_NEAR(point.damage, 1.0, 1e-12);
    EXPECT_NEAR(point.dissipated, G, 1e-10 * G);
    EXPECT_NEAR(point.work, G, 1e-10 * G);
  }
}

TEST(Cohesive, compression_neither_breaks_nor_weakens) {
  Point point{flax()};
  point.go({-3.0 * um, 0.0}, 10);
  EXPECT_EQ(point.damage, 0.0);
  expect_near(point.traction(), -38e12 * 3.0 * um, 0.0);
  point.go({-3.0 * um, 1.0 * um}, 10); // shear alone counts
  const double first = 18e6 / 38e12, last = 2.0 * 28.0 / 18e6;
  EXPECT_NEAR(point.damage, last * (1.0 * um - first) / (1.0 * um * (last - first)), 1e-12);
  expect_near(point.traction(), -38e12 * 3.0 * um, 18e6 * (last - 1.0 * um) / (last - first));
}

TEST(Cohesive, no_path_gives_energy_back) {
  Point point{mixed()};
  unsigned seed = 7;
  const auto random = [&] {
    return static_cast<double>((seed = seed * 1664525u + 1013904223u) >> 8) / (1u << 24);
  };
  double before = 0.0;
  for (int k = 0; k < 500; ++k) {
    point.go({(20.0 * random() - 5.0) * um, (30.0 * random() - 15.0) * um}, 200);
    EXPECT_GE(point.dissipated, before);
    before = point.dissipated;
  }
  EXPECT_EQ(point.damage, 1.0);
}

TEST(Cohesive, without_softening_is_refused) {
  CohesiveLaw law{.stiffness = 1e12, .strength = 30e6, .energy = 200.0}; // ½ t0²/K = 450 J/m²
  try {
    law.complete();
    FAIL() << "was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("450 J/m2 are stored at onset"), std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace cnem::plasticity
