// Plies in the explicit step: plane waves, energies of breaking bars, new references and mixed points.
#include "mechanics/ply_mixing.hpp"
#include "plasticity/log_strain.hpp"
#include "tests/degree.hpp"
#include "tests/unit/mechanics/models.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

/// UD-GFRP of paper 000, Table 2, with energies of Lapczyk and Hurtado (2007).
plasticity::Material gfrp(double angle) {
  plasticity::Material m;
  m.name = "gfrp";
  m.density = 1580.0;
  m.ply = plasticity::Orthotropic{.E1 = 34.28e9,
                                  .E2 = 11.57e9,
                                  .nu12 = 0.24244,
                                  .G12 = 2.05e9,
                                  .angle = angle,
                                  .E3 = 11.57e9,
                                  .nu13 = 0.24244};
  return m;
}

plasticity::Failure strengths(plasticity::FailureCriterion criterion) {
  return {.criterion = criterion,
          .Xt = 697.8e6,
          .Xc = 443.76e6,
          .Yt = 89.7216e6,
          .Yc = 148.33e6,
          .S = 33.1e6,
          .eps1t = 0.023,
          .Gft = 12.5e3,
          .Gfc = 12.5e3,
          .Gmt = 1e3,
          .Gmc = 1e3,
          .Gs = 1e3};
}

/// Every node of a regular strip goes as that of the lower side in its column: endless along y.
Ties<2> columns(const Cloud<2>& cloud) {
  std::vector<std::array<NodeIndex, 2>> pairs;
  for (const NodeIndex a : cloud.position.indices())
    for (const NodeIndex b : cloud.position.indices())
      if (a < b && std::abs(cloud.position[a].x() - cloud.position[b].x()) < 1e-9) pairs.push_back({a, b});
  return {pairs, cloud.position, {}};
}

/// Time of a standing wave's first zero over that of a speed.
double period(double angle, bool stress_free, int wave) {
  const double length = 4e-3, h = 5e-5, k = std::numbers::pi / length;
  const plasticity::Material material = gfrp(angle);
  // (D_xx D_xs; D_xs D_ss)/ρ of a normal along x (Christoffel)
  const auto plane = plasticity::plane_stiffness(*material.ply, stress_free);
  const Mat<2> acoustic = (Mat<2>() << plane.D[0][0], plane.D[0][2], plane.D[2][0], plane.D[2][2]).finished();
  const Eigen::SelfAdjointEigenSolver<Mat<2>> christoffel(acoustic / material.density);
  const Vec2 direction = christoffel.eigenvectors().col(wave);
  const double speed = std::sqrt(christoffel.eigenvalues()[wave]);
  Problem<2> model = model_of(rectangle(length, 2.0 * h, h, Lattice::square, 0.0), Method::cnem, material);
  model.plane_stress = stress_free;
  model.ties = columns(model.cloud);
  ExplicitSolver<2> solver =
      start(std::move(model), [&](const Vec2& x) -> Vec2 { return 1e-3 * std::cos(k * x.x()) * direction; });
  const auto part = [&] { // of the wave in all velocities; it swings without losses
    double sum = 0.0;
    const NodeState<2>& node = solver.state().node;
    for (std::size_t i = 0; i < node.size(); ++i)
      sum += node.mass[i] * std::cos(k * node.initial_position[0][i]) *
             (direction.x() * node.velocity[0][i] + direction.y() * node.velocity[1][i]);
    return sum;
  };
  const double dt = solver.stable_step().dt;
  double before = part(), now = before;
  double time = 0.0;
  for (; now > 0.0; time += dt) {
    solver.advance(dt);
    before = now, now = part();
    if (!(time < 10.0 * length / speed)) break;
  }
  const double crossed = time - 0.5 * dt - dt * now / (now - before); // velocities live half a step back
  return crossed * 2.0 * speed / length;
}

TEST(Plies, plane_waves_run_at_the_speeds_of_christoffel) {
  for (const bool stress_free : {true, false})
    for (const double angle : {0.0, 20.0, 45.0, 70.0, 90.0})
      for (const int wave : {0, 1})
        EXPECT_NEAR(period(angle * degree, stress_free, wave), 1.0, 0.01)
            << stress_free << " " << angle << " " << wave;
}

