// The exchange of volume between flowing neighbours: what it conserves, what it leaves alone, what it
// smooths.
#include "mechanics/terms/pressure_exchange.hpp"
#include "models.hpp"
#include "plasticity/return_map.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

/// A stretched block of flowing cells with given pressures, without a solver around it.
struct Block {
  Cloud<2> cloud;
  Approximation<2> approximation;
  PointState<2> point;
  ColumnStress<2> stress;
  Field reference;
  plasticity::Material material = steel_304L();
  double kappa = steel_304L().elasticity.kappa();

  explicit Block(const std::function<double(const Vec2&, std::size_t)>& pressure, bool revolution = false) {
    cloud = rectangle(2e-3, 1e-3, 1e-4, Lattice::hexagonal, 0.2);
    approximation = make(Method::cnem, revolution ? Space::revolution : Space::plane)->rebuild(cloud);
    const std::size_t n = cloud.position.size();
    Fields<2> position;
    resize_all(position, n);
    resize_all(point.deformation, n, 0.0);
    resize_all(point.inverse_plastic_cauchy_green, n, 0.0);
    resize_all(point.piola, n, 0.0);
    for (Field* field : {&point.plastic_strain, &point.plastic_rate, &point.equivalent_stress,
                         &point.pressure, &point.stored_energy, &point.plastic_work, &point.dissipation,
                         &point.temperature, &point.stress_free, &point.strength})
      field->assign(n, 0.0);
    point.traded.switch_on(true);
    point.traded.rest(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < 2; ++k) position[k][i] = cloud.position[i][Eigen::Index(k)];
      const double F[5] = {1.2, 0.3, -0.1, 0.9, 1.0};
      for (std::size_t c = 0; c < 5; ++c) point.deformation[c][i] = F[c];
      // b_e = e^{−2p/3κ} (1 + a little shear), pulled back by the same F
      const double p = pressure(cloud.position[i], i), s = std::exp(-2.0 * p / (3.0 * kappa));
      const double det = F[0] * F[3] - F[1] * F[2];
      const double G[4] = {F[3] / det, -F[1] / det, -F[2] / det, F[0] / det};
      const double shear = 1e-3, b[3] = {s * std::exp(shear), s * std::exp(-shear), s};
      point.inverse_plastic_cauchy_green[0][i] = G[0] * G[0] * b[0] + G[1] * G[1] * b[1];
      point.inverse_plastic_cauchy_green[1][i] = G[2] * G[2] * b[0] + G[3] * G[3] * b[1];
      point.inverse_plastic_cauchy_green[3][i] = G[0] * G[2] * b[0] + G[1] * G[3] * b[1];
      point.inverse_plastic_cauchy_green[2][i] = b[2];
      point.temperature[i] = 296.0;
      point.strength[i] = 1.0;
      point.plastic_work[i] = 3e7;
    }
    reference = side_by_side<2>(position);
    update();
    for (std::size_t i = 0; i < n; ++i) point.plastic_rate[i] = 1e4;
    copy_stress_columns<2>(point.piola, stress);
  }
  /// Stress and energy anew from F and C_p⁻¹, without flow.
  void update() {
    ASSERT_EQ(plasticity::update_stress(material, plasticity::stress_points(point), 0,
                                        std::ptrdiff_t(point.size()), 0.0),
              -1);
  }
  std::unique_ptr<PressureExchange<2>> exchange(double alpha) const {
    auto made = std::make_unique<PressureExchange<2>>(alpha);
    made->reset(Field(point.size(), kappa));
    return made;
  }
  PressureExchange<2>::Change apply(PressureExchange<2>& exchange, double dt = 1e-8) {
    const std::vector<LevelRange> all{{0, point.size(), 0, false}};
    const DuePoints due{all, 0, true, dt};
    exchange.remember(point.pressure, due);
    return exchange.apply(approximation.mechanics, approximation.links, reference, due, point, stress);
  }
  double total(const Field& density) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < point.size(); ++i)
      sum += approximation.mechanics.volume[i] * point.stress_free[i] * density[i];
    return sum;
  }
};

double noise(const Vec2&, std::size_t i) { return 2e8 * (double(i * 2654435761U % 1000) / 500.0 - 1.0); }

// As that of a flat cell between skin and side in space is, of a few nodes that are very near: taken over the
// distance to all others it would make more of the jump in each step.
TEST(ExchangeBeside, a_gradient_that_says_nothing_as_far_away_as_its_neighbours_does_not_grow) {
  Block block(noise);
  DiscreteOperators<2>& operators = block.approximation.mechanics;
  const std::size_t steep = block.point.size() / 2;
  for (auto e = operators.row_begin[steep]; e < operators.row_begin[steep + 1]; ++e)
    for (Field& component : operators.gradient) component[static_cast<std::size_t>(e)] *= 30.0;
  for (double& rate : block.point.plastic_rate) rate = 1e7;
  const auto exchange = block.exchange(2.0);
  const auto largest = [&] {
    double most = 0.0;
    for (const double p : block.point.pressure) most = std::max(most, std::abs(p));
    return most;
  };
  const double first = largest();
  for (int step = 0; step < 40; ++step) {
    std::fill(block.point.volume_drift.begin(), block.point.volume_drift.end(), 0.0);
    block.apply(*exchange, 1e-9);
    EXPECT_LE(largest(), 1.2 * first) << step;
  }
  EXPECT_LE(largest(), 0.7 * first);
}

