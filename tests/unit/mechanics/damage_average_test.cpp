// Growth of damage averaged over a length of the material.
#include "mechanics/kinematics.hpp"
#include "mechanics/terms/damage_average.hpp"
#include "tests/unit/mechanics/models.hpp"
#include "tests/unit/plasticity/points.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

constexpr double radius = 0.25, spacing = 0.05; // m

struct Averaged {
  DiscreteOperators<2> operators;
  Fields<2> reference, at; ///< [component][node], [component][point] m
  PointState<2> point;
  DamageAverage<2> average;

  static std::vector<plasticity::Material> materials() {
    plasticity::Material with = steel_304L(), without = with;
    with.damage = plasticity::Damage{{.length = radius}, {}};
    without.damage = plasticity::Damage{};
    return {with, without};
  }
  explicit Averaged(Method method = Method::cnem, double step = spacing) : average(materials()) {
    const Cloud<2> cloud = rectangle(1.0, 0.6, step);
    operators = make(method)->rebuild(cloud).mechanics;
    for (const Vec2& x : cloud.position)
      for (std::size_t k = 0; k < 2; ++k) reference[k].push_back(x[static_cast<Eigen::Index>(k)]);
    const auto points = index_of(operators.points);
    for (std::size_t k = 0; k < 2; ++k) {
      at[k].resize(points);
      interpolate<2>(operators, reference[k], at[k], 0, points);
    }
    point = plasticity::test::points_at_rest<2>(points, 300.0);
    point.damage.assign(points, 0.0);
    point.softening.assign(points, 0.0);
    point.initiation_strain.assign(points, 0.0);
    point.plastic_strain.assign(points, 0.3);
  }
  Vec2 place(std::size_t p) const { return {at[0][p], at[1][p]}; }
  void grow(const std::function<double(const Vec2&)>& by) {
    average.list(operators, reference, point);
    grow_on(by);
  }
  void grow_on(const std::function<double(const Vec2&)>& by) { ///< in the next step, on the same reference
    average.begin(point);
    for (std::size_t p = 0; p < point.damage.size(); ++p)
      point.damage[p] = std::min(1.0, point.damage[p] + by(place(p)));
    average.share(point);
  }
};

TEST(DamageAverage, leaves_even_growth_even_whatever_the_cells) {
  for (const Method method : {Method::cnem, Method::triangles}) {
    Averaged a(method);
    a.grow([](const Vec2&) { return 0.125; });
    for (const double d : a.point.damage) EXPECT_NEAR(d, 0.125, 1e-15);
  }
}

// The transform of (1 − r²/R²)² over the plane: of a wave A cos(k x) it leaves 48 J₃(kR)/(kR)³.
TEST(DamageAverage, leaves_of_a_wave_what_its_transform_says_whatever_the_cells) {
  for (const Method method : {Method::cnem, Method::triangles})
    for (const double step : {0.05, 0.03})
      for (const double kR : {1.0, 3.0, 5.0}) {
        Averaged a(method, step);
        const auto wave = [&](const Vec2& x) { return 0.25 * std::cos(kR / radius * (x.x() - 0.5)); };
        a.grow([&](const Vec2& x) { return 0.25 + wave(x); });
        const double left = 48.0 * std::cyl_bessel_j(3.0, kR) / std::pow(kR, 3);
        int inside = 0;
        for (std::size_t p = 0; p < a.point.damage.size(); ++p) {
          const Vec2 x = a.place(p);
          if (std::min({x.x(), 1.0 - x.x(), x.y(), 0.6 - x.y()}) < radius) continue;
          ++inside;
          EXPECT_NEAR(a.point.damage[p], 0.25 + left * wave(x), 0.25 * 0.02) << kR << ", " << step;
        }
        EXPECT_GT(inside, 10);
      }
}

