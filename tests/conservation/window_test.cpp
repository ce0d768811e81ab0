// Matter that is fed in at one end of a body and taken off at the other: no state changes, and what comes and
// goes is all that is missing.
#include "adapt/plane/window.hpp"
#include "core/fields/vector_at.hpp"
#include "tests/conservation/blank.hpp"
#include "tests/conservation/nodes_of.hpp"
#include "tests/index_literals.hpp"
#include "tests/unit/mechanics/models.hpp"

#include <gtest/gtest.h>

namespace cnem::adapt {
namespace {

using namespace testing::literals;

constexpr double cell_size = 0.08;

/// A blank in a state that no cell has by itself: masses are not those of the cells.
struct Loaded : Blank {
  Structure structure;

  explicit Loaded(Blank of) : Blank(std::move(of)), structure(build_structure(cloud)) {
    for (std::size_t i = 0; i < node.mass.size(); ++i) {
      node.jacobian[i] = 1.0 + 0.05 * std::sin(3.0 * static_cast<double>(i));
      node.mass[i] /= node.jacobian[i] * (1.0 + 0.02 * std::cos(static_cast<double>(i)));
    }
  }
  std::optional<Resampling<2>> fed(double length, const Vec2& along = {1, 0}) const {
    return feed(cloud, structure, node, cloud.position, along, length);
  }
  std::optional<Resampling<2>> cut(const Vec2& from, const Vec2& to) const {
    return take_off(cloud, structure, node, from, to);
  }
};

/// Nodes keep their share of volume and mass, those that nothing happened to their bits, and `gain` and
/// `virgin` say what came and went.
void expect_accounts(const Loaded& before, const Resampling<2>& change) {
  const Structure after = build_structure(change.cloud);
  std::vector<char> virgin(change.old_of.size(), 0);
  for (const NodeIndex p : change.virgin) virgin[index_of(p)] = 1;
  Field of_old(before.node.mass.size(), 0.0);
  double mass = 0.0, expected = 0.0;
  int same = 0;
  for (const NodeIndex p : change.cloud.position.indices()) {
    const auto [from, weight] = change.model_of(p);
    const std::size_t k = index_of(from);
    ASSERT_GT(weight, 0.0);
    mass += weight * before.node.mass[k];
    if (virgin[index_of(p)]) {
      EXPECT_NEAR(weight * before.node.mass[k], after.volume(p), 1e-14); // of density 1, at J = 1
      expected += weight * before.node.mass[k];
      continue;
    }
    of_old[k] += weight;
    EXPECT_NEAR(weight, after.volume(p) / before.structure.volume(from), 1e-12);
    same += !change.mixed(index_of(p));
  }
  for (std::size_t k = 0; k < of_old.size(); ++k) {
    EXPECT_NEAR(of_old[k], 1.0 + change.gain[k], 1e-12);
    expected += (1.0 + change.gain[k]) * before.node.mass[k];
  }
  EXPECT_NEAR(mass, expected, 1e-13);
  EXPECT_GT(same, 20);
  expect_exact_patch(change.cloud);
}

double side_length(const Cloud<2>& cloud, PieceIndex piece) {
  double length = 0.0;
  for (const Facet<2>& facet : cloud.facets)
    if (facet.piece == piece)
      length += (cloud.position[facet.node[1]] - cloud.position[facet.node[0]]).norm();
  return length;
}

Blank named_blank(double jitter = 0.2) {
  Blank b{testing::rectangle(1.0, 0.6, cell_size, testing::Lattice::hexagonal, jitter), {}};
  b.weigh(cell_size);
  return b;
}

TEST(Feed, prolongs_the_body_beyond_its_end) {
  const Loaded before(named_blank());
  for (const double length : {0.16, 0.25, 0.4}) {
    const auto change = before.fed(length);
    ASSERT_TRUE(change);
    EXPECT_NEAR(testing::area(change->cloud), 0.6 * (1.0 + length), 1e-14);
    for (int piece = 0; piece < 4; ++piece) // bottom, right, top, left
      EXPECT_NEAR(side_length(change->cloud, as<PieceIndex>(piece)), piece % 2 ? 0.6 : 1.0 + length, 1e-14);
    EXPECT_GT(change->virgin.size(), 0.4 * 0.6 * length / (cell_size * cell_size));
    expect_accounts(before, *change);
  }
}

TEST(Feed, copies_the_strip_at_the_end_again_and_again) {
  Loaded before(named_blank());
  const double length = 0.24;
  std::size_t count = 0;
  for (int k = 0; k < 4; ++k) {
    const auto change = before.fed(length);
    ASSERT_TRUE(change);
    if (k > 0) { EXPECT_EQ(change->virgin.size(), count); }
    count = change->virgin.size();
    Blank next{change->cloud, {}};
    next.weigh(cell_size);
    before = Loaded(std::move(next));
  }
  EXPECT_NEAR(testing::area(before.cloud), 0.6 * (1.0 + 4 * length), 1e-13);
}

TEST(Feed, copies_what_it_was_before_it_deformed) {
  const Loaded undeformed(named_blank());
  Blank raised = undeformed;
  const Vec2 moved(0.03, -0.02);
  for (Vec2& x : raised.cloud.position) x += moved + Vec2(0.0, 0.02 * x.y() * (1.0 - x.x()));
  const Loaded before(std::move(raised));
  const auto change =
      feed(before.cloud, before.structure, before.node, undeformed.cloud.position, {1, 0}, 0.24);
  ASSERT_TRUE(change);
  const auto beyond = undeformed.fed(0.24);
  ASSERT_TRUE(beyond);
  ASSERT_EQ(change->virgin.size(), beyond->virgin.size());
  for (const NodeIndex p : change->virgin) {
    double nearest = 1.0;
    for (const NodeIndex q : beyond->virgin)
      nearest = std::min(nearest, (change->cloud.position[p] - beyond->cloud.position[q] - moved).norm());
    EXPECT_LT(nearest, 1e-14);
  }
}

TEST(Feed, goes_any_way) {
  Blank turned = named_blank();
  const double c = std::cos(2.0), s = std::sin(2.0);
  for (Vec2& x : turned.cloud.position) x = Vec2(c * x.x() - s * x.y(), s * x.x() + c * x.y());
  turned.weigh(cell_size);
  const Loaded before(std::move(turned));
  for (const Vec2& along : {Vec2(c, s), Vec2(-c, -s), Vec2(-s, c)}) {
    const auto change = before.fed(0.2, along);
    ASSERT_TRUE(change);
    expect_accounts(before, *change);
  }
  EXPECT_FALSE(before.fed(0.2, Vec2(1, 0))); // a corner
}

Blank hollow_blank(const Vec2& centre, double radius) {
  Blank hollow;
  testing::add_loop(hollow.cloud, testing::rectangle(1.0, 0.6), cell_size);
  testing::add_loop(hollow.cloud, testing::ring(centre, radius, radius, 8, true), cell_size);
  testing::fill(hollow.cloud, testing::Lattice::hexagonal, cell_size, 0.1, 0.5 * cell_size, 1);
  hollow.weigh(cell_size);
  return hollow;
}

TEST(Feed, leaves_what_is_not_a_straight_end) {
  Blank round;
  testing::add_loop(round.cloud, testing::ring({0, 0}, 0.5, 0.5, 24), cell_size);
  testing::fill(round.cloud, testing::Lattice::hexagonal, cell_size, 0.1, 0.5 * cell_size, 1);
  round.weigh(cell_size);
  EXPECT_FALSE(Loaded(std::move(round)).fed(0.2));

  const Loaded before(hollow_blank({0.8, 0.3}, 0.1));
  EXPECT_FALSE(before.fed(0.2)); // the hole reaches into the strip
  EXPECT_TRUE(before.fed(0.08));
}

TEST(TakeOff, leaves_a_straight_face_of_the_piece_that_went) {
  const Loaded before(named_blank());
  for (const double x : {0.2, 0.33, 0.61}) {
    const auto change = before.cut({x, 0.6}, {x, 0.0});
    ASSERT_TRUE(change);
    EXPECT_NEAR(testing::area(change->cloud), 0.6 * (1.0 - x), 1e-14);
    EXPECT_NEAR(side_length(change->cloud, 3_piece), 0.6, 1e-14);
    EXPECT_NEAR(side_length(change->cloud, 0_piece), 1.0 - x, 1e-14);
    for (const Vec2& at : change->cloud.position) EXPECT_GT(at.x(), x - 1e-14);
    EXPECT_TRUE(change->virgin.empty());
    expect_accounts(before, *change);
    const auto rest = before.cut({x, 0.0}, {x, 0.6}); // the other side of the same line
    ASSERT_TRUE(rest);
    EXPECT_NEAR(testing::area(rest->cloud), 0.6 * x, 1e-14);
    EXPECT_NEAR(side_length(rest->cloud, 1_piece), 0.6, 1e-14);
  }
}

TEST(TakeOff, cuts_aslant_and_takes_holes_with_it) {
  const Loaded before(hollow_blank({0.2, 0.3}, 0.08));
  const auto change = before.cut({0.6, 0.6}, {0.45, 0.0});
  ASSERT_TRUE(change);
  EXPECT_NEAR(testing::area(change->cloud), 0.6 * (1.0 - 0.525), 1e-14);
  expect_accounts(before, *change);
  EXPECT_FALSE(before.cut({0.2, 0.6}, {0.2, 0.0}));  // through the hole
  EXPECT_FALSE(before.cut({0.2, 0.6}, {0.2, 0.37})); // from one loop to another
}

} // namespace
} // namespace cnem::adapt