struct Bar {
  double angle;  ///< of the fibres, rad
  double length; ///< m
  int cells;     ///< an even number along it
  Lattice lattice = Lattice::square;
  plasticity::Failure failure;
  double speed = 1.0;    ///< m/s, of its ends from each other
  double opening = 3e-5; ///< m, at which it is over
  double turn = 0.0;     ///< rad, of everything
  Method method = Method::cnem;
  double place = 0.25; ///< cells, of the weakest place from the middle, which is a node of a square lattice
  bool plane_stress = true;
};

struct Broken {
  double energy;   ///< J/m², dissipated by failure
  double links;    ///< J/m², of the penalty of the edge defect, stored and let go
  double residual; ///< J/m², of the work
};

/// A bar of which the ends are drawn apart, a little weaker at one place, everything in the motion that it
/// goes on with.
Broken break_bar(const Bar& bar) {
  const double h = bar.length / bar.cells, width = 4.0 * h;
  plasticity::Material material = gfrp(bar.angle + bar.turn);
  material.failure = bar.failure;
  const Cloud<2> own =
      rectangle(bar.length, width, h, bar.lattice, bar.lattice == Lattice::square ? 0.0 : 0.1);
  Cloud<2> cloud = own;
  const Mat<2> R = Eigen::Rotation2Dd(bar.turn).toRotationMatrix();
  for (Vec2& x : cloud.position) x = R * x;
  Problem<2> model = model_of(cloud, bar.method, material);
  model.plane_stress = bar.plane_stress;
  for (const NodeIndex i : own.position.indices()) {
    const double from = (own.position[i].x() - 0.5 * bar.length - bar.place * h) / (2.0 * h);
    model.strength.push_back(1.0 - 0.05 * std::exp(-from * from));
  }
  const Vec2 way = R.col(0);
  const auto end = [&](const char* name, double share, PieceIndex piece) {
    return Support<2>{
        name, Support<2>::Kind::velocity, way, TimeTable(share * bar.speed), nodes_on(own, piece), {}};
  };
  model.supports = Supports<2>({end("left", -0.5, 3_piece), end("right", 0.5, 1_piece)},
                               static_cast<std::size_t>(cloud.nodes()));
  const double rate = bar.speed / bar.length;
  const plasticity::PlyConstants elastic = plasticity::ply_constants(*material.ply, bar.plane_stress);
  const double across = -elastic.nu12 * (bar.angle == 0.0 ? 1.0 : elastic.E2 / elastic.E1);
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2& x) -> Vec2 {
    const Vec2 X = R.transpose() * x;
    return rate * (X.x() - 0.5 * bar.length) * way + across * rate * (X.y() - 0.5 * width) * R.col(1);
  });
  while (solver.state().time * bar.speed < bar.opening) {
    const double dt = solver.stable_step().dt;
    for (int n = 0; n < 10; ++n) solver.advance(dt);
  }
  const EnergyLedger ledger = solver.ledger();
  return {ledger["failure"] / width, (ledger["stabilisation"] + ledger["penalty_release"]) / width,
          ledger.residual() / width};
}

Bar matrix_bar(int cells, Lattice lattice) {
  return {.angle = 90.0 * degree,
          .length = 1.2e-3,
          .cells = cells,
          .lattice = lattice,
          .failure = strengths(plasticity::FailureCriterion::hashin),
          .speed = 2.0,
          .opening = 4e-5};
}

TEST(Plies, bars_take_the_energy_of_the_mode_whatever_their_cells) {
  using plasticity::FailureCriterion;
  for (const int cells : {10, 20, 40})
    for (const FailureCriterion criterion :
         {FailureCriterion::max_stress, FailureCriterion::hashin, FailureCriterion::larc02}) {
      Bar bar = matrix_bar(cells, Lattice::square);
      bar.failure.criterion = criterion;
      const Broken broken = break_bar(bar);
      EXPECT_NEAR(broken.energy, 1e3, 15.0) << cells;
      EXPECT_LT(broken.links, 15.0) << cells;
      EXPECT_LT(std::abs(broken.residual), 1e-3 * broken.energy) << cells; // the ledger closes
    }
  for (const double place : {0.1, 0.5}) {
    Bar bar = matrix_bar(20, Lattice::square);
    bar.place = place;
    EXPECT_NEAR(break_bar(bar).energy, 1e3, 15.0) << place;
    bar.plane_stress = false;
    EXPECT_NEAR(break_bar(bar).energy, 1e3, 15.0) << place;
  }
  for (const int cells : {10, 20, 40}) { // three cells share the crack for a while, then two
    Bar bar = matrix_bar(cells, Lattice::square);
    bar.place = 0.0;
    EXPECT_NEAR(break_bar(bar).energy, 1e3, 50.0) << cells;
  }
  for (const int cells : {10, 20, 40}) { // all four columns of cells that see the crack have to break
    Bar bar = matrix_bar(cells, Lattice::hexagonal);
    bar.opening = 6e-5;
    bar.failure.criterion = FailureCriterion::max_stress;
    EXPECT_NEAR(break_bar(bar).energy, 1e3, 50.0) << cells;
    bar.failure.criterion = FailureCriterion::hashin; // 0.93 to 0.98
    EXPECT_NEAR(break_bar(bar).energy, 1e3, 80.0) << cells;
  }
}

