// Opening a cloud along edges: topology, matter, cells.
#include "adapt/resample.hpp"
#include "adapt/split.hpp"
#include "cnem/scni.hpp"
#include "tests/clouds.hpp"

#include <gtest/gtest.h>

namespace cnem::adapt {
namespace {

std::size_t u(std::int32_t i) { return static_cast<std::size_t>(i); }

struct Blank {
  Cloud<2> cloud;
  NodeProperties node;
  Field broken;

  explicit Blank(double spacing = 0.1) {
    testing::add_loop(cloud, testing::rectangle(1.0, 0.6), spacing);
    cloud.piece_names = {"boundary", "fracture"};
    testing::fill(cloud, testing::Lattice::hexagonal, spacing, 0.15, 0.5 * spacing, 1);
    const Structure structure = build_structure(cloud);
    node.mass = structure.cells.volume;
    node.log_jacobian.assign(node.mass.size(), 0.0);
    node.density.assign(node.mass.size(), 1.0);
    node.size.assign(node.mass.size(), spacing);
    node.held.assign(node.mass.size(), 0);
    broken.assign(node.mass.size(), 0.0);
  }
  /// A band across the height, most broken in its middle, up to the height y.
  void break_band(double x, double y) {
    for (std::size_t i = 0; i < broken.size(); ++i)
      if (std::abs(cloud.position[i].x() - x) < 0.09 && cloud.position[i].y() <= y)
        broken[i] = 2.0 - std::abs(cloud.position[i].x() - x);
  }
};

double total(const Field& f) {
  double sum = 0.0;
  for (const double v : f) sum += v;
  return sum;
}

int loops(const Cloud<2>& cloud) {
  std::vector<std::int32_t> next(cloud.position.size(), -1);
  for (const Facet<2>& facet : cloud.facets) next[u(facet.node[0])] = facet.node[1];
  std::vector<char> seen(next.size(), 0);
  int count = 0;
  for (const Facet<2>& facet : cloud.facets) {
    if (seen[u(facet.node[0])]) continue;
    ++count;
    for (std::int32_t i = facet.node[0]; !seen[u(i)]; i = next[u(i)]) seen[u(i)] = 1;
  }
  return count;
}

TEST(Split, leaves_sound_material_alone) {
  const Blank b;
  SplitReport report;
  const Resampling<2> change = split(b.cloud, b.node, b.broken, {.piece = 1}, report);
  EXPECT_EQ(report.opened, 0);
  EXPECT_EQ(change.cloud.nodes(), b.cloud.nodes());
}

TEST(Split, opens_a_crack_from_the_boundary_to_where_damage_ends) {
  Blank b;
  b.break_band(0.5, 0.35);
  SplitReport report;
  const Resampling<2> change = split(b.cloud, b.node, b.broken, {.piece = 1, .most = 50}, report);
  EXPECT_GE(report.opened, 2);
  EXPECT_LE(report.opened, 5);
  EXPECT_EQ(report.separated, 0);
  EXPECT_EQ(loops(change.cloud), 1);
  EXPECT_EQ(change.cloud.nodes(), b.cloud.nodes() + report.opened);
  int faces = 0;
  for (const Facet<2>& facet : change.cloud.facets) faces += facet.piece == 1;
  EXPECT_EQ(faces, 2 * report.opened);
  Field mass = b.node.mass;
  carry_sum(change.parcels, mass);
  EXPECT_NEAR(total(mass), 0.6, 1e-12);
  for (const double m : mass) EXPECT_GT(m, 0.0);
  EXPECT_NEAR(testing::area(change.cloud), 0.6 + report.area_change, 1e-14);
  EXPECT_LT(std::abs(report.area_change), 1e-3 * 0.1 * 0.1 * report.opened);
}

TEST(Split, takes_the_body_apart_when_the_band_goes_through) {
  Blank b;
  b.break_band(0.5, 1.0);
  SplitReport report;
  const Resampling<2> change = split(b.cloud, b.node, b.broken, {.piece = 1, .most = 50}, report);
  EXPECT_EQ(report.separated, 1);
  EXPECT_EQ(loops(change.cloud), 2);
  Field mass = b.node.mass;
  carry_sum(change.parcels, mass);
  EXPECT_NEAR(total(mass), 0.6, 1e-12);
  // masses of the doubled nodes fit their cells, and functions do not reach across
  const Structure structure = build_structure(change.cloud);
  for (std::size_t i = 0; i < mass.size(); ++i) EXPECT_NEAR(structure.cells.volume[i] / mass[i], 1.0, 0.02);
  scni::Cnem method{scni::Options{}};
  const DiscreteOperators<2> op = method.rebuild(change.cloud).mechanics;
  std::vector<int> side(mass.size(), 0);
  std::vector<std::int32_t> front{0};
  side[0] = 1;
  while (!front.empty()) {
    const std::int32_t i = front.back();
    front.pop_back();
    for (auto e = u(op.row_begin[u(i)]); e < u(op.row_begin[u(i) + 1]); ++e)
      if (!side[u(op.node[e])]) {
        side[u(op.node[e])] = 1;
        front.push_back(op.node[e]);
      }
  }
  double one_side = 0.0;
  for (std::size_t i = 0; i < side.size(); ++i) one_side += side[i] ? mass[i] : 0.0;
  EXPECT_NEAR(one_side, 0.3, 0.06);
}

TEST(Split, cracks_survive_resampling) {
  Blank b;
  b.break_band(0.5, 0.35);
  SplitReport report;
  const Resampling<2> cracked = split(b.cloud, b.node, b.broken, {.piece = 1, .most = 50}, report);
  carry_mean(cracked.parcels, b.node.mass, b.node.log_jacobian);
  carry_sum(cracked.parcels, b.node.mass);
  for (Field* label : {&b.node.density, &b.node.size}) carry_label(cracked.labels, *label);
  b.node.held.assign(b.node.mass.size(), 0);
  PassReport pass;
  const Resampling<2> change = resample(cracked.cloud, b.node, {}, Placement::between_nodes, pass);
  EXPECT_EQ(pass.folded, 0);
  int faces = 0;
  for (const Facet<2>& facet : change.cloud.facets) faces += facet.piece == 1;
  EXPECT_GE(faces, 2 * report.opened);
}

TEST(Split, goes_on_from_the_tip_of_an_earlier_pass) {
  Blank b;
  b.break_band(0.5, 1.0);
  SplitReport report;
  int passes = 0;
  while (report.separated == 0 && passes++ < 20) {
    const int before = report.opened;
    const Resampling<2> change = split(b.cloud, b.node, b.broken, {.piece = 1, .most = 1}, report);
    ASSERT_EQ(report.opened, before + 1);
    carry_mean(change.parcels, b.node.mass, b.node.log_jacobian);
    carry_sum(change.parcels, b.node.mass);
    for (Field* label : {&b.node.density, &b.node.size, &b.broken}) carry_label(change.labels, *label);
    b.node.held.assign(b.node.mass.size(), 0);
    b.cloud = change.cloud;
  }
  EXPECT_EQ(report.separated, 1);
  EXPECT_EQ(loops(b.cloud), 2);
  EXPECT_NEAR(total(b.node.mass), 0.6, 1e-12);
}

} // namespace
} // namespace cnem::adapt
