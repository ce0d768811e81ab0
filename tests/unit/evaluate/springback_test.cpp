// What bodies do when they are let go: bars, beams and rings with known answers.
#include "core/index.hpp"
#include "evaluate/springback.hpp"

#include "tests/unit/mechanics/models.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace cnem {

using namespace testing::literals;
namespace {

using testing::Method;

/// A cloud whose points have a stretch and a Cauchy stress of our choice.
struct Loaded {
  Cloud<2> cloud;
  Approximation<2> approximation;
  PointState<2> point;
  Fields<2> position;
  Field mass;
  std::vector<plasticity::Material> materials{testing::steel()};
  Supports<2> supports;
  double stabilisation = 0.05;
  Field cold; ///< [node] K; empty: temperatures stay

  Loaded(Cloud<2> given, Method method, Space space = Space::plane)
      : cloud(std::move(given)), approximation(testing::make(method, space)->rebuild(cloud)),
        supports({}, index_of(cloud.nodes())) {
    const auto points = index_of(approximation.mechanics.points);
    resize_all(point.deformation, points, 0.0);
    for (const std::size_t k : {0U, 3U, 4U}) point.deformation[k].assign(points, 1.0);
    resize_all(point.piola, points, 0.0);
    point.material.assign(points, 0);
    resize_all(position, index_of(cloud.nodes()));
    for (std::size_t i = 0; i < position[0].size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) position[k][i] = cloud.position[i][static_cast<Eigen::Index>(k)];
    mass = approximation.node_volume;
  }

  /// The same deformation everywhere.
  void deform(const Mat2& F, double out_of_plane = 1.0) {
    for (std::size_t p = 0; p < point.material.size(); ++p) {
      for (std::size_t k = 0; k < 4; ++k)
        point.deformation[k][p] = F(static_cast<Eigen::Index>(k / 2), static_cast<Eigen::Index>(k % 2));
      point.deformation[4][p] = out_of_plane;
    }
    for (std::size_t i = 0; i < position[0].size(); ++i) {
      const Vec2 x = F * cloud.position[i];
      position[0][i] = x.x();
      position[1][i] = x.y();
    }
  }
  /// P = J σ F⁻ᵀ.
  void stress(std::size_t p, const Mat2& sigma, double hoop = 0.0) {
    Mat2 F;
    for (std::size_t k = 0; k < 4; ++k)
      F(static_cast<Eigen::Index>(k / 2), static_cast<Eigen::Index>(k % 2)) = point.deformation[k][p];
    const double J = F.determinant() * point.deformation[4][p];
    const Mat2 P = J * sigma * F.inverse().transpose();
    for (std::size_t k = 0; k < 4; ++k)
      point.piola[k][p] = P(static_cast<Eigen::Index>(k / 2), static_cast<Eigen::Index>(k % 2));
    point.piola[4][p] = J * hoop / point.deformation[4][p];
  }
  /// Hotter than `end` by rise(x), with steel's expansion.
  template<class Rise> void heat(double end, const Rise& rise) {
    materials[0].expansion = 1.2e-5;
    cold.assign(mass.size(), end);
    Field hot(mass.size());
    for (std::size_t i = 0; i < hot.size(); ++i) hot[i] = end + rise(cloud.position[i]);
    point.temperature.assign(point.material.size(), 0.0);
    if (approximation.mechanics.nodal)
      point.temperature = hot;
    else
      interpolate<2>(approximation.mechanics, hot, point.temperature, 0, point.material.size());
  }
  void stress_everywhere(const Mat2& sigma) {
    for (std::size_t p = 0; p < point.material.size(); ++p) stress(p, sigma);
  }
  Vec2 centroid_of_point(std::size_t p) const { // with F = 1
    Vec2 x = Vec2::Zero();
    const DiscreteOperators<2>& op = approximation.mechanics;
    if (op.nodal) return cloud.position[p];
    double count = 0.0;
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e, count += 1.0)
      x += cloud.position[op.node[e]];
    return x / count;
  }
  Springback unload() const {
    return springback({approximation, point, position, mass, materials, supports, stabilisation,
                       cold.empty() ? nullptr : &cold});
  }
  Vec2 at(const Springback& s, std::size_t i) const { return {s.displacement[0][i], s.displacement[1][i]}; }
  Vec2 present(std::size_t i) const { return {position[0][i], position[1][i]}; }
};

