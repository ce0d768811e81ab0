// Sides of a slice between periodic planes that the skin has dragged until they lie flat below it are cut
// anew: tetrahedra go over to the other side.
#include "adapt/space/seams.hpp"
#include "clouds/tetrahedral_block.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/mates.hpp"
#include "core/operators/parcels.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/crossings.hpp"
#include "voronoi/space/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace cnem::adapt {
namespace {

using testing::piece_of;

/// A cube of unit density, periodic along x, whose nodes have been moved.
struct Slice {
  static constexpr int cells = 6;
  static constexpr double h = 1.0 / cells;
  clouds::TetrahedralBlock block;
  SpaceRules rules;
  SpaceStructure structure;
  WorkingBody body;
  Vec3 shift{1.0, 0.0, 0.0};

  explicit Slice(const std::function<Vec3(const Vec3&)>& place = [](const Vec3& x) { return x; })
      : block(clouds::tetrahedral_block({1, 1, 1}, {cells, cells, cells}, place)),
        rules(rules_of(block.cloud)),
        structure(structure_of(block.cloud, voronoi::connected(block.cloud, block.tetrahedra))),
        body(block.cloud, properties()) {}

  static SpaceRules rules_of(const Cloud<3>& cloud) {
    SpaceRules rules;
    rules.periods.push_back({piece_of(cloud, "x-"), piece_of(cloud, "x+")});
    rules.surface.still.assign(rules.periods[0].begin(), rules.periods[0].end());
    return rules;
  }
  NodeProperties properties() const {
    const std::size_t n = block.cloud.position.size();
    return {.mass = structure.cell,
            .jacobian = Field(n, 1.0),
            .density = Field(n, 1.0),
            .size = Field(n, h),
            .held = IndexedVector<NodeIndex, char>(n, 0),
            .broken = {}};
  }
  void hold() { // all nodes
    NodeProperties p = properties();
    std::fill(p.held.begin(), p.held.end(), 1);
    body = WorkingBody(block.cloud, std::move(p));
  }
  double side_area() const {
    double sum = 0.0;
    for (const Facet<3>& facet : body.cloud().facets)
      if (rules.surface.is_still(facet.piece))
        sum += area_normal<3>(corners_of<3>(facet, body.cloud().position)).norm();
    return sum;
  }
  void repeat(const std::string& axis) {
    rules.periods.push_back({piece_of(block.cloud, axis + "-"), piece_of(block.cloud, axis + "+")});
    rules.surface.still.insert(rules.surface.still.end(), rules.periods.back().begin(),
                               rules.periods.back().end());
  }
  std::vector<SimplexIndex> inside(const std::function<bool(const Vec3&)>& region) const {
    std::vector<SimplexIndex> list;
    for (const SimplexIndex t : structure.mesh.node.indices()) {
      Vec3 centre = Vec3::Zero();
      for (const NodeIndex i : structure.mesh.node[t]) centre += 0.25 * body.at(i);
      if (region(centre)) list.push_back(t);
    }
    return list;
  }
  /// The number that went over of these.
  int hand(const std::vector<SimplexIndex>& list) {
    IndexedVector<SimplexIndex, char> goes(structure.mesh.node.size(), 0);
    for (const SimplexIndex t : list) goes[t] = 1;
    PassReport report;
    const std::size_t nodes = body.size();
    const int gone = hand_over(body, structure, rules, goes, report);
    EXPECT_EQ(report.recut, gone);
    EXPECT_EQ(static_cast<int>(body.size()) - static_cast<int>(nodes),
              report.inserted_boundary - report.removed_boundary);
    return gone;
  }

