// Nodes that go from the boundary: slits, slivers, faces that touch.
#include "tests/conservation/blank.hpp"

#include "core/index.hpp"
#include "tests/index_literals.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <numeric>
#include <tuple>

namespace cnem::adapt {

using namespace testing::literals;
namespace {

/// Three nodes in the lower side make a slit that narrows upwards.
std::array<std::size_t, 3> cut_slit(Blank& b, double depth, double mouth = 0.006) {
  const auto at = [&](double x) {
    for (std::size_t i = 0; i < b.cloud.position.size(); ++i)
      if (std::abs(b.cloud.position[i].x() - x) < 1e-9 && b.cloud.position[i].y() == 0.0) return i;
    return std::size_t{0};
  };
  const std::array<std::size_t, 3> slit{at(0.4), at(0.5), at(0.6)};
  b.cloud.position[slit[0]].x() = 0.5 - 0.5 * mouth;
  b.cloud.position[slit[1]].y() = depth;
  b.cloud.position[slit[2]].x() = 0.5 + 0.5 * mouth;
  return slit;
}

double shortest_facet(const Cloud<2>& cloud) {
  double shortest = 1.0;
  for (const Facet<2>& facet : cloud.facets)
    shortest = std::min(shortest, (cloud.position[facet.node[1]] - cloud.position[facet.node[0]]).norm());
  return shortest;
}

// Metal that folds at the edge of a tool leaves laps whose lips stand a twentieth of a spacing apart.
TEST(Thin, shallow_slits_are_closed) {
  for (const auto& [depth, mouth] :
       {std::pair{0.035, 0.006}, std::pair{0.055, 0.006}, std::pair{0.042, 0.036}, std::pair{0.045, 0.05}}) {
    Blank b = blank(0.1);
    const std::size_t bottom = cut_slit(b, depth, mouth)[1];
    PassReport report;
    const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
    EXPECT_EQ(change.new_of[bottom], NodeIndex::none) << depth;
    EXPECT_GT(shortest_facet(change.cloud), 0.03) << depth;
    EXPECT_NEAR(testing::area(change.cloud), 0.6, 1e-3 * 0.6) << depth;
  }
}

/// A step of this height in the lower side, its facet short; `before`, `of_step`, `behind`: pieces.
struct Stepped : Blank {
  NodeIndex foot{}, head{}; ///< of the step
  Stepped(double height, std::array<PieceIndex, 3> pieces) {
    testing::add_loop(cloud, {{0.0, 0.0}, {0.5, 0.0}, {0.5, height}, {1.0, height}, {1.0, 0.6}, {0.0, 0.6}},
                      0.1);
    testing::fill(cloud, testing::Lattice::hexagonal, 0.1, 0.2, 0.05, 1);
    weigh(0.1);
    cloud.piece_names = {"before", "step", "behind", "fracture", "rest"};
    for (Facet<2>& facet : cloud.facets) {
      const Vec2 &from = cloud.position[facet.node[0]], &to = cloud.position[facet.node[1]];
      facet.piece = 4_piece;
      if (from.y() == 0.0 && to.y() == 0.0) facet.piece = pieces[0];
      if (from.y() == height && to.y() == height) facet.piece = pieces[2];
      if ((to - from).norm() > 0.01) continue;
      facet.piece = pieces[1];
      foot = facet.node[0];
      head = facet.node[1];
      for (const NodeIndex i : facet.node) node.held[i] = 1;
    }
  }
};

// Beside a fibre that ends at a corner the matrix has a facet of its own, which is pressed together.
TEST(Thin, a_short_facet_between_corners_goes_unless_it_is_the_last_of_its_piece) {
  for (const auto& [height, pieces, goes] : {std::tuple{0.004, std::array{0_piece, 4_piece, 2_piece}, true},
                                             {0.006, std::array{0_piece, 4_piece, 2_piece}, false},
                                             {0.004, std::array{0_piece, 1_piece, 2_piece}, false},
                                             {0.004, std::array{0_piece, 3_piece, 3_piece}, true}}) {
    const Stepped b(height, pieces);
    WorkingCloud work(b.cloud, b.node, 3_piece);
    Structure structure = build_structure(b.cloud);
    PassReport report;
    join_ends(work, structure, report);
    const Resampling<2> change = work.finish();
    EXPECT_EQ(exists(change.new_of[b.foot]) && exists(change.new_of[b.head]), !goes) << height;
    EXPECT_EQ(report.removed_boundary, goes ? 1 : 0);
    EXPECT_EQ(report.undone, 0);
    EXPECT_EQ(shortest_facet(change.cloud) > 0.05, goes);
    EXPECT_EQ(structure.mesh.triangle_of_node.size(), change.cloud.position.size());
    double mass = 0.0;
    for (std::size_t e = 0; e < change.parcels.from.size(); ++e)
      mass += change.parcels.weight[e] * b.node.mass[index_of(change.parcels.from[e])];
    EXPECT_NEAR(mass, std::accumulate(b.node.mass.begin(), b.node.mass.end(), 0.0), 1e-14);
    for (const Facet<2>& facet : change.cloud.facets) { // each piece goes on to its end
      const Vec2 &from = change.cloud.position[facet.node[0]], &to = change.cloud.position[facet.node[1]];
      const bool ends = from.y() < 0.3 && to.y() < 0.3 && to.x() == 0.5 && from.x() < 0.5;
      if (ends && pieces[1] != 3_piece) { EXPECT_EQ(facet.piece, pieces[0]); }
      if (from.x() == 0.5 && to.x() > 0.5) { EXPECT_EQ(facet.piece, pieces[2]); }
    }
  }
}

// The free piece takes over from what lies before it: that has to be no last facet.
TEST(Thin, a_short_free_facet_does_not_take_the_last_one_of_a_piece_with_it) {
  for (const bool last : {false, true}) {
    Stepped b(0.004, {0_piece, 3_piece, 2_piece});
    for (Facet<2>& facet : b.cloud.facets)
      if (facet.piece == 0_piece && (!last || facet.node[1] != b.foot))
        facet.piece = last ? 4_piece : 0_piece;
    WorkingCloud work(b.cloud, b.node, 3_piece);
    Structure structure = build_structure(b.cloud);
    PassReport report;
    join_ends(work, structure, report);
    const Resampling<2> change = work.finish();
    EXPECT_TRUE(std::any_of(change.cloud.facets.begin(), change.cloud.facets.end(),
                            [](const Facet<2>& facet) { return facet.piece == 0_piece; }));
  }
}

// Cuts of films end where they find the other face: a facet of 3 nm was left of the face of a fibre.
TEST(Thin, a_short_facet_between_free_ones_goes_unless_it_is_the_last_of_its_piece) {
  constexpr PieceIndex named = 0_piece, free = 1_piece;
  for (const bool last : {false, true}) {
    Blank b = blank(0.1);
    const auto [before, start, end] = cut_slit(b, 0.0);
    b.cloud.position[before].x() = 0.4;
    b.cloud.position[end].x() = 0.503;
    for (Facet<2>& facet : b.cloud.facets) {
      const Vec2 middle = 0.5 * (b.cloud.position[facet.node[0]] + b.cloud.position[facet.node[1]]);
      const bool is_short = index_of(facet.node[0]) == start && index_of(facet.node[1]) == end;
      facet.piece = is_short || (!last && middle.y() > 0.599) ? named : free;
    }
    PassReport report;
    const Resampling<2> change =
        resample(b.cloud, structure_if_valid(b.cloud), b.node, {.split = {.piece = free}}, report);
    EXPECT_EQ(exists(change.new_of[start]) && exists(change.new_of[end]), last);
    EXPECT_EQ(shortest_facet(change.cloud) < 0.01, last);
    EXPECT_TRUE(std::any_of(change.cloud.facets.begin(), change.cloud.facets.end(),
                            [&](const Facet<2>& facet) { return facet.piece == named; }));
    EXPECT_NEAR(testing::area(change.cloud), 0.6, 1e-9);
  }
}

TEST(Thin, slits_stay_where_they_are_deep_or_blunt_or_their_lips_must_stay) {
  for (const auto& [depth, mouth, held] :
       {std::tuple{0.08, 0.006, false}, {0.035, 0.06, false}, {0.035, 0.006, true}}) {
    Blank b = blank(0.1);
    const auto [before, bottom, after] = cut_slit(b, depth, mouth);
    if (held) b.node.held[before] = b.node.held[after] = 1;
    PassReport report;
    const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
    EXPECT_TRUE(exists(change.new_of[bottom])) << depth << ' ' << mouth << ' ' << held;
  }
}

// A tip beside a notch, with a cell that would hold the step: of the two triangles the notch's is the
// smaller.
TEST(Thin, slivers_at_the_boundary_go) {
  const std::array<Vec2, 4> notched{Vec2(0.5, 0.029), {0.5, -0.1}, {0.534, -0.07}, {0.545, -0.119}},
      single{Vec2(0.47, 0.0), {0.5, -0.05}, {0.52, 0.0}, {0.6, 0.0}};
  for (const auto& outline : {notched, single}) {
    Blank b = blank(0.1);
    std::array<std::size_t, 4> at{};
    for (std::size_t i = 0; i < b.cloud.position.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k)
        if ((b.cloud.position[i] - Vec2(0.4 + 0.1 * static_cast<double>(k), 0.0)).norm() < 1e-9) at[k] = i;
    for (std::size_t k = 0; k < 4; ++k) b.cloud.position[at[k]] = outline[k];
    const std::size_t tip = at[1], bottom = at[2];
    const std::optional<Structure> structure = structure_if_valid(b.cloud);
    ASSERT_TRUE(structure);
    ASSERT_LT(structure->cells.volume[tip], 0.05 * 0.01);
    PassReport report;
    const Resampling<2> change = resample(b.cloud, structure, b.node, {}, report);
    EXPECT_EQ(!exists(change.new_of[tip]), outline == single);
    EXPECT_EQ(!exists(change.new_of[bottom]), outline == notched);
  }
}

// A tail whose two sides have changed places.
TEST(Mend, a_film_that_is_drawn_through_itself_is_cut_off) {
  Blank b;
  testing::add_loop(
      b.cloud,
      {{0, 0}, {0.4, 0}, {0.45, -0.05}, {0.5, -0.3}, {0.55, -0.05}, {0.6, 0}, {1, 0}, {1, 0.6}, {0, 0.6}},
      0.1);
  testing::fill(b.cloud, testing::Lattice::hexagonal, 0.1, 0.0, 0.05, 1);
  b.weigh(0.1);
  double mass = 0.0;
  for (const double m : b.node.mass) mass += m;
  for (Vec2& x : b.cloud.position)
    if (x.y() < -0.01 && x.y() > -0.2) x.x() = 1.0 - x.x();
  ASSERT_FALSE(structure_if_valid(b.cloud));
  PassReport report;
  const Resampling<2> change = resample(b.cloud, std::nullopt, b.node, {}, report);
  EXPECT_GE(report.folded, 3);
  for (const Vec2& x : change.cloud.position) EXPECT_GT(x.y(), -0.1);
  Field after = b.node.mass;
  carry_sum(change.parcels, after);
  for (const double m : after) mass -= m;
  EXPECT_NEAR(mass, 0.0, 1e-12);
}

// Which part of a small body is the film: not the one with most of its nodes.
TEST(Mend, what_is_cut_off_is_the_smaller_part) {
  Blank b;
  testing::add_loop(b.cloud,
                    {{0, 0},
                     {0.1, -0.1},
                     {0.2, -0.1},
                     {0.3, 0},
                     {0.2, 0.1},
                     {0.1, 0.1},
                     {0, 0.02},
                     {-0.1, 0.03},
                     {-0.1, -0.01}},
                    1.0);
  b.weigh(0.1);
  const auto n = static_cast<double>(b.cloud.nodes());
  for (Vec2& x : b.cloud.position) // the neck crosses
    if (x.x() == 0.0) x.y() = 0.02 - x.y();
  PassReport report;
  WorkingCloud work(b.cloud, b.node);
  mend_boundary(work, report);
  EXPECT_GE(report.folded, 1);
  EXPECT_GT(static_cast<double>(work.size()), 0.5 * n);
  for (const Vec2& x : {Vec2(0.2, -0.1), Vec2(0.3, 0.0), Vec2(0.2, 0.1)})
    EXPECT_TRUE(std::any_of(work.cloud().position.begin(), work.cloud().position.end(),
                            [&](const Vec2& y) { return (x - y).norm() < 1e-12; }));
}

// Ends of the faces that a cut made hold nothing, those of a named piece do; and no piece is used up.
TEST(WorkingCloud, ends_of_the_free_piece_may_go) {
  Blank b = blank(0.1, 0.0);
  b.cloud.piece_names = {"boundary", "fracture"};
  NodeIndex start = NodeIndex::none;
  for (Facet<2>& facet : b.cloud.facets) {
    const double x = b.cloud.position[facet.node[0]].x(), y = b.cloud.position[facet.node[0]].y();
    if (y == 0.0 && x > 0.39 && x < 0.59) facet.piece = 1_piece;
    if (y == 0.0 && std::abs(x - 0.4) < 1e-9) start = facet.node[0];
  }
  const WorkingCloud named(b.cloud, b.node);
  EXPECT_TRUE(named.ends_piece(start));
  WorkingCloud work(b.cloud, b.node, 1_piece);
  EXPECT_FALSE(work.ends_piece(start));
  const NodeIndex before = work.previous(start);
  EXPECT_EQ(work.piece(before), 0_piece);
  work.bypass(start);
  EXPECT_EQ(work.piece(before), 1_piece) << "the named piece does not grow";
  for (Facet<2>& facet : b.cloud.facets) facet.piece = facet.node[0] == before ? 0_piece : 1_piece;
  EXPECT_TRUE(WorkingCloud(b.cloud, b.node, 1_piece).ends_piece(start)) << "its last facet";
}

// A notch that another body reaches into.
TEST(Thin, the_boundary_is_not_laid_across_what_touches_it_but_for_a_little) {
  for (const double reach : {0.01, 0.003}) {
    Blank b;
    testing::add_loop(b.cloud, {{0, 0}, {1, 0}, {1, 0.6}, {0.52, 0.6}, {0.5, 0.57}, {0.48, 0.6}, {0, 0.6}},
                      0.1);
    testing::add_loop(b.cloud, {{0.5, 0.6 - reach}, {0.7, 0.9}, {0.3, 0.9}}, 0.1);
    b.cloud.piece_names = {"boundary"};
    testing::fill(b.cloud, testing::Lattice::hexagonal, 0.1, 0.0, 0.05, 1);
    const auto twin = b.cloud.position.size(); // crowds an inner node
    Vec2 inner = Vec2::Zero();
    for (const Vec2& x : b.cloud.position)
      if ((x - Vec2(0.25, 0.3)).norm() < (inner - Vec2(0.25, 0.3)).norm()) inner = x;
    b.cloud.position.push_back(inner + Vec2(0.02, 0.01));
    const Structure structure = build_structure(b.cloud);
    const std::size_t n = b.cloud.position.size();
    b.weigh(0.1);
    b.node.held.assign(n, 1);
    std::size_t bottom = 0, tip = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if ((b.cloud.position[i] - Vec2(0.5, 0.57)).norm() < 1e-9) bottom = i;
      if ((b.cloud.position[i] - Vec2(0.5, 0.6 - reach)).norm() < 1e-9) tip = i;
    }
    for (const std::size_t i : {bottom, twin}) b.node.held[i] = 0;
    b.node.held[tip] = 0;
    PassReport report;
    const Resampling<2> change = resample(b.cloud, structure, b.node, {}, report);
    EXPECT_EQ(report.undone, 0);
    EXPECT_EQ(change.new_of[twin], NodeIndex::none);
    EXPECT_EQ(!exists(change.new_of[bottom]), reach < 0.005) << reach;
    EXPECT_TRUE(structure_if_valid(change.cloud));
  }
}

} // namespace
} // namespace cnem::adapt