class Exchange : public ::testing::TestWithParam<bool> {};

TEST_P(Exchange, conserves_volume_and_books_its_energy) {
  Block block(noise, GetParam());
  const auto made_exchange = block.exchange(0.3);
  PressureExchange<2>& exchange = *made_exchange;
  const Field before = block.point.pressure, stress_free = block.point.stress_free;
  const double stored = block.total(block.point.stored_energy),
               plastic = block.total(block.point.plastic_work);
  const auto energy = block.apply(exchange);
  double sum = 0.0, size = 0.0, changed = 0.0, forces = 0.0;
  for (std::size_t i = 0; i < block.point.size(); ++i) {
    const double traded = block.approximation.mechanics.volume[i] * block.point.volume_drift[i];
    sum += traded;
    size += std::abs(traded);
    changed += block.point.pressure[i] != before[i];
    // p −= κ δθ, and the stress-free volume follows b_e
    EXPECT_NEAR(block.point.pressure[i], before[i] - block.kappa * block.point.volume_drift[i], 1e-3);
    EXPECT_NEAR(block.point.stress_free[i], stress_free[i] * std::exp(-block.point.volume_drift[i]), 1e-15);
    for (std::size_t c = 0; c < 4; ++c)
      forces += std::abs(block.stress.columns[4 * i + c] - block.point.piola[(c % 2) * 2 + c / 2][i]);
  }
  EXPECT_GT(changed, 0.6 * double(block.point.size()));
  EXPECT_LT(std::abs(sum), 1e-15 * size);
  EXPECT_LT(forces, 1e-3);
  EXPECT_NEAR(energy.dissipated, stored - block.total(block.point.stored_energy), 1e-9 * energy.dissipated);
  EXPECT_NEAR(energy.plastic, plastic - block.total(block.point.plastic_work), 1e-12 * plastic);
  EXPECT_GT(energy.dissipated, 0.0);
  // what it left is the state that the return map makes of F and C_p⁻¹
  const PointState<2> left = block.point;
  block.update();
  for (std::size_t i = 0; i < block.point.size(); ++i) {
    EXPECT_NEAR(block.point.pressure[i], left.pressure[i], 1e-6 * 2e8);
    EXPECT_NEAR(block.point.stored_energy[i], left.stored_energy[i], 1e-9 * 2e5);
    EXPECT_NEAR(block.point.stress_free[i], left.stress_free[i], 1e-13);
    for (std::size_t c = 0; c < 5; ++c) EXPECT_NEAR(block.point.piola[c][i], left.piola[c][i], 1e-6 * 2e8);
  }
}
INSTANTIATE_TEST_SUITE_P(Of, Exchange, ::testing::Bool(),
                         [](const auto& round) { return round.param ? "revolution" : "plane"; });

TEST(PressureExchange, is_nothing_on_constant_and_linear_pressures) {
  Block constant([](const Vec2&, std::size_t) { return 3e8; });
  constant.apply(*constant.exchange(0.3));
  Block linear([](const Vec2& x, std::size_t) { return 1e8 + 2e11 * x.x() - 1e11 * x.y(); });
  linear.apply(*linear.exchange(0.3));
  Block noisy(noise);
  noisy.apply(*noisy.exchange(0.3));
  double typical = 0.0;
  for (const double theta : noisy.point.volume_drift) typical = std::max(typical, std::abs(theta));
  for (std::size_t i = 0; i < linear.point.size(); ++i) {
    EXPECT_LT(std::abs(constant.point.volume_drift[i]), 1e-12 * typical);
    EXPECT_LT(std::abs(linear.point.volume_drift[i]), 1e-11 * typical);
  }
}

TEST(PressureExchange, leaves_elastic_zones_alone) {
  Block block(noise);
  for (std::size_t i = 0; i < block.point.size(); ++i)
    if (block.cloud.position[i].x() > 1e-3) block.point.plastic_rate[i] = 0.0;
  const auto made_exchange = block.exchange(0.3);
  PressureExchange<2>& exchange = *made_exchange;
  const PointState<2> before = block.point;
  block.apply(exchange);
  int touched = 0;
  for (std::size_t i = 0; i < block.point.size(); ++i) {
    const bool out = block.point.plastic_rate[i] == 0.0;
    touched += block.point.pressure[i] != before.pressure[i];
    if (!out) continue;
    EXPECT_EQ(block.point.pressure[i], before.pressure[i]);
    EXPECT_EQ(block.point.inverse_plastic_cauchy_green[0][i], before.inverse_plastic_cauchy_green[0][i]);
    EXPECT_EQ(block.point.piola[3][i], before.piola[3][i]);
    EXPECT_EQ(block.point.volume_drift[i], 0.0);
  }
  EXPECT_GT(touched, 20);
}

