// Cutting a cloud along edges: topology, matter, cells.
#include "adapt/plane/resample.hpp"
#include "cnem/scni.hpp"
#include "core/index.hpp"
#include "tests/conservation/blank.hpp"
#include "tests/index_literals.hpp"

#include <gtest/gtest.h>

namespace cnem::adapt {

using namespace testing::literals;
namespace {

struct BrokenBlank : Blank {
  explicit BrokenBlank(double spacing = 0.1, bool hole = false) {
    testing::add_loop(cloud, testing::rectangle(1.0, 0.6), spacing);
    if (hole) testing::add_loop(cloud, {{0.4, 0.2}, {0.4, 0.4}, {0.6, 0.4}, {0.6, 0.2}}, spacing);
    cloud.piece_names = {"boundary", "fracture"};
    testing::fill(cloud, testing::Lattice::hexagonal, spacing, 0.15, 0.5 * spacing, 1);
    weigh(spacing);
    node.broken.assign(node.mass.size(), 0.0);
  }
  /// Opened and nothing else.
  Resampling<2> opened(const SplitRules& rules, PassReport& report) const {
    WorkingCloud work(cloud, node);
    Structure structure = build_structure(cloud);
    split(work, structure, rules, report);
    Resampling<2> change = work.finish();
    change.old_position = cloud.position;
    return change;
  }
  /// A band across the height, most broken in its middle, up to the height y.
  void break_band(double x, double y) {
    for (std::size_t i = 0; i < node.broken.size(); ++i)
      if (std::abs(cloud.position[i].x() - x) < 0.09 && cloud.position[i].y() <= y)
        node.broken[i] = 2.0 - std::abs(cloud.position[i].x() - x);
  }
};

double total(const Field& f) {
  double sum = 0.0;
  for (const double v : f) sum += v;
  return sum;
}

int faces_of(const Cloud<2>& cloud) {
  int faces = 0;
  for (const Facet<2>& facet : cloud.facets) faces += facet.piece == 1_piece;
  return faces;
}

TEST(Split, leaves_alone_what_is_sound_or_broken_only_in_part) {
  for (const double until : {-1.0, 0.35}) {
    BrokenBlank b;
    b.break_band(0.5, until);
    PassReport report;
    const Resampling<2> change = b.opened({.piece = 1_piece}, report);
    EXPECT_EQ(report.cuts, 0);
    EXPECT_EQ(change.cloud.nodes(), b.cloud.nodes());
  }
}

TEST(Split, takes_the_body_apart_where_it_is_broken_through) {
  BrokenBlank b;
  b.break_band(0.5, 1.0);
  PassReport report;
  const Resampling<2> change = b.opened({.piece = 1_piece}, report);
  EXPECT_EQ(report.cuts, 1);
  EXPECT_GE(report.opened, 6);
  EXPECT_LE(report.opened, 8);
  EXPECT_EQ(change.cloud.nodes(), b.cloud.nodes() + report.opened + 1);
  EXPECT_EQ(faces_of(change.cloud), 2 * report.opened);
  EXPECT_EQ(testing::loops(change.cloud), 2);
  Field mass = b.node.mass;
  carry_sum(change.parcels, mass);
  EXPECT_NEAR(total(mass), 0.6, 1e-12);
  EXPECT_NEAR(testing::area(change.cloud), 0.6, 1.1e-3 * 0.1 * 0.6);
  // functions do not reach across
  scni::Cnem method{scni::Options{}};
  const DiscreteOperators<2> op = method.rebuild(change.cloud).mechanics;
  std::vector<int> side(mass.size(), 0);
  std::vector<NodeIndex> front{NodeIndex{}};
  side[0] = 1;
  while (!front.empty()) {
    const NodeIndex i = front.back();
    front.pop_back();
    for (auto e = index_of(op.row_begin[index_of(i)]); e < index_of(op.row_begin[index_of(i) + 1]); ++e)
      if (!side[index_of(op.node[e])]) {
        side[index_of(op.node[e])] = 1;
        front.push_back(op.node[e]);
      }
  }
  double one_side = 0.0;
  for (std::size_t i = 0; i < side.size(); ++i) one_side += side[i] ? mass[i] : 0.0;
  EXPECT_NEAR(one_side, 0.3, 0.06);
}

// Nodes that were moved to straighten the cut have cells of another size: the pass brings matter along.
TEST(Split, masses_fit_the_cells_after_the_pass) {
  BrokenBlank b(0.05);
  b.break_band(0.5, 1.0);
  PassReport report;
  const Resampling<2> change =
      resample(b.cloud, structure_if_valid(b.cloud), b.node, {.split = {.piece = 1_piece}}, report);
  ASSERT_EQ(report.cuts, 1);
  Field mass = b.node.mass;
  carry_sum(change.parcels, mass);
  EXPECT_NEAR(total(mass), 0.6, 1e-12);
  const Structure structure = build_structure(change.cloud);
  for (std::size_t i = 0; i < mass.size(); ++i) {
    EXPECT_GT(structure.cells.volume[i] / mass[i], 0.8 - 1e-9);
    EXPECT_LT(structure.cells.volume[i] / mass[i], 1.25 + 1e-9);
  }
}

TEST(Split, faces_are_smooth_and_end_on_the_boundary) {
  BrokenBlank b(0.05);
  b.break_band(0.5, 1.0);
  PassReport report;
  const Resampling<2> change = b.opened({.piece = 1_piece}, report);
  ASSERT_EQ(report.cuts, 1);
  const Cloud<2>& cloud = change.cloud;
  std::vector<const Facet<2>*> leaving(cloud.position.size(), nullptr);
  for (const Facet<2>& facet : cloud.facets) leaving[index_of(facet.node[0])] = &facet;
  int turns = 0;
  for (const Facet<2>& facet : cloud.facets) {
    const Facet<2>& next = *leaving[index_of(facet.node[1])];
    if (facet.piece != 1_piece) {
      if (next.piece == 1_piece) {
        const double y = cloud.position[facet.node[1]].y();
        EXPECT_NEAR(std::min(std::abs(y), std::abs(y - 0.6)), 0.0, 1e-15);
      }
      continue;
    }
    if (next.piece != 1_piece) continue;
    const Vec2 in = cloud.position[facet.node[1]] - cloud.position[facet.node[0]],
               out = cloud.position[next.node[1]] - cloud.position[next.node[0]];
    EXPECT_GT(in.dot(out), 0.85 * in.norm() * out.norm()); // a path of the lattice turns by 60 degrees
    ++turns;
  }
  EXPECT_GT(turns, 10);
}

TEST(Split, takes_no_crumbs_and_no_skin_off) {
  for (const bool skin : {false, true}) {
    BrokenBlank b;
    for (std::size_t i = 0; i < b.node.broken.size(); ++i)
      if (skin ? b.cloud.position[i].y() < 0.25 : b.cloud.position[i].norm() < 0.33) b.node.broken[i] = 2.0;
    // two chains: the boundary is sound in between
    for (std::size_t i = 0; i < b.node.broken.size(); ++i)
      if (skin ? std::abs(b.cloud.position[i].x() - 0.5) < 0.06 && b.cloud.position[i].y() < 1e-9
               : b.cloud.position[i].norm() < 1e-9)
        b.node.broken[i] = 0.0;
    PassReport report;
    b.opened({.piece = 1_piece}, report);
    EXPECT_EQ(report.cuts, 0) << skin;
    b.opened({.piece = 1_piece, .part = 0.0, .least_angle = 0.0, .least_loop = 0}, report);
    EXPECT_GE(report.cuts, 1) << skin;
  }
}

TEST(Split, opens_the_bridge_between_a_hole_and_the_edge) {
  BrokenBlank b(0.05, true);
  ASSERT_EQ(testing::loops(b.cloud), 2);
  b.break_band(0.5, 0.3);
  PassReport report;
  const Resampling<2> change = b.opened({.piece = 1_piece}, report);
  EXPECT_EQ(report.cuts, 1);
  EXPECT_EQ(testing::loops(change.cloud), 1);
  EXPECT_EQ(faces_of(change.cloud), 2 * report.opened);
  Field mass = b.node.mass;
  const double before = total(mass);
  carry_sum(change.parcels, mass);
  EXPECT_NEAR(total(mass), before, 1e-12);
}

TEST(Split, resampling_goes_on_with_the_parts) {
  BrokenBlank b;
  b.break_band(0.5, 1.0);
  PassReport report;
  const Resampling<2> parted = b.opened({.piece = 1_piece}, report);
  carry_mean(parted.parcels, b.node.mass, b.node.jacobian);
  carry_sum(parted.parcels, b.node.mass);
  b.node.broken.clear();
  for (Field* label : {&b.node.density, &b.node.size}) carry_label(parted.labels, *label);
  b.node.held.assign(b.node.mass.size(), 0);
  PassReport pass;
  const Resampling<2> change = resample(parted.cloud, structure_if_valid(parted.cloud), b.node, {}, pass);
  EXPECT_EQ(pass.folded, 0);
  EXPECT_EQ(pass.undone, 0);
  EXPECT_EQ(testing::loops(change.cloud), 2);
}

} // namespace
} // namespace cnem::adapt
