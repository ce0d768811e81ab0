// Opening a cloud from its boundary to a tip inside: topology, matter, and what does not open.
#include "adapt/plane/resample.hpp"
#include "core/index.hpp"
#include "tests/conservation/blank.hpp"
#include "tests/index_literals.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace cnem::adapt {

using namespace testing::literals;
namespace {

constexpr double fine = 0.04; ///< m, spacing

/// What breaks stays broken: nodes know it by their place.
struct CrackedBlank : Blank {
  CrackedBlank() {
    testing::add_loop(cloud, testing::rectangle(1.0, 0.6), fine);
    cloud.piece_names = {"boundary", "fracture"};
    testing::fill(cloud, testing::Lattice::hexagonal, fine, 0.15, 0.5 * fine, 1);
    weigh(fine);
    node.broken.assign(node.mass.size(), 0.0);
  }
  /// A band across the height, most strained in its middle.
  void break_band(double x, double from, double to, double half_width = 1.2 * fine) {
    for (const NodeIndex i : cloud.position.indices()) {
      const Vec2& at = cloud.position[i];
      if (std::abs(at.x() - x) < half_width && at.y() >= from && at.y() <= to)
        node.broken[index_of(i)] = 2.0 - std::abs(at.x() - x) / half_width;
    }
  }
  /// Cuts and cracks, nothing else; the blank goes on with what it has become.
  PassReport open(bool whole_pass = false) {
    const SplitRules rules{.piece = 1_piece, .cracks = true};
    PassReport report;
    Resampling<2> change;
    if (whole_pass) {
      change = resample(cloud, structure_if_valid(cloud), node, {.split = rules}, report);
    } else {
      WorkingCloud work(cloud, node, rules.piece);
      Structure structure = build_structure(cloud);
      split(work, structure, rules, report);
      open_cracks(work, structure, rules, report);
      change = work.finish();
    }
    carry_mean(change.parcels, node.mass, node.jacobian);
    carry_sum(change.parcels, node.mass);
    for (Field* label : {&node.density, &node.size, &node.broken}) carry_label(change.labels, *label);
    node.held.assign(node.mass.size(), 0);
    cloud = change.cloud;
    return report;
  }
  double mass() const { return std::accumulate(node.mass.begin(), node.mass.end(), 0.0); }
  int faces() const {
    return static_cast<int>(std::count_if(cloud.facets.begin(), cloud.facets.end(),
                                          [](const Facet<2>& facet) { return facet.piece == 1_piece; }));
  }
};

TEST(Crack, opens_from_the_boundary_to_a_tip_and_loses_nothing) {
  CrackedBlank b;
  b.break_band(0.5, 0.0, 0.35);
  const int nodes = b.cloud.nodes();
  const double mass = b.mass(), area = testing::area(b.cloud);
  const PassReport report = b.open();
  EXPECT_EQ(report.cracks, 1);
  EXPECT_EQ(report.cuts + report.advances + report.undone, 0);
  EXPECT_GE(report.opened, 7);
  EXPECT_EQ(b.cloud.nodes(), nodes + report.opened); // all but the tip
  EXPECT_EQ(b.faces(), 2 * report.opened);
  EXPECT_EQ(testing::loops(b.cloud), 1);
  EXPECT_NEAR(b.mass(), mass, 1e-14);
  EXPECT_NEAR(testing::area(b.cloud), area, 1.1e-3 * fine * 0.35);
  expect_exact_patch(b.cloud);
}

TEST(Crack, tip_goes_on_with_what_breaks_and_only_then) {
  CrackedBlank b;
  b.break_band(0.5, 0.0, 0.25);
  ASSERT_EQ(b.open().cracks, 1);
  for (const double to : {0.25, 0.28}) { // nothing new, and less than the least advance
    b.break_band(0.5, 0.0, to);
    const PassReport none = b.open();
    EXPECT_EQ(none.opened, 0) << to;
  }
  b.break_band(0.5, 0.0, 0.45);
  const PassReport more = b.open();
  EXPECT_EQ(more.advances, 1);
  EXPECT_EQ(more.cracks, 0);
  EXPECT_GE(more.opened, 3);
  EXPECT_EQ(testing::loops(b.cloud), 1);
  double deepest = 0.0;
  for (const Facet<2>& facet : b.cloud.facets)
    if (facet.piece == 1_piece) {
      deepest = std::max(deepest, b.cloud.position[facet.node[1]].y());
      EXPECT_NEAR(b.cloud.position[facet.node[1]].x(), 0.5, 1.2 * fine);
    }
  EXPECT_GT(deepest, 0.38);
}

TEST(Crack, does_not_open_what_is_not_longer_than_wide_or_does_not_reach_the_boundary) {
  for (const bool inside : {false, true}) {
    CrackedBlank b;
    if (inside)
      b.break_band(0.5, 0.15, 0.45);
    else
      b.break_band(0.5, 0.0, 0.25, 0.2);
    EXPECT_EQ(b.open().opened, 0) << inside;
  }
}

TEST(Crack, no_second_one_opens_beside_the_first) {
  CrackedBlank b;
  b.break_band(0.5, 0.0, 0.35);
  ASSERT_EQ(b.open().cracks, 1);
  b.break_band(0.5 - 2.5 * fine, 0.0, 0.35);
  EXPECT_EQ(b.open().cracks, 0);
  b.break_band(0.15, 0.0, 0.35);
  EXPECT_EQ(b.open().cracks, 1);
}

TEST(Crack, two_from_either_edge_meet) {
  CrackedBlank b;
  b.break_band(0.5, 0.0, 0.22);
  b.break_band(0.5, 0.38, 0.6);
  EXPECT_EQ(b.open(true).cracks, 2);
  EXPECT_EQ(testing::loops(b.cloud), 1);
  b.break_band(0.5, 0.0, 0.6);
  const PassReport report = b.open(true);
  EXPECT_EQ(report.cuts, 1);
  EXPECT_LE(report.opened, 8); // from tip to tip
  EXPECT_EQ(testing::loops(b.cloud), 2);
}

TEST(Crack, whole_passes_keep_it) {
  CrackedBlank b;
  b.break_band(0.5, 0.0, 0.35);
  const double mass = b.mass();
  ASSERT_EQ(b.open(true).cracks, 1);
  const int faces = b.faces();
  for (int pass = 0; pass < 4; ++pass) {
    const PassReport report = b.open(true);
    EXPECT_EQ(report.folded + report.outside + report.undone + report.opened, 0) << pass;
  }
  EXPECT_NEAR(b.faces(), faces, 4);
  EXPECT_EQ(testing::loops(b.cloud), 1);
  EXPECT_NEAR(b.mass(), mass, 1e-14);
}

} // namespace
} // namespace cnem::adapt