double largest(const Fields<2>& f) {
  double most = 0.0;
  for (std::size_t i = 0; i < f[0].size(); ++i) most = std::max(most, std::hypot(f[0][i], f[1][i]));
  return most;
}

/// Every pair of nodes of a body moves as the strain says, up to the turn of the body.
void expect_strain(const Loaded& loaded, const Springback& s, const Mat2& strain, std::int32_t body = 0) {
  const auto first = static_cast<std::size_t>(std::find(s.body.begin(), s.body.end(), body) - s.body.begin());
  for (std::size_t i = first + 1; i < loaded.mass.size(); ++i) {
    if (s.body[i] != body) continue;
    const Vec2 x = loaded.present(i) - loaded.present(first);
    EXPECT_NEAR(x.dot(loaded.at(s, i) - loaded.at(s, first)), x.dot(strain * x), 1e-12 * x.squaredNorm());
  }
}

/// Linear and angular momentum of the displacement, weighted with mass.
void expect_no_mean_motion(const Loaded& loaded, const Springback& s) {
  for (std::int32_t body = 0; body < s.bodies; ++body) {
    Vec2 linear = Vec2::Zero();
    double angular = 0.0, scale = 0.0;
    for (std::size_t i = 0; i < loaded.mass.size(); ++i) {
      if (s.body[i] != body) continue;
      linear += loaded.mass[i] * loaded.at(s, i);
      angular += loaded.mass[i] * cross(loaded.present(i), loaded.at(s, i));
      scale += loaded.mass[i] * loaded.at(s, i).norm();
    }
    EXPECT_LT(linear.norm(), 1e-12 * scale);
    EXPECT_LT(std::abs(angular), 1e-11 * scale);
  }
}

class SpringbackOf : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, SpringbackOf, ::testing::Values(Method::cnem, Method::triangles),
                         [](const auto& each) {
                           return std::string(each.param == Method::cnem ? "cnem" : "triangles");
                         });

// The bar returns by the strain of its stress, in plane strain (1 − ν²)σ/E along and −ν(1 + ν)σ/E across,
// about its centre, however it was stretched and turned before.
TEST_P(SpringbackOf, bar_returns_by_stress_over_modulus) {
  Loaded bar(testing::rectangle(4.0, 1.0, 0.2), GetParam());
  const double angle = 0.5, sigma = 300e6;
  const Mat2 turn = Eigen::Rotation2D<double>(angle).toRotationMatrix();
  bar.deform(turn * Mat2(Vec2(1.3, 0.8).asDiagonal()));
  bar.stress_everywhere(turn * Mat2(Vec2(sigma, 0.0).asDiagonal()) * turn.transpose());
  const Springback s = bar.unload();
  const plasticity::Elasticity& e = bar.materials[0].elasticity;
  const double along = -(1.0 - e.poisson * e.poisson) * sigma / e.young,
               across = e.poisson * (1.0 + e.poisson) * sigma / e.young;
  const Mat2 strain = turn * Mat2(Vec2(along, across).asDiagonal()) * turn.transpose();
  expect_strain(bar, s, strain);
  expect_no_mean_motion(bar, s);
  EXPECT_EQ(s.bodies, 1);
  EXPECT_LT(s.residual, 1e-9);
  // ½ σ ε per present volume
  EXPECT_NEAR(s.energy / (0.5 * sigma * -along * 4.0 * 1.3 * 0.8), 1.0, 1e-9);
}

TEST_P(SpringbackOf, planes_of_symmetry_stay_and_other_supports_let_go) {
  Loaded bar(testing::rectangle(4.0, 1.0, 0.2), GetParam());
  bar.supports = Supports<2>(
      {{"symmetry", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, testing::nodes_on(bar.cloud, 3_piece)},
       {"grip", Support<2>::Kind::velocity, Vec2(1, 0), TimeTable(2.0),
        testing::nodes_on(bar.cloud, 1_piece)}},
      index_of(bar.cloud.nodes()));
  bar.stress_everywhere(Vec2(300e6, 0.0).asDiagonal());
  const Springback s = bar.unload();
  const plasticity::Elasticity& e = bar.materials[0].elasticity;
  const double along = -(1.0 - e.poisson * e.poisson) * 300e6 / e.young;
  for (std::size_t i = 0; i < bar.mass.size(); ++i)
    EXPECT_NEAR(s.displacement[0][i], along * bar.present(i).x(), 1e-9 * std::abs(along) * 4.0);
}

