// Where cuts are and whose faces lie there: a hand-made cloud of slug and skeletons, in every position.
#include "core/index.hpp"
#include "evaluate/blanking.hpp"

#include "tests/clouds.hpp"
#include "tests/degree.hpp"
#include "tests/index_literals.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::evaluate {

using namespace testing::literals;
namespace {

/// A full blank, 1 thick, cut on both sides by a punch from x = −2 to 2 and dies from |x| = 2.1 on. The punch
/// has come down by 1.3; the slug hangs below.
struct Blank {
  Cloud<2> cloud;
  std::vector<std::int32_t> part;
  Field volume;
  CutTools tools;
  std::vector<Vec2> outline{{-6, 0}, {6, 0}, {6, 1}, {-6, 1}};
  double spacing = 0.02;

  /// Corners counter-clockwise; facets between the two given heights near |x| = 2 are fracture.
  void add(const std::vector<Vec2>& corner, const std::vector<std::size_t>& broken) {
    const auto number = static_cast<std::int32_t>(part.empty() ? 0 : part.back() + 1);
    const NodeIndex first = cloud.position.next();
    testing::add_loop(cloud, corner, spacing);
    std::size_t side = 0;
    for (Facet<2>& facet : cloud.facets) {
      if (facet.node[0] < first) continue;
      const Vec2& x = cloud.position[facet.node[0]];
      while (side + 1 < corner.size() && (x - corner[side + 1]).norm() < 1e-12) ++side;
      facet.piece = std::find(broken.begin(), broken.end(), side) != broken.end() ? 1_piece : 0_piece;
    }
    Vec2 low = corner.front(), high = low;
    for (const Vec2& x : corner) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    for (double x = low.x() + 0.2; x < high.x() - 0.15; x += 0.1) // some inner nodes
      cloud.position.emplace_back(x, 0.5 * (low.y() + high.y()));
    part.resize(cloud.position.size(), number);
    volume.resize(cloud.position.size(), 0.01);
  }

  Blank() {
    cloud.piece_names = {"boundary", "fracture"};
    const double drop = -1.3;
    // slug: drawn in below (0.12), smooth (0.28), fractured, burr of 0.05 above
    add({{-1.8, drop},
         {1.8, drop},
         {2.1, drop + 0.12},
         {2.1, drop + 0.4},
         {2.05, drop + 1.05},
         {1.98, drop + 1.0},
         {-1.98, drop + 1.0},
         {-2.05, drop + 1.05},
         {-2.1, drop + 0.4},
         {-2.1, drop + 0.12}},
        {3, 7});
    // right skeleton: drawn in above (0.2), smooth (0.3), fractured, burr of 0.03 below
    add({{6.0, 0.0}, {6.0, 1.0}, {2.4, 1.0}, {2.0, 0.8}, {2.0, 0.5}, {2.08, -0.03}, {2.12, 0.0}}, {4});
    // left one: drawn in 0.1, smooth 0.2, no burr
    add({{-6.0, 0.0}, {-2.1, 0.0}, {-2.0, 0.7}, {-2.0, 0.9}, {-2.2, 1.0}, {-6.0, 1.0}}, {1});
    tools.punch = {{-2, 1 - 1.3}, {2, 1 - 1.3}, {2, 4}, {-2, 4}};
    tools.die = {{2.1, 0}, {2.1, -4}, {7, -4}, {7, 0}, {-2.1, 0}, {-7, 0}, {-7, -4}, {-2.1, -4}};
  }

  /// Everything turned about the origin and mirrored at its new vertical axis.
  void move(double angle, bool mirrored) {
    const auto moved = [&](Vec2& x) {
      x = Vec2(std::cos(angle) * x.x() - std::sin(angle) * x.y(),
               std::sin(angle) * x.x() + std::cos(angle) * x.y());
      if (mirrored) x.x() = -x.x();
    };
    for (Vec2& x : cloud.position) moved(x);
    for (auto* list : {&tools.punch, &tools.die, &outline})
      for (Vec2& x : *list) moved(x);
    moved(tools.direction);
    if (mirrored) // the domain stays on the left of its facets
      for (Facet<2>& facet : cloud.facets) std::swap(facet.node[0], facet.node[1]);
  }

