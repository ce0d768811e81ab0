// Sides of a slice between periodic planes that the skin has dragged until they lie flat below it are cut
// anew: tetrahedra go over to the other side.
#include "adapt/space/seams.hpp"
#include "clouds/tetrahedral_block.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/mates.hpp"
#include "core/operators/parcels.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/crossings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

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
        sum += 0.5 * area_normal<3>(corners_of<3>(facet, body.cloud().position)).norm();
    return sum;
  }
  IndexedVector<SimplexIndex, char> marks(const std::function<bool(const Vec3&)>& inside) const {
    IndexedVector<SimplexIndex, char> list;
    for (const auto& node : structure.mesh.node) {
      Vec3 centre = Vec3::Zero();
      for (const NodeIndex i : node) centre += 0.25 * body.at(i);
      list.push_back(inside(centre));
    }
    return list;
  }

  /// What holds whatever has gone over.
  void expect_whole() const {
    const Cloud<3>& cloud = body.cloud();
    EXPECT_NEAR(enclosed_measure(cloud), enclosed_measure(block.cloud), 1e-13);
    EXPECT_TRUE(voronoi::crossings(cloud).empty());
    for (const auto& [a, b] : shifted_nodes(cloud, rules.periods[0]))
      EXPECT_LT((cloud.position[b] - cloud.position[a] - shift).norm(), 1e-13);
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
    const auto layer = slice.marks([&](const Vec3& x) { return std::abs(x.x() - end) < Slice::h; });
    EXPECT_EQ(hand_over(slice.body, slice.structure, slice.rules, layer), 6 * Slice::cells * Slice::cells);
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
  int gone = 0, stayed = 0;
  const Slice whole;
  for (const SimplexIndex t : whole.structure.mesh.node.indices()) {
    if (whole.body.at(whole.structure.mesh.node[t][0]).x() < 0.5) continue;
    Slice slice;
    IndexedVector<SimplexIndex, char> one(slice.structure.mesh.node.size(), 0);
    one[t] = 1;
    const bool goes = hand_over(slice.body, slice.structure, slice.rules, one) == 1;
    (goes ? gone : stayed) += 1;
    if (goes) slice.expect_whole();
  }
  EXPECT_GT(gone, 50);
  EXPECT_GT(stayed, 50); // inner ones, and those with a corner on another face
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