TEST_P(SpringbackOf, uniform_pressure_and_shear_are_linear_too) {
  Loaded block(testing::rectangle(2.0, 1.0, 0.2), GetParam());
  Mat2 sigma;
  sigma << -120e6, 40e6, 40e6, 70e6;
  block.stress_everywhere(sigma);
  const Springback s = block.unload();
  const plasticity::Elasticity& e = block.materials[0].elasticity;
  const Mat2 strain = -(sigma - e.poisson * sigma.trace() * Mat2::Identity()) * (1.0 + e.poisson) / e.young;
  expect_strain(block, s, strain);
}

// A beam bent past its yield moment: σ = −clamp(E'κy, ±σy). Let go, its curvature changes by M/(E'I), E' =
// E/(1 − ν²).
TEST(Springback, bent_beam_opens_by_its_moment) {
  const double length = 8.0, height = 0.5, yield = 250e6;
  Loaded beam(testing::rectangle(length, height, 0.04), Method::cnem);
  const plasticity::Elasticity& e = beam.materials[0].elasticity;
  const double modulus = e.young / (1.0 - e.poisson * e.poisson);
  const double curvature = 3.0 * yield / modulus / (0.5 * height); // yields where |y| > h/6
  double moment = 0.0;                                             // of what the points carry, per length
  for (std::size_t p = 0; p < beam.point.material.size(); ++p) {
    const double y = beam.cloud.position[p].y() - 0.5 * height;
    const double sigma = std::clamp(modulus * curvature * y, -yield, yield);
    beam.stress(p, Vec2(sigma, 0.0).asDiagonal());
    moment += sigma * y * beam.approximation.mechanics.volume[p] / length;
  }
  const double exact = yield * height * height / 4.0 * (1.0 - 1.0 / 27.0); // M_p (1 − (1/3)²/3)
  EXPECT_NEAR(moment / exact, 1.0, 0.01);
  const Springback s = beam.unload();
  // least-squares parabola through the deflections of the middle half
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < beam.mass.size(); ++i) {
    const double x = beam.present(i).x() - 0.5 * length;
    if (std::abs(x) > 0.25 * length || std::abs(beam.present(i).y() - 0.5 * height) > 0.1) continue;
    const Eigen::Vector3d row(1.0, x, x * x);
    normal += row * row.transpose();
    right += row * s.displacement[1][i];
  }
  const double opened = 2.0 * normal.ldlt().solve(right)[2]; // d²v/dx²
  // fibres at y > 0 were in tension: v'' = −κ while it was bent, and opening adds +M/(E'I)
  EXPECT_NEAR(opened / (exact / (modulus * height * height * height / 12.0)), 1.0, 0.01);
  EXPECT_LT(s.residual, 1e-8);
}