  CutSheet sheet() const {
    return {cloud.position, cloud.facets, 1_piece, part, volume, std::vector<char>(part.size(), 0), outline};
  }
  std::vector<ShearedFace> faces() const {
    std::vector<ShearedFace> all;
    const CutSheet cut_sheet = sheet();
    for (const Cut& cut : find_cuts(tools, cut_sheet))
      for (ShearedFace& face : measure_cut(cut, tools, cut_sheet, 10.0 * degree, 0.0))
        all.push_back(std::move(face));
    return all;
  }
};

const ShearedFace& face_of(const std::vector<ShearedFace>& faces, const std::string& cut,
                           const std::string& body) {
  for (const ShearedFace& face : faces)
    if (face.cut == cut && face.body == body) return face;
  ADD_FAILURE() << "no face of " << body << ' ' << cut;
  return faces.front();
}

void expect_face(const ShearedFace& face, double rollover, double burnish, double burr, double angle) {
  EXPECT_TRUE(face.parted);
  EXPECT_NEAR(face.rollover, rollover, 0.006);
  EXPECT_NEAR(face.burnish, burnish, 0.006);
  EXPECT_NEAR(face.fracture, 1.0 - rollover - burnish, 0.006);
  EXPECT_NEAR(face.burr, burr, 1e-6);
  EXPECT_NEAR(face.fracture_angle, angle, 1e-6);
  EXPECT_NEAR(face.thickness, 1.0, 1e-12);
}

TEST(Blanking, faces_of_a_separated_blank_in_any_position) {
  for (const double angle : {0.0, 90.0, 37.0, 180.0, -110.0})
    for (const bool mirrored : {false, true}) {
      SCOPED_TRACE(::testing::Message() << angle << (mirrored ? " mirrored" : ""));
      Blank blank;
      blank.move(angle * degree, mirrored);
      const std::vector<ShearedFace> faces = blank.faces();
      ASSERT_EQ(faces.size(), 4U);
      // "right" is that of a punch that goes down
      const std::string right = mirrored ? "left" : "right", left = mirrored ? "right" : "left";
      for (const std::string& side : {left, right})
        expect_face(face_of(faces, side, "slug"), 0.12, 0.28, 0.05, std::atan(0.05 / 0.65));
      expect_face(face_of(faces, right, "skeleton"), 0.2, 0.3, 0.03, std::atan(0.08 / 0.53));
      expect_face(face_of(faces, left, "skeleton"), 0.1, 0.2, 0.0, std::atan(0.1 / 0.7));
    }
}

TEST(Blanking, a_skeleton_that_has_turned_by_60_degrees_is_measured_as_before) {
  for (const double angle : {60.0, -60.0}) {
    SCOPED_TRACE(angle);
    Blank blank;
    CutSheet sheet = blank.sheet();
    sheet.initial = sheet.position;
    const Vec2 pivot(2.0, 0.5);
    for (std::size_t i = 0; i < sheet.part.size(); ++i) {
      if (sheet.part[i] != 1) continue;
      const Vec2 d = sheet.position[i] - pivot;
      sheet.position[i] = pivot + Vec2(std::cos(angle * degree) * d.x() - std::sin(angle * degree) * d.y(),
                                       std::sin(angle * degree) * d.x() + std::cos(angle * degree) * d.y());
    }
    Cut cut = find_cuts(blank.tools, sheet).back();
    cut.slug = 0;
    cut.skeleton = 1;
    const std::vector<ShearedFace> faces = measure_cut(cut, blank.tools, sheet, 10.0 * degree, 0.0);
    EXPECT_TRUE(faces[1].measured);
    expect_face(faces[1], 0.2, 0.3, 0.03, std::atan(0.08 / 0.53));
    EXPECT_NEAR(std::abs(faces[1].tilt), 60.0 * degree, 1e-6);
    expect_face(faces[0], 0.12, 0.28, 0.05, std::atan(0.05 / 0.65));
  }
}

TEST(Blanking, walls_of_holes_and_broken_metal_are_told_from_burnish) {
  Blank blank;
  CutSheet sheet = blank.sheet();
  sheet.broken.assign(sheet.part.size(), 0);
  const IndexedVector<CloudFacetIndex, Facet<2>>& facets = blank.cloud.facets;
  for (std::size_t i = 0; i < sheet.part.size(); ++i) // of the right face of the slug, below its fracture
    sheet.broken[i] =
        std::abs(sheet.position[i].x() - 2.1) < 1e-9 && sheet.position[i].y() > -1.3 + 0.3 - 1e-9;
  auto with_hole = facets;
  for (Facet<2>& facet : with_hole) { // on the smooth part of the right skeleton
    const Vec2 middle = 0.5 * (blank.cloud.position[facet.node[0]] + blank.cloud.position[facet.node[1]]);
    if (std::abs(middle.x() - 2.0) < 1e-9 && middle.y() > 0.6 && middle.y() < 0.7) facet.piece = 2_piece;
  }
  const CutSheet marked{sheet.position,
                        with_hole,
                        sheet.fracture_piece,
                        sheet.part,
                        sheet.volume,
                        sheet.on_plane,
                        sheet.initial_outline,
                        {2_piece},
                        {},
                        sheet.broken};
  const std::vector<ShearedFace> faces =
      measure_cut(find_cuts(blank.tools, marked).back(), blank.tools, marked, 10.0 * degree, 0.0);
  EXPECT_NEAR(faces[0].broken, 0.1, 0.021);
  EXPECT_NEAR(faces[0].broken + faces[0].burnish, 0.28, 0.006);
  EXPECT_EQ(faces[0].hole, 0.0);
  EXPECT_NEAR(faces[1].hole, 0.1, 0.021);
  EXPECT_NEAR(faces[1].hole + faces[1].burnish, 0.3, 0.006);
  EXPECT_EQ(faces[1].broken, 0.0);
  EXPECT_NE(faces[1].note.find("a hole lies in the face"), std::string::npos) << faces[1].note;
}

TEST(Blanking, clearance_thickness_and_parts_of_a_cut) {
  const Blank blank;
  const CutSheet sheet = blank.sheet();
  const std::vector<Cut> cuts = find_cuts(blank.tools, sheet);
  ASSERT_EQ(cuts.size(), 2U);
  EXPECT_EQ(cuts[1].name, "right");
  EXPECT_DOUBLE_EQ(cuts[1].die - cuts[1].punch, 2.1 - 2.0);
  EXPECT_EQ(cuts[1].slug, 0);
  EXPECT_EQ(cuts[1].skeleton, 1);
  EXPECT_EQ(cuts[0].skeleton, 2);
}

TEST(Blanking, one_die_makes_one_cut_and_no_sheet_makes_none) {
  Blank blank;
  blank.tools.die = {{2.1, 0}, {2.1, -4}, {7, -4}, {7, 0}};
  std::vector<Cut> cuts = find_cuts(blank.tools, blank.sheet());
  ASSERT_EQ(cuts.size(), 1U);
  EXPECT_EQ(cuts[0].name, "");
  blank.outline = {{-1, 0}, {1, 0}, {1, 1}, {-1, 1}};
  EXPECT_TRUE(find_cuts(blank.tools, blank.sheet()).empty());
}

TEST(Blanking, letting_go_turns_skeletons_and_flattens_the_slug) {
  for (const double angle : {0.0, 37.0}) {
    Blank blank;
    const Cloud<2> straight = blank.cloud;
    blank.move(angle * degree, false);
    const CutSheet sheet = blank.sheet();
    Fields<2> displacement;
    resize_all(displacement, sheet.position.size());
    const Vec2 down = blank.tools.direction;
    for (std::size_t i = 0; i < sheet.position.size(); ++i) {
      const double x = straight.position[i].x();
      // the slug's middle rises by 0.002 against its ends at |x| = 2.1; the right skeleton's far end goes
      // down
      const double s = sheet.part[i] == 0   ? -0.002 * (1.0 - x * x / (2.1 * 2.1))
                       : sheet.part[i] == 1 ? 0.001 * (x - 2.0)
                                            : 0.0;
      for (std::size_t k = 0; k < 2; ++k) displacement[k][i] = s * down[static_cast<Eigen::Index>(k)];
    }
    const auto bodies = springback_of_bodies(find_cuts(blank.tools, sheet), blank.tools, sheet, displacement,
                                             Field(sheet.position.size(), 1.0));
    ASSERT_EQ(bodies.size(), 3U);
    EXPECT_EQ(bodies[0].body, "slug");
    EXPECT_NEAR(bodies[0].dishing_change, -0.002, 1e-9);
    EXPECT_NEAR(bodies[0].angle_change, 0.0, 1e-9);
    EXPECT_NEAR(bodies[0].largest, 0.002, 1e-4);
    EXPECT_EQ(bodies[1].body, "skeleton_left");
    EXPECT_NEAR(bodies[1].angle_change, 0.0, 1e-12);
    EXPECT_EQ(bodies[2].body, "skeleton_right");
    EXPECT_NEAR(bodies[2].angle_change, 0.001, 1e-6);
    EXPECT_NEAR(bodies[2].largest, 0.004, 1e-12);
  }
}

} // namespace
} // namespace cnem::evaluate
