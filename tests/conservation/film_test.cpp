// Films, thinner than a cell: long edges of theirs are split, broken ones are cut at the waist.
#include "adapt/plane/resample.hpp"
#include "core/index.hpp"
#include "tests/conservation/blank.hpp"
#include "tests/index_literals.hpp"

#include <gtest/gtest.h>
#include <tuple>

namespace cnem::adapt {

using namespace testing::literals;
namespace {

constexpr double h = 0.1;

/// Two blocks that a film joins between two notches, `thickness` at its waist. The upper notch ends in a
/// node, or in a facet.
struct Waisted : Blank {
  explicit Waisted(double thickness, double broken, bool facet = false) {
    const double half = facet ? 0.5 * h : 0.0;
    const double low = 0.4 - 0.5 * thickness, high = 0.4 + 0.5 * thickness;
    std::vector<Vec2> corners{{0.0, 0.0}, {0.8, 0.0}, {1.0, low}, {1.2, 0.0},
                              {2.0, 0.0}, {2.0, 0.8}, {1.2, 0.8}, {1.0 + half, high}};
    if (facet) corners.emplace_back(1.0 - half, high);
    corners.emplace_back(0.8, 0.8);
    corners.emplace_back(0.0, 0.8);
    testing::add_loop(cloud, corners, h);
    cloud.piece_names = {"boundary", "fracture"};
    testing::fill(cloud, testing::Lattice::hexagonal, h, 0.1, 0.5 * h, 1);
    weigh(h);
    node.broken.assign(node.mass.size(), 0.0);
    for (std::size_t i = 0; i < node.broken.size(); ++i)
      if (std::abs(cloud.position[i].x() - 1.0) < 0.15) node.broken[i] = broken;
  }
  /// Nothing else than the cuts through films.
  Resampling<2> cut(PassReport& report, SplitRules rules = {.piece = 1_piece}) const {
    WorkingCloud work(cloud, node);
    Structure structure = build_structure(cloud);
    cut_films(work, structure, rules, report);
    return work.finish();
  }
};

/// Each old node is handed on whole, and no new one is without matter.
void expect_all_handed_on(const Resampling<2>& change, std::size_t old_nodes) {
  Field sum(old_nodes, 0.0);
  for (std::size_t e = 0; e < change.parcels.from.size(); ++e) {
    EXPECT_GT(change.parcels.weight[e], 0.0);
    sum[index_of(change.parcels.from[e])] += change.parcels.weight[e];
  }
  for (const double s : sum) EXPECT_NEAR(s, 1.0, 1e-14);
  for (std::size_t p = 0; p < change.parcels.size(); ++p)
    EXPECT_LT(change.parcels.begin[p], change.parcels.begin[p + 1]);
}

TEST(Film, broken_and_thin_is_cut_at_its_waist) {
  const Waisted b(0.1 * h, 2.0);
  PassReport report;
  const Resampling<2> change = b.cut(report);
  EXPECT_EQ(report.undone, 0);
  EXPECT_EQ(report.films, 1);
  EXPECT_EQ(report.cuts, 1);
  EXPECT_EQ(report.opened, 1);
  EXPECT_EQ(change.cloud.nodes(), b.cloud.nodes() + 2);
  EXPECT_EQ(testing::loops(change.cloud), 2);
  EXPECT_NEAR(testing::area(change.cloud), testing::area(b.cloud), 1e-4 * h * h);
  expect_all_handed_on(change, b.node.mass.size());
  for (const Facet<2>& facet : change.cloud.facets) {
    if (facet.piece != 1_piece) continue;
    for (const NodeIndex i : facet.node) EXPECT_NEAR(change.cloud.position[i].x(), 1.0, 1e-3);
  }
}

TEST(Film, is_cut_straight_across_where_a_node_stands_over_a_facet) {
  const Waisted b(0.1 * h, 2.0, true);
  PassReport report;
  const Resampling<2> change = b.cut(report);
  EXPECT_EQ(report.films, 1);
  EXPECT_EQ(change.cloud.nodes(), b.cloud.nodes() + 3) << "the foot, and both ends doubled";
  EXPECT_EQ(testing::loops(change.cloud), 2);
  expect_all_handed_on(change, b.node.mass.size());
  for (const Facet<2>& facet : change.cloud.facets) {
    if (facet.piece != 1_piece) continue;
    for (const NodeIndex i : facet.node) EXPECT_NEAR(change.cloud.position[i].x(), 1.0, 1e-3);
  }
}

TEST(Film, sound_or_thick_enough_stays_whole) {
  for (const auto& [thickness, broken] : {std::pair{0.1, 0.99}, {0.2, 2.0}}) {
    const Waisted b(thickness * h, broken);
    PassReport report;
    const Resampling<2> change = b.cut(report);
    EXPECT_EQ(report.films + report.cuts + report.undone, 0) << thickness;
    EXPECT_EQ(change.cloud.nodes(), b.cloud.nodes());
  }
}

TEST(Film, thinner_than_the_thinnest_is_cut_though_it_is_whole) {
  const Waisted b(0.1 * h, 0.0);
  for (const auto& [thinnest, films] : {std::pair{0.09 * h, 0}, {0.11 * h, 1}}) {
    PassReport report;
    const Resampling<2> change = b.cut(report, {.piece = 1_piece, .thinnest_film = thinnest});
    EXPECT_EQ(report.films, films) << thinnest;
    EXPECT_EQ(testing::loops(change.cloud), 1 + films) << thinnest;
    expect_all_handed_on(change, b.node.mass.size());
  }
}

/// A crumb of four nodes, 0.05 h thick, above the middle of a blank, by this much.
Blank with_crumb(double above) {
  Blank b = blank(h);
  const double low = 0.6 + above;
  testing::add_loop(b.cloud, {{0.45, low}, {0.53, low}, {0.53, low + 0.05 * h}, {0.45, low + 0.05 * h}}, h);
  b.weigh(h);
  b.node.broken.assign(b.node.mass.size(), 0.0);
  return b;
}

TEST(Film, crumbs_of_it_join_what_is_nearest) {
  for (const auto& [above, thinnest, crumbs] :
       {std::tuple{0.1 * h, 0.1 * h, 1}, {0.1 * h, 0.03 * h, 0}, {0.1 * h, 0.0, 0}, {2.0 * h, 0.1 * h, 1}}) {
    const Blank b = with_crumb(above);
    WorkingCloud work(b.cloud, b.node);
    Structure structure = build_structure(b.cloud);
    PassReport report;
    join_crumbs(work, structure, {.thinnest_film = thinnest}, report);
    const Resampling<2> change = work.finish();
    EXPECT_EQ(report.crumbs, crumbs) << above << " " << thinnest;
    EXPECT_EQ(report.undone, 0);
    EXPECT_EQ(testing::loops(change.cloud), 2 - crumbs);
    EXPECT_EQ(change.cloud.nodes(), b.cloud.nodes() - 4 * crumbs);
    expect_all_handed_on(change, b.node.mass.size());
    EXPECT_EQ(structure.mesh.triangle_of_node.size(), change.cloud.position.size());
  }
}

TEST(Film, crumbs_of_other_matter_or_with_the_last_facets_of_a_piece_stay) {
  Blank b = with_crumb(0.1 * h);
  const auto crumbs_of = [](const Blank& of) {
    WorkingCloud work(of.cloud, of.node);
    Structure structure = build_structure(of.cloud);
    PassReport report;
    join_crumbs(work, structure, {.piece = 1_piece, .thinnest_film = 0.1 * h}, report);
    return report.crumbs;
  };
  EXPECT_EQ(crumbs_of(b), 1);
  const std::size_t last = b.node.mass.size() - 1;
  b.node.held[as<NodeIndex>(last)] = 1;
  EXPECT_EQ(crumbs_of(b), 1) << "a corner of nothing";
  b.cloud.piece_names = {"boundary", "fracture", "bed"};
  b.cloud.facets.back().piece = 1_piece;
  EXPECT_EQ(crumbs_of(b), 1) << "faces of cuts may go";
  b.cloud.facets.back().piece = 2_piece;
  EXPECT_EQ(crumbs_of(b), 0) << "what is prescribed on a piece would have nothing to act on";
  b.cloud.facets.front().piece = 2_piece;
  EXPECT_EQ(crumbs_of(b), 1);
  b.node.part.assign(last + 1, 0);
  for (std::size_t i = last - 3; i <= last; ++i) b.node.part[i] = 1;
  EXPECT_EQ(crumbs_of(b), 0);
}

TEST(Film, whose_end_would_be_a_crumb_stays_whole_unless_it_is_next_to_nothing) {
  for (const auto& [thickness, films] : {std::pair{0.1, 0}, {0.01, 1}}) {
    const Waisted b(thickness * h, 2.0);
    PassReport report;
    const Resampling<2> change = b.cut(report, {.piece = 1_piece, .least_loop = 100});
    EXPECT_EQ(report.films, films) << thickness;
    EXPECT_EQ(testing::loops(change.cloud), 1 + films) << thickness;
  }
}

TEST(Film, that_was_cut_goes_through_the_rest_of_the_pass) {
  const Waisted b(0.1 * h, 2.0);
  PassReport report;
  const Resampling<2> change =
      resample(b.cloud, structure_if_valid(b.cloud), b.node, {.split = {.piece = 1_piece}}, report);
  EXPECT_EQ(report.cuts, 1);
  EXPECT_EQ(report.undone, 0);
  EXPECT_EQ(testing::loops(change.cloud), 2);
  expect_all_handed_on(change, b.node.mass.size());
  Field mass = b.node.mass;
  double before = 0.0, after = 0.0;
  for (const double m : mass) before += m;
  carry_sum(change.parcels, mass);
  for (const double m : mass) after += m;
  EXPECT_NEAR(after, before, 1e-14);
}

/// A strip as thin as a film, drawn out to edges of `edge`, opposite whose middles nodes of the other face
/// are.
Blank drawn_out(double edge, double thickness) {
  Blank b;
  std::vector<Vec2> corners;
  const int count = 6;
  for (int k = 0; k <= count; ++k) corners.emplace_back(edge * k, 0.0);
  corners.emplace_back(edge * count, thickness);
  for (int k = count - 1; k >= 0; --k) corners.emplace_back(edge * (k + 0.5), thickness);
  corners.emplace_back(0.0, thickness);
  testing::add_loop(b.cloud, corners, 2.0 * edge);
  b.cloud.piece_names = {"boundary"};
  b.weigh(h);
  return b;
}

double longest_edge(const Cloud<2>& cloud) {
  double longest = 0.0;
  for (const Facet<2>& facet : cloud.facets)
    longest = std::max(longest, (cloud.position[facet.node[1]] - cloud.position[facet.node[0]]).norm());
  return longest;
}

TEST(Film, edges_drawn_out_are_split_though_the_other_face_is_near) {
  for (const double edge : {2.5, 5.0}) {
    const Blank b = drawn_out(edge * h, 0.4 * h);
    PassReport report;
    const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
    EXPECT_GT(report.inserted_boundary, 0);
    EXPECT_EQ(report.undone, 0);
    EXPECT_LE(longest_edge(change.cloud), Thresholds().film_edge * h);
    EXPECT_NEAR(testing::area(change.cloud), testing::area(b.cloud), 1e-12);
    expect_all_handed_on(change, b.node.mass.size());
  }
}

TEST(Film, edges_a_little_too_long_wait_where_the_other_face_is_near) {
  const Blank b = drawn_out(1.8 * h, 0.4 * h);
  PassReport report;
  resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
  EXPECT_EQ(report.inserted_boundary, 0);
}

} // namespace
} // namespace cnem::adapt