namespace cnem::testing {
namespace {

/// A bar held at its right end and pulled upon uniformly, with heat.
ExplicitSolver<2> pulled_bar() {
  const double cell_size = 1e-4;
  Cloud<2> cloud = rectangle(2e-3, 5e-4, cell_size, Lattice::hexagonal, 0.2);
  Problem<2> model = model_of(cloud, Method::cnem, steel_304L());
  model.thermal = true;
  model.open = true;
  std::vector<Support<2>> supports(1);
  supports[0] = {.name = "end",
                 .kind = Support<2>::Kind::velocity,
                 .direction = Vec2(1, 0),
                 .value = {},
                 .nodes = nodes_on(model.cloud, 1_piece),
                 .pieces = {1_piece}};
  model.supports = Supports<2>(std::move(supports), model.cloud.position.size());
  return start(std::move(model), [](const Vec2& x) -> Vec2 { return {1e5 * (x.x() - 2e-3), 0.0}; });
}

adapt::NodeProperties properties_of(const ExplicitSolver<2>& solver) {
  return nodes_of(solver, [](const Vec2&) { return 1e-4; });
}

IndexedVector<NodeIndex, Vec2> undeformed(const ExplicitSolver<2>& solver) {
  IndexedVector<NodeIndex, Vec2> places;
  for (std::size_t i = 0; i < solver.state().node.size(); ++i)
    places.push_back(vector_at<2>(solver.state().node.initial_position, i));
  return places;
}

TEST(Window, moves_through_a_body_that_keeps_its_state) {
  ExplicitSolver<2> solver = pulled_bar();
  for (int n = 0; n < 60; ++n) solver.advance(solver.stable_step().dt);
  const State<2>& state = solver.state();
  const double residual = solver.ledger().residual(), heat_residual = solver.ledger().heat_residual();
  double scale = 0.0;
  for (std::size_t i = 0; i < state.node.size(); ++i)
    scale += state.node.mass[i] * std::hypot(state.node.velocity[0][i], state.node.velocity[1][i]);
  const double mass = total_mass(solver),
               heat = sum_of_products(state.node.heat_capacity, state.node.temperature);
  const Vec2 momentum = momenta(solver).linear;
  const double area = enclosed_measure(solver.present_cloud());
  for (int k = 0; k < 2; ++k) {
    const Cloud<2> cloud = solver.present_cloud();
    const adapt::Structure structure = adapt::build_structure(cloud);
    const auto change =
        k == 0 ? adapt::feed(cloud, structure, properties_of(solver), undeformed(solver), {1, 0}, 4e-4)
               : adapt::take_off(cloud, structure, properties_of(solver), {5e-4, 5e-4}, {5e-4, 0.0});
    ASSERT_TRUE(change);
    const Field strain = state.point.plastic_strain, stress = state.point.pressure;
    const EnergyLedger before = solver.ledger();
    solver.prepare(*change);
    for (const NodeIndex p : change->cloud.position.indices()) {
      const std::size_t i = index_of(p), from = index_of(change->model_of(p).first);
      const bool virgin = std::count(change->virgin.begin(), change->virgin.end(), p) > 0;
      EXPECT_EQ(state.point.plastic_strain[i], virgin ? 0.0 : strain[from]);
      EXPECT_NEAR(state.point.pressure[i], virgin ? 0.0 : stress[from], 1e-9 * std::abs(stress[from]) + 1.0);
      if (virgin) {
        EXPECT_EQ(state.node.temperature[i], 296.0);
        EXPECT_GT(state.node.initial_position[0][i], 2e-3 - 1e-12);
      }
    }
    const EnergyLedger after = solver.ledger();
    EXPECT_NEAR(after.total(), before.total(), 1e-12 * before.total());
    EXPECT_EQ(after["plastic"], before["plastic"]);
    if (k == 1) {
      EXPECT_GT(after["matter"], 0.05 * before["elastic"]);
      EXPECT_LT(after["heat_matter"], before["heat_matter"]);
    }
  }
  const Departed<2>& gone = state.departed;
  EXPECT_NEAR(total_mass(solver) + gone.mass, mass, 1e-13 * mass);
  EXPECT_NEAR((momenta(solver).linear + gone.momentum - momentum).norm(), 0.0, 1e-13 * scale);
  EXPECT_NEAR(sum_of_products(state.node.heat_capacity, state.node.temperature) + gone.enthalpy, heat,
              1e-13 * heat);
  EXPECT_NEAR(enclosed_measure(solver.present_cloud()) + gone.volume, area, 1e-13 * area);
  EXPECT_NEAR(solver.ledger().residual(), residual, 1e-12 * solver.ledger().total());
  EXPECT_NEAR(solver.ledger().heat_residual(), heat_residual, 1e-12 * heat);
}

TEST(Window, lets_the_end_go_that_has_moved_on) {
  ExplicitSolver<2> solver = pulled_bar();
  const Cloud<2> cloud = solver.present_cloud();
  const auto change = adapt::feed(cloud, adapt::build_structure(cloud), properties_of(solver),
                                  undeformed(solver), {1, 0}, 4e-4);
  ASSERT_TRUE(change);
  solver.prepare(*change);
  std::size_t held = 0;
  for (const auto& prescribed : solver.conditions().supports.prescribed()) {
    EXPECT_NEAR(solver.state().node.position[0][index_of(prescribed.node)], 2.4e-3, 1e-12);
    ++held;
  }
  EXPECT_EQ(held, nodes_on(cloud, 1_piece).size());
}

TEST(Window, of_a_body_at_rest_changes_nothing_but_the_matter) {
  Cloud<2> cloud = rectangle(2e-3, 5e-4, 1e-4, Lattice::hexagonal, 0.2);
  Problem<2> model = model_of(cloud, Method::cnem, steel_304L());
  model.open = true;
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {40.0, 0.0}; });
  double mass = total_mass(solver);
  for (int k = 0; k < 3; ++k) {
    const Cloud<2> now = solver.present_cloud();
    const auto change = adapt::feed(now, adapt::build_structure(now), properties_of(solver),
                                    undeformed(solver), {1, 0}, 3e-4);
    ASSERT_TRUE(change);
    solver.prepare(*change);
    const double left = 3e-4 * (k + 1) + 40.0 * solver.state().time;
    const Cloud<2> fed = solver.present_cloud();
    const auto cut =
        adapt::take_off(fed, adapt::build_structure(fed), properties_of(solver), {left, 5e-4}, {left, 0.0});
    ASSERT_TRUE(cut);
    solver.prepare(*cut);
    for (int n = 0; n < 10; ++n) solver.advance(solver.stable_step().dt);
  }
  EXPECT_NEAR(total_mass(solver), mass, 1e-12 * mass);
  EXPECT_NEAR(solver.state().departed.mass, 0.0, 1e-12 * mass);
  for (std::size_t i = 0; i < solver.state().node.size(); ++i) {
    EXPECT_NEAR(solver.state().node.velocity[0][i], 40.0, 1e-9);
    EXPECT_NEAR(solver.state().node.velocity[1][i], 0.0, 1e-9);
  }
  EXPECT_NEAR(solver.ledger().residual(), 0.0, 1e-12 * solver.ledger().initial());
}

} // namespace
} // namespace cnem::testing