  /// What holds whatever has gone over.
  void expect_whole() const {
    const Cloud<3>& cloud = body.cloud();
    EXPECT_NEAR(enclosed_measure(cloud), enclosed_measure(block.cloud), 1e-13);
    EXPECT_TRUE(voronoi::crossings(cloud).empty());
    EXPECT_NO_THROW(voronoi::surface_edges(cloud));
    for (const auto& node : structure.mesh.node) EXPECT_GT(volume_of(cloud, node), 0.0);
    const std::vector<std::array<NodeIndex, 4>> nodes(structure.mesh.node.begin(), structure.mesh.node.end());
    const voronoi::Tetrahedra anew = voronoi::connected(cloud, nodes);
    EXPECT_EQ(structure.mesh.neighbour, anew.neighbour);
    EXPECT_EQ(structure.mesh.facet, anew.facet);
    EXPECT_EQ(structure.mesh.of_node, anew.of_node);
    for (const Period& period : rules.periods)
      for (const auto& [a, b] : shifted_nodes(cloud, period))
        if (period == rules.periods[0]) {
          EXPECT_LT((cloud.position[b] - cloud.position[a] - shift).norm(), 1e-13);
        }
    // matter goes with the volume that it fills
    for (const NodeIndex i : body.nodes()) EXPECT_NEAR(body.node().filled(i), structure.volume(i), 1e-13 * h);
    // and initial positions are labels: those of nodes that are made lie a period on
    const Resampling<3> change = body.finish(structure);
    for (Eigen::Index c = 0; c < 3; ++c) {
      Field label;
      for (const Vec3& x : block.cloud.position) label.push_back(x[c]);
      carry_label(change.labels, label);
      for (const NodeIndex p : change.cloud.position.indices())
        EXPECT_NEAR(label[index_of(p)], change.cloud.position[p][c], 1e-13);
    }
  }
};

// All of the layer at one end goes to the other, one tetrahedron after the other.
TEST(Seams, a_layer_goes_over) {
  for (const double end : {1.0, 0.0}) {
    Slice slice;
    const auto layer = slice.inside([&](const Vec3& x) { return std::abs(x.x() - end) < Slice::h; });
    EXPECT_EQ(slice.hand(layer), 6 * Slice::cells * Slice::cells);
    slice.expect_whole();
    EXPECT_EQ(slice.body.size(), slice.block.cloud.position.size());
    const double by = end == 1.0 ? -Slice::h : Slice::h;
    for (const Vec3& x : slice.body.cloud().position) {
      EXPECT_GT(x.x(), by - 1e-12);
      EXPECT_LT(x.x(), 1.0 + by + 1e-12);
    }
  }
}

TEST(Seams, single_tetrahedra_go_over_where_the_boundary_stays_a_manifold) {
  for (const bool two_periods : {false, true}) {
    int gone = 0, stayed = 0;
    const Slice whole;
    for (const SimplexIndex t : whole.structure.mesh.node.indices()) {
      if (whole.body.at(whole.structure.mesh.node[t][0]).x() < 0.5) continue;
      Slice slice;
      if (two_periods) slice.repeat("y");
      const bool goes = slice.hand({t}) == 1;
      (goes ? gone : stayed) += 1;
      if (goes) slice.expect_whole();
    }
    EXPECT_GT(gone, 30);
    EXPECT_GT(stayed, 50); // inner ones, and those with a corner on another face
  }
}

// Nothing goes to another body, to another material, or from under a condition.
TEST(Seams, what_may_not_mix_or_go_stays) {
  const auto layer = [](const Vec3& x) { return x.x() > 1.0 - Slice::h; };
  Slice bodies;
  for (const Vec3& x : bodies.block.cloud.position) bodies.block.cloud.body.push_back(x.x() > 0.5);
  bodies.body = WorkingBody(bodies.block.cloud, bodies.properties());
  EXPECT_EQ(bodies.hand(bodies.inside(layer)), 0);
  Slice parts;
  NodeProperties p = parts.properties();
  for (const Vec3& x : parts.block.cloud.position) p.part.push_back(x.x() > 0.5);
  parts.body = WorkingBody(parts.block.cloud, p);
  EXPECT_EQ(parts.hand(parts.inside(layer)), 0);
  Slice held;
  held.hold();
  EXPECT_EQ(held.hand(held.inside(layer)), 0);
}

/// The skin has gone by `lean` h along x, the layer `thick` h below it not; the body turned about z or not.
std::function<Vec3(const Vec3&)> dragged(double lean, double thick, double turn = 1.0) {
  return [=](const Vec3& x) {
    const bool skin = x.z() > 1.0 - 1e-9;
    return Vec3(turn * (skin ? x.x() + lean * Slice::h : x.x()), turn * x.y(),
                skin ? 1.0 - (1.0 - thick) * Slice::h : x.z());
  };
}

TEST(Seams, below_the_skin_are_cut_anew) {
  for (const double turn : {1.0, -1.0}) { // below one side and below the other
    Slice slice(dragged(-1.2, 0.3, turn));
    slice.shift *= turn;
    const double before = slice.side_area();
    PassReport report;
    EXPECT_TRUE(recut_sides(slice.body, slice.structure, slice.rules, report));
    slice.expect_whole();
    EXPECT_GE(report.recut, 2 * Slice::cells); // a row of prisms at least
    // what lies flat, of 1.24 h × 1 on either side, is 0.3 h deep now
    EXPECT_LT(slice.side_area(), before - 2.0 * (1.0 - 2.0 * Slice::h) * 0.5 * Slice::h);
    EXPECT_FALSE(recut_sides(slice.body, slice.structure, slice.rules, report)); // it is the least
  }
}

TEST(Seams, that_stand_upright_stay) {
  for (const double lean : {0.0, 0.5}) {
    Slice slice(dragged(lean, 1.0));
    PassReport report;
    EXPECT_FALSE(recut_sides(slice.body, slice.structure, slice.rules, report));
    EXPECT_EQ(report.recut, 0);
    EXPECT_EQ(slice.body.cloud().position, slice.block.cloud.position);
  }
}

TEST(Seams, that_are_held_stay) {
  Slice slice(dragged(-1.2, 0.3));
  slice.hold();
  PassReport report;
  EXPECT_FALSE(recut_sides(slice.body, slice.structure, slice.rules, report));
}

// Debris lies where the metal of the other side would come to.
TEST(Seams, do_not_cross_anything) {
  Slice slice(dragged(-1.2, 0.3));
  Cloud<3> cloud = slice.block.cloud;
  const auto& mesh = slice.structure.mesh.node;
  std::vector<std::array<NodeIndex, 4>> tetrahedra(mesh.begin(), mesh.end());
  std::array<NodeIndex, 4> debris;
  const Vec3 corner(1.0 - 0.2 * Slice::h, 0.45, 1.0 - 0.85 * Slice::h);
  for (std::size_t k = 0; k < 4; ++k) {
    debris[k] = cloud.position.next();
    cloud.position.push_back(
        corner + 0.1 * Slice::h * (k == 0 ? Vec3::Zero() : Vec3(Vec3::Unit(static_cast<int>(k) - 1))));
  }
  tetrahedra.push_back(debris);
  for (const auto& face : voronoi::face_of_tetrahedron)
    cloud.facets.push_back({{debris[face[0]], debris[face[1]], debris[face[2]]}, piece_of(cloud, "z-")});
  ASSERT_TRUE(voronoi::crossings(cloud).empty());
  slice.block.cloud = cloud;
  slice.structure = structure_of(cloud, voronoi::connected(cloud, tetrahedra));
  slice.body = WorkingBody(cloud, slice.properties());
  PassReport report;
  EXPECT_FALSE(recut_sides(slice.body, slice.structure, slice.rules, report));
  EXPECT_EQ(slice.body.cloud().position, cloud.position);
}

} // namespace
} // namespace cnem::adapt