// What a body keeps after it was let go, and cooled, is in equilibrium with itself: letting go once more
// moves nothing, and no section carries anything in the mean.
TEST_P(SpringbackOf, stress_that_stays_is_in_equilibrium_with_itself) {
  Loaded block(testing::rectangle(2.0, 1.0, 0.1), GetParam());
  block.stabilisation = 0.0; // its forces are no stress
  block.heat(293.0, [](const Vec2& x) { return 100.0 * std::sin(4.0 * x.x() + x.y()); });
  for (std::size_t p = 0; p < block.point.material.size(); ++p) {
    const Vec2 x = block.centroid_of_point(p);
    Mat2 sigma;
    sigma << std::sin(5.0 * x.y()), 0.3 * x.x(), 0.3 * x.x(), std::cos(3.0 * x.x());
    block.stress(p, 200e6 * sigma);
  }
  const Springback first = block.unload();
  const DiscreteOperators<2>& op = block.approximation.mechanics;
  const plasticity::Material& steel = block.materials[0];
  const plasticity::Elasticity& e = steel.elasticity;
  double left = 0.0;
  Mat2 resultant = Mat2::Zero();
  for (std::size_t p = 0; p < block.point.material.size(); ++p) {
    Mat2 g = Mat2::Zero();
    for (auto k = index_of(op.row_begin[p]); k < index_of(op.row_begin[p + 1]); ++k)
      g += block.at(first, index_of(op.node[k])) * Vec2(op.gradient[0][k], op.gradient[1][k]).transpose();
    const Mat2 strain = 0.5 * (g + g.transpose());
    const double volumetric = e.lambda() * strain.trace() +
                              3.0 * e.kappa() * steel.expansion * (block.point.temperature[p] - 293.0);
    const Mat2 added = volumetric * Mat2::Identity() + 2.0 * e.mu() * strain;
    const double change[] = {added(0, 0), added(1, 1), volumetric, added(0, 1)};
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(first.stress_change[c][p], change[c], 1e-9 * 200e6);
    Mat2 stays;
    for (Eigen::Index a = 0; a < 2; ++a)
      for (Eigen::Index b = 0; b < 2; ++b) {
        double& piola = block.point.piola[index_of(static_cast<std::int32_t>(2 * a + b))][p];
        piola += added(a, b);
        stays(a, b) = piola;
      }
    left = std::max(left, std::abs(stays(0, 0)));
    resultant += op.volume[p] * stays;
  }
  EXPECT_GT(left, 10e6); // a residual stress is there
  EXPECT_LT(resultant.norm(), 1e-9 * left * 2.0);
  block.cold.clear();
  EXPECT_LT(largest(block.unload().displacement), 1e-9 * largest(first.displacement));
}

TEST(Springback, each_body_returns_for_itself) {
  Cloud<2> cloud = testing::rectangle(2.0, 1.0, 0.1);
  const Cloud<2> other = testing::rectangle(1.0, 1.0, 0.1, testing::Lattice::hexagonal, 0.1, 7);
  const auto first = cloud.nodes();
  for (const Vec2& x : other.position) cloud.position.push_back(x + Vec2(2.5, 0.0));
  for (Facet<2> facet : other.facets) {
    for (NodeIndex& node : facet.node) node = as<NodeIndex>(as<int>(node) + first);
    cloud.facets.push_back(facet);
  }
  Loaded two(std::move(cloud), Method::cnem);
  two.materials.push_back(testing::steel());
  two.materials.back().elasticity = {70e9, 0.3};
  for (std::size_t p = 0; p < two.point.material.size(); ++p) {
    const bool second = two.cloud.position[p].x() > 2.2;
    two.point.material[p] = second;
    two.stress(p, Vec2(0.0, second ? 70e6 : 210e6).asDiagonal());
  }
  const Springback s = two.unload();
  EXPECT_EQ(s.bodies, 2);
  EXPECT_LT(s.residual, 1e-9);
  for (std::size_t i = 0; i < two.mass.size(); ++i) {
    const bool second = two.cloud.position[i].x() > 2.2;
    EXPECT_EQ(s.body[i], second ? 1 : 0);
  }
  for (std::int32_t body = 0; body < 2; ++body) {
    const double nu = two.materials[index_of(body)].elasticity.poisson;
    expect_strain(two, s, 1e-3 * Mat2(Vec2(nu * (1.0 + nu), -(1.0 - nu * nu)).asDiagonal()), body);
  }
  expect_no_mean_motion(two, s);
}

TEST(Springback, round_bar_returns_along_its_axis_and_grows_in_radius) {
  Loaded bar(testing::rectangle(0.5, 2.0, 0.1), Method::cnem, Space::revolution);
  bar.supports = Supports<2>(
      {{"axis", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, testing::nodes_on(bar.cloud, 3_piece)}},
      index_of(bar.cloud.nodes()));
  bar.deform(Vec2(0.9, 1.2).asDiagonal(), 0.9);
  bar.stress_everywhere(Vec2(0.0, 210e6).asDiagonal());
  const Springback s = bar.unload();
  for (std::size_t i = 0; i < bar.mass.size(); ++i) {
    EXPECT_NEAR(s.displacement[0][i], 0.33e-3 * bar.present(i).x(), 1e-9);
    EXPECT_NEAR(s.displacement[1][i], -1e-3 * (bar.present(i).y() - 1.2), 1e-6);
  }
}