TEST(Plies, fibres_take_their_energy_too) {
  for (const int cells : {10, 20, 40}) {
    Bar bar = matrix_bar(cells, Lattice::square);
    bar.angle = 0.0, bar.speed = 4.0, bar.opening = 7e-5;
    EXPECT_NEAR(break_bar(bar).energy, 12.5e3, 0.015 * 12.5e3) << cells;
  }
}

/// A row of triangles, or of Gauss points in them, takes what two rows of cells do.
TEST(Plies, other_methods_take_the_energy_of_the_mode) {
  for (const int cells : {10, 20}) {
    Bar bar = matrix_bar(cells, Lattice::square);
    bar.method = Method::triangles;
    EXPECT_NEAR(break_bar(bar).energy, 1e3, 15.0) << cells;
    bar.method = Method::efg;
    EXPECT_NEAR(break_bar(bar).energy, 1e3, 80.0) << cells;
    bar.method = Method::mls;
    EXPECT_NEAR(break_bar(bar).energy, 1e3, 15.0) << cells;
  }
}

TEST(Plies, sudden_loss_takes_less_the_finer_the_cells) {
  double last = 0.0;
  for (const int cells : {20, 40, 80}) { // long: it stores more than it could lose
    Bar bar = matrix_bar(cells, Lattice::square);
    bar.length = 4.8e-3;
    bar.failure.degradation = plasticity::Degradation::sudden;
    bar.opening = 4.0e-5;
    const double energy = break_bar(bar).energy;
    if (last > 0.0) { EXPECT_NEAR(energy / last, 0.5, 0.01) << cells; }
    last = energy;
  }
}

TEST(Plies, turned_bars_break_as_those_that_are_not) {
  Bar bar = matrix_bar(10, Lattice::square);
  bar.angle = 60.0 * degree, bar.opening = 1.2e-5;
  const Broken own = break_bar(bar);
  bar.turn = 33.0 * degree;
  const Broken turned = break_bar(bar);
  EXPECT_GT(own.energy, 100.0);
  EXPECT_NEAR(turned.energy, own.energy, 5e-3 * own.energy); // which of equal cells break first is rounding
}

TEST(Plies, mixed_points_keep_turns_and_stretches) {
  // two halves of the same stretch, turned by angles on both sides of π: the mean is in the middle of them
  PointState<2> point;
  point.fibrous.switch_on(true);
  point.oriented.switch_on(true);
  for (FieldTable* table : {&point.table, &point.oriented, &point.fibrous}) table->rest(2);
  const Mat<2> U = (Mat<2>() << 1.2, 0.1, 0.1, 0.9).finished();
  const double angles[] = {179.0 * degree, -177.0 * degree};
  for (std::size_t p : {0u, 1u}) {
    const Mat<2> F = Eigen::Rotation2Dd(angles[p]).toRotationMatrix() * U;
    for (std::size_t k = 0; k < 4; ++k) point.earlier_deformation[k][p] = F(as<int>(k / 2), as<int>(k % 2));
  }
  PointRows parcels;
  parcels.begin = {0, 2};
  parcels.from = {PointIndex{0}, PointIndex{1}};
  parcels.weight = {1.0, 1.0};
  const auto mixed = mixed_plies<2>(parcels, Field(2, 3.0), {gfrp(0.2)}, true, point);
  ASSERT_EQ(mixed.size(), 1u);
  const Mat<2> wanted = Eigen::Rotation2Dd(181.0 * degree).toRotationMatrix() * U;
  EXPECT_LT((mixed[0].second - wanted).norm(), 1e-12);
}