TEST(DamageAverage, of_a_narrow_band_is_as_wide_as_the_length) {
  Averaged a;
  a.grow([](const Vec2& x) { return std::abs(x.x() - 0.5) < 0.6 * spacing ? 0.5 : 0.0; });
  for (std::size_t p = 0; p < a.point.damage.size(); ++p) {
    const double off = std::abs(a.place(p).x() - 0.5);
    if (off > radius + 0.6 * spacing) { EXPECT_EQ(a.point.damage[p], 0.0); }
    if (off < 0.7 * radius) { EXPECT_GT(a.point.damage[p], 0.0); }
    EXPECT_LT(a.point.damage[p], 0.3);
  }
}

TEST(DamageAverage, what_is_broken_neither_takes_nor_gives) {
  Averaged a;
  const auto in = [](const Vec2& x) { return std::abs(x.x() - 0.5) < 1.2 * spacing; };
  for (std::size_t p = 0; p < a.point.damage.size(); ++p)
    if (in(a.place(p))) a.point.damage[p] = 1.0;
  a.grow([](const Vec2&) { return 0.25; });
  for (std::size_t p = 0; p < a.point.damage.size(); ++p) {
    EXPECT_NEAR(a.point.damage[p], in(a.place(p)) ? 1.0 : 0.25, 1e-15);
    EXPECT_EQ(a.point.initiation_strain[p], 0.0);
  }
}

TEST(DamageAverage, what_softens_neither_takes_nor_gives_though_it_is_mixed) {
  Averaged a;
  const auto in = [](const Vec2& x) { return std::abs(x.x() - 0.5) < 1.2 * spacing; };
  for (std::size_t p = 0; p < a.point.damage.size(); ++p)
    if (in(a.place(p))) {
      a.point.damage[p] = 0.7;
      a.point.softening[p] = 0.5;
    }
  a.grow([&](const Vec2& x) { return in(x) ? 0.0 : 0.25; });
  for (std::size_t p = 0; p < a.point.damage.size(); ++p) {
    EXPECT_NEAR(a.point.damage[p], in(a.place(p)) ? 0.7 : 0.25, 1e-15);
    EXPECT_EQ(a.point.initiation_strain[p], 0.0);
  }
}

TEST(DamageAverage, what_breaks_gives_nothing_from_the_next_step_on) {
  Averaged a;
  for (std::size_t p = 0; p < a.point.damage.size(); ++p)
    if (std::abs(a.place(p).x() - 0.5) < 1.2 * spacing) a.point.damage[p] = 0.99;
  a.grow([](const Vec2&) { return 0.02; });
  const Field before = a.point.damage;
  a.grow_on([](const Vec2&) { return 0.25; });
  int broken = 0;
  for (std::size_t p = 0; p < before.size(); ++p) {
    broken += before[p] >= 1.0;
    EXPECT_NEAR(a.point.damage[p], before[p] >= 1.0 ? 1.0 : before[p] + 0.25, 1e-15);
  }
  EXPECT_GT(broken, 10);
}

TEST(DamageAverage, begins_to_soften_where_the_mean_reaches_one) {
  Averaged a;
  for (double& d : a.point.damage) d = 0.9;
  a.grow([](const Vec2& x) { return x.y() > 0.3 ? 0.2 : 0.0; });
  for (std::size_t p = 0; p < a.point.damage.size(); ++p) {
    if (a.place(p).y() > 0.3 + radius) { EXPECT_EQ(a.point.damage[p], 1.0); }
    if (a.place(p).y() < 0.3) { EXPECT_LT(a.point.damage[p], 1.0); } // though cells beside it got there
    EXPECT_EQ(a.point.initiation_strain[p], a.point.damage[p] >= 1.0 ? 0.3 : 0.0);
  }
}

TEST(DamageAverage, does_not_mix_materials_and_leaves_those_without_a_length_alone) {
  Averaged a;
  for (std::size_t p = 0; p < a.point.damage.size(); ++p) a.point.material[p] = a.place(p).x() > 0.5 ? 1 : 0;
  a.grow([](const Vec2& x) { return x.x() > 0.5 ? 0.5 * x.x() : 0.0; });
  for (std::size_t p = 0; p < a.point.damage.size(); ++p)
    EXPECT_EQ(a.point.damage[p], a.point.material[p] == 1 ? 0.5 * a.place(p).x() : 0.0);
}

} // namespace
} // namespace cnem::testing