// Heat that leaves a body which is free to contract everywhere alike leaves no stress in the plane; out of it
// the strain is held.
TEST_P(SpringbackOf, uniform_cooling_contracts_and_leaves_no_stress_in_the_plane) {
  Loaded block(testing::rectangle(2.0, 1.0, 0.2), GetParam());
  block.deform(Vec2(1.1, 0.9).asDiagonal());
  block.heat(293.0, [](const Vec2&) { return 400.0; });
  const Springback s = block.unload();
  const plasticity::Material& steel = block.materials[0];
  const double contraction = 400.0 * steel.expansion, poisson = steel.elasticity.poisson;
  expect_strain(block, s, -(1.0 + poisson) * contraction * Mat2::Identity());
  expect_no_mean_motion(block, s);
  const double held = steel.elasticity.young * contraction;
  for (std::size_t p = 0; p < block.point.material.size(); ++p) {
    for (const std::size_t c : {0U, 1U, 3U}) EXPECT_LT(std::abs(s.stress_change[c][p]), 1e-9 * held);
    EXPECT_NEAR(s.stress_change[2][p], held, 1e-9 * held);
  }
}

TEST(Springback, round_bar_cools_without_stress) {
  Loaded bar(testing::rectangle(0.5, 2.0, 0.1), Method::cnem, Space::revolution);
  bar.supports = Supports<2>(
      {{"axis", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, testing::nodes_on(bar.cloud, 3_piece)}},
      index_of(bar.cloud.nodes()));
  bar.heat(293.0, [](const Vec2&) { return 100.0; });
  const Springback s = bar.unload();
  for (std::size_t i = 0; i < bar.mass.size(); ++i)
    EXPECT_NEAR(s.displacement[0][i], -1.2e-3 * bar.present(i).x(), 1e-12);
  for (const Field& change : s.stress_change)
    for (const double stress : change) EXPECT_LT(std::abs(stress), 1e-9 * 210e9 * 1.2e-3);
}

// A strip that is hotter at both faces, by A ξ² with ξ = ±1 there, and free of stress while it is: cooled,
// its middle is in plane strain with σ_xx = E α A (ξ² − 1/3)/(1 − ν), which has neither resultant nor moment,
// and σ_zz = ν σ_xx + E α A ξ².
TEST(Springback, strip_hotter_at_its_faces_keeps_the_known_stress) {
  const double length = 4.0, height = 1.0, hot = 300.0;
  double error[2] = {};
  for (const int fine : {0, 1}) {
    Loaded strip(testing::rectangle(length, height, fine ? 0.04 : 0.08), Method::cnem);
    const auto xi = [&](const Vec2& x) { return 2.0 * x.y() / height - 1.0; };
    strip.heat(293.0, [&](const Vec2& x) { return hot * xi(x) * xi(x); });
    const Springback s = strip.unload();
    const plasticity::Material& steel = strip.materials[0];
    const double poisson = steel.elasticity.poisson, held = steel.elasticity.young * steel.expansion * hot;
    double area = 0.0, force = 0.0, moment = 0.0, square = 0.0;
    for (std::size_t p = 0; p < strip.point.material.size(); ++p) {
      const Vec2& x = strip.cloud.position[p];
      if (std::abs(x.x() - 0.5 * length) > 0.2 * length) continue;
      const double y = xi(x), along = (y * y - 1.0 / 3.0) / (1.0 - poisson);
      const double known[] = {along, 0.0, poisson * along + y * y, 0.0};
      area += strip.mass[p];
      force += strip.mass[p] * s.stress_change[0][p] / held;
      moment += strip.mass[p] * s.stress_change[0][p] / held * y;
      for (std::size_t c = 0; c < 4; ++c)
        square += strip.mass[p] * std::pow(s.stress_change[c][p] / held - known[c], 2);
    }
    error[fine] = std::sqrt(square / area);
    EXPECT_LT(std::abs(force), 0.005 * area); // nodes of a window have no straight ends
    EXPECT_LT(std::abs(moment), 0.005 * area);
  }
  EXPECT_LT(error[0], 0.08);
  EXPECT_LT(error[1], 0.25 * error[0]);
}

} // namespace
} // namespace cnem