TEST(Plies, the_gap_of_broken_matter_does_not_load_sound_matter_that_it_is_mixed_with) {
  // a point whose matrix is broken and open by half, and a sound one under a small pull across the fibres
  PointState<2> point;
  for (FieldTable* table : {&point.oriented, &point.fibrous, &point.failing}) table->switch_on(true);
  for (FieldTable* table : {&point.table, &point.oriented, &point.fibrous, &point.failing}) table->rest(2);
  const double across[] = {std::log(1.5), 1e-3};
  for (std::size_t p : {0u, 1u}) {
    const double F[] = {1.0, 0.0, 0.0, std::exp(across[p])};
    for (std::size_t k = 0; k < 4; ++k) point.earlier_deformation[k][p] = F[k];
  }
  point.ply_left[plasticity::matrix_tension][0] = 1e-4;
  PointRows parcels;
  parcels.begin = {0, 2};
  parcels.from = {PointIndex{0}, PointIndex{1}};
  parcels.weight = {1.0, 1.0};
  const auto mixed = mixed_plies<2>(parcels, Field(2, 3.0), {gfrp(0.0)}, true, point);
  ASSERT_EQ(mixed.size(), 1u);
  const double strain = std::log(mixed[0].second(1, 1));
  EXPECT_NEAR(strain, (1e-4 * across[0] + across[1]) / (1.0 + 1e-4), 1e-12);
  // ½ E2 (mean of what is left) ε² is less than the mean of what the two stored
  EXPECT_LT(0.5 * (1.0 + 1e-4) * strain * strain,
            0.5 * (1e-4 * across[0] * across[0] + across[1] * across[1]));
}

/// Debris that is sheared on and on: the stretches stay those of its change of volume.
TEST(Plies, that_are_broken_let_go_of_their_shear) {
  PointState<2> point;
  for (FieldTable* table : {&point.oriented, &point.fibrous, &point.flowing, &point.damaged})
    table->switch_on(true);
  for (FieldTable* table : {&point.table, &point.oriented, &point.fibrous, &point.flowing, &point.damaged})
    table->rest(2);
  const plasticity::Material ply = gfrp(0.3);
  const Mat<2> F = (Mat<2>() << 0.9, 4.0, -0.2, 0.5).finished();
  const auto earlier = [&](std::size_t p) {
    const auto& f = point.earlier_deformation;
    return (Mat<2>() << f[0][p], f[1][p], f[2][p], f[3][p]).finished();
  };
  const Vec2 fibre(std::cos(0.3), std::sin(0.3));
  for (const std::size_t p : {0U, 1U}) {
    for (std::size_t k = 0; k < 4; ++k) point.earlier_deformation[k][p] = F(as<int>(k / 2), as<int>(k % 2));
    point.fibre_angle[p] = std::atan2((F * fibre).y(), (F * fibre).x());
    for (std::size_t k = 0; k < 3; ++k) point.ply_flow[k][p] = 0.1 * static_cast<double>(k + 1);
  }
  point.softening[0] = 1.0, point.softening[1] = 0.999;
  // ½ ln C − E^p in the axes of the ply
  const auto elastic = [&](std::size_t p) {
    const Mat<2> C = earlier(p).transpose() * earlier(p);
    const auto twice = plasticity::logarithm<2>({C(0, 0), C(1, 1), 1.0, C(0, 1)});
    const Mat<2> strain = 0.5 * (Mat<2>() << twice[0], twice[3], twice[3], twice[1]).finished();
    const Mat<2> turn = Eigen::Rotation2Dd(0.3).toRotationMatrix();
    const Mat<2> own = turn.transpose() * strain * turn;
    return std::array{own(0, 0) - point.ply_flow[0][p], own(1, 1) - point.ply_flow[1][p],
                      2.0 * own(0, 1) - point.ply_flow[2][p]};
  };
  const auto before = elastic(0);
  let_go_of_shear<2>({ply}, point);
  EXPECT_EQ(earlier(1), F);
  EXPECT_NEAR(earlier(0).determinant(), F.determinant(), 1e-14);
  EXPECT_LT((earlier(0).transpose() * earlier(0) - F.determinant() * Mat<2>::Identity()).norm(), 1e-14);
  EXPECT_LT(((earlier(0) * fibre).normalized() - (F * fibre).normalized()).norm(), 1e-14);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(elastic(0)[k], before[k], 1e-13) << k;
  EXPECT_NEAR(point.inverse_plastic_cauchy_green[0][0], F.determinant(), 1e-14);
  EXPECT_NEAR(point.inverse_plastic_cauchy_green[3][0], 0.0, 1e-14);
}

} // namespace
} // namespace cnem::testing