TEST(PressureExchange, lets_volumes_drift_so_far_and_back) {
  Block free(noise), half(noise), full(noise);
  free.apply(*free.exchange(0.3));
  for (double& drift : half.point.volume_drift) drift = 0.025; // growing at one end of each link
  half.apply(*half.exchange(0.3));
  for (double& drift : full.point.volume_drift) drift = -0.05;
  full.apply(*full.exchange(0.3));
  for (std::size_t i = 0; i < free.point.size(); ++i) {
    EXPECT_NEAR(half.point.volume_drift[i] - 0.025, 0.5 * free.point.volume_drift[i], 1e-15);
    EXPECT_EQ(full.point.volume_drift[i], -0.05);
  }
  // what flows from where there is too much to where there is too little is not held up
  Block back([](const Vec2& x, std::size_t) { return x.x() < 1e-3 ? -2e8 : 2e8; });
  Block same = back;
  for (std::size_t i = 0; i < back.point.size(); ++i)
    back.point.volume_drift[i] = back.cloud.position[i].x() < 1e-3 ? 0.05 : -0.05;
  const Field before = back.point.volume_drift;
  back.apply(*back.exchange(0.3));
  same.apply(*same.exchange(0.3));
  double moved = 0.0;
  for (std::size_t i = 0; i < back.point.size(); ++i)
    if (same.point.volume_drift[i] * before[i] < 0.0)
      moved += std::abs(back.point.volume_drift[i] - before[i]);
  EXPECT_GT(moved, 0.0);
}

TEST(PressureExchange, leaves_softened_points_alone) {
  Block block(noise);
  block.point.damaged.switch_on(true);
  block.point.damaged.rest(block.point.size());
  for (std::size_t i = 0; i < block.point.size(); ++i)
    block.point.softening[i] = block.cloud.position[i].y() > 5e-4 ? 0.1 : 0.0;
  block.apply(*block.exchange(0.3));
  int traded = 0;
  for (std::size_t i = 0; i < block.point.size(); ++i)
    if (block.point.softening[i] > 0.0)
      EXPECT_EQ(block.point.volume_drift[i], 0.0);
    else
      traded += block.point.volume_drift[i] != 0.0;
  EXPECT_GT(traded, 50);
}

TEST(PressureExchange, damps_a_checkerboard_faster_the_more_flows_and_never_beyond) {
  const auto checkerboard = [](const Vec2& x, std::size_t) {
    const long row = std::lround(x.y() / (1e-4 * std::sqrt(0.75)));
    return row % 2 == 0 ? 2e8 : -2e8;
  };
  double last = 1.0;
  for (const double dt : {1e-10, 1e-9, 1e-8, 1e-5}) { // the last at the limit of w
    Block block(checkerboard);
    const auto made_exchange = block.exchange(0.3);
    PressureExchange<2>& exchange = *made_exchange;
    const double before = pressure_noise<2>(block.approximation.links, block.cloud.facets, block.point);
    const double energy = block.total(block.point.stored_energy);
    double dissipated = block.apply(exchange, dt).dissipated;
    EXPECT_GT(dissipated, 0.0);
    for (int n = 1; n < 20; ++n) dissipated += block.apply(exchange, dt).dissipated;
    EXPECT_NEAR(block.total(block.point.stored_energy), energy - dissipated, 1e-9 * energy);
    EXPECT_LT(block.total(block.point.stored_energy), energy);
    const double after =
        pressure_noise<2>(block.approximation.links, block.cloud.facets, block.point) / before;
    EXPECT_LT(after, last) << dt;
    last = after;
  }
  EXPECT_LT(last, 0.35);
}

TEST(PressureExchange, keeps_momentum_and_the_energy_balance_of_a_run) {
  for (const double alpha : {0.0, 0.3}) {
    Problem<2> model = model_of(rectangle(2e-3, 1e-3, 1e-4), Method::cnem, steel_304L());
    model.pressure_exchange = alpha;
    model.viscosity = {1.2, 0.06};
    ExplicitSolver<2> solver = start(std::move(model), [](const Vec2& x) -> Vec2 {
      return {60.0 * std::sin(2000.0 * x.y()), -80.0 * std::sin(1500.0 * x.x())};
    });
    const Momenta before = momenta(solver);
    const double dt = 0.8 * solver.stable_step().dt, initial = solver.ledger().initial();
    for (int n = 0; n < 600; ++n) {
      if (n % 100 == 99) solver.prepare();
      solver.advance(dt);
    }
    const Momenta after = momenta(solver);
    const double scale = 2e-6 * 7850.0 * 80.0;
    EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * scale) << alpha;
    EXPECT_LT(std::abs(after.angular - before.angular), 1e-12 * scale * 1e-3) << alpha;
    const EnergyLedger ledger = solver.ledger();
    EXPECT_GT(ledger["plastic"], 0.1 * initial);
    EXPECT_LT(std::abs(ledger.residual()), 1e-3 * initial) << alpha;
    EXPECT_EQ(ledger["pressure_exchange"] > 0.0, alpha > 0.0);
    EXPECT_EQ(metric_of(solver, "volume_drift") > 0.0, alpha > 0.0);
  }
}

} // namespace
} // namespace cnem::testing
