// Bodies in space as pictures show them.
#include "clouds/tetrahedral_block.hpp"
#include "core/geometry/facets.hpp"
#include "input/tool_surface.hpp"
#include "report/body_view.hpp"
#include "report/cell_raster.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace cnem::report {
namespace {

struct Block {
  clouds::TetrahedralBlock made = clouds::tetrahedral_block({2, 1, 1}, {4, 3, 3});
  Fields<3> position;
  Field value;

  Block() {
    resize_all(position, made.cloud.position.size());
    for (std::size_t i = 0; i < value_count(); ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        position[k][i] = made.cloud.position[i][static_cast<Eigen::Index>(k)];
      value.push_back(static_cast<double>(i));
    }
  }
  std::size_t value_count() const { return made.cloud.position.size(); }
};

double area_of(const Scene& scene) {
  double twice = 0.0;
  for (std::size_t c = 0; c + 1 < scene.cells.begin.size(); ++c)
    for (auto b = scene.cells.begin[c], e = scene.cells.begin[c + 1], k = b; k < e; ++k) {
      const auto at = [&](std::int32_t n) {
        return scene.cells.vertex[static_cast<std::size_t>(scene.cells.index[static_cast<std::size_t>(n)])];
      };
      twice += cross(at(k), at(k + 1 < e ? k + 1 : b));
    }
  return 0.5 * twice;
}

TEST(BodyView, axes_are_orthonormal_and_z_is_up) {
  for (const Vec3& eye : {Vec3(1, -1.6, 1), Vec3(0, -2, 0), Vec3(0, 0, 3), Vec3(-1, 0, -0.1)}) {
    const Mat<3> axes = BodyView{eye}.axes();
    EXPECT_LT((axes * axes.transpose() - Mat<3>::Identity()).norm(), 1e-14);
    EXPECT_NEAR(axes.determinant(), 1.0, 1e-14);
    EXPECT_LT((axes.row(2).transpose() - eye.normalized()).norm(), 1e-14);
    EXPECT_GE(axes(1, 2), 0.0);
  }
}

TEST(BodyView, the_surface_that_faces_the_eye_covers_the_shadow_of_the_body) {
  const Block block;
  const Vec3 eye = Vec3(1, -2, 2) / 3.0;
  const Scene scene = surface_scene(boundary_of(block.made.tetrahedra), block.position, {eye});
  EXPECT_NEAR(std::abs(area_of(scene)), eye.x() * 1.0 - eye.y() * 2.0 + eye.z() * 2.0, 1e-12);
  ASSERT_EQ(scene.darkness.size(), scene.node.size());
  ASSERT_EQ(scene.depth.size(), scene.cells.vertex.size());
  for (const float darkness : scene.darkness) {
    EXPECT_GE(darkness, 0.0F);
    EXPECT_LE(darkness, 1.0F);
  }
}

TEST(BodyView, a_cut_shows_each_cell_around_its_node_and_all_of_the_section) {
  const Block block;
  for (const SectionCells cells : {SectionCells::median, SectionCells::voronoi}) {
    const Scene scene =
        section_scene(block.made.tetrahedra, block.position, Vec3(0, 0.45, 0), Vec3(0, -3, 0), cells);
    EXPECT_NEAR(std::abs(area_of(scene)), 2.0, 1e-6);
    const double low = *std::min_element(scene.cells.vertex.begin(), scene.cells.vertex.end(),
                                         [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); })
                            ->data();
    EXPECT_NEAR(low, 0.0, 1e-12) << "x to the right, seen along y";
    for (std::size_t c = 0; c < scene.node.size(); ++c) { // no part is far from its node
      const auto node = static_cast<std::size_t>(scene.node[c]);
      const Vec2& x = scene.cells.vertex[static_cast<std::size_t>(
          scene.cells.index[static_cast<std::size_t>(scene.cells.begin[c])])];
      EXPECT_LT(std::hypot(x.x() - block.position[0][node], x.y() - block.position[2][node]), 0.6);
    }
  }
  EXPECT_TRUE(
      section_scene(block.made.tetrahedra, block.position, Vec3(0, 5, 0), Vec3(0, 1, 0), SectionCells::median)
          .node.empty());
}

TEST(BodyView, the_boundary_of_tetrahedra_is_that_of_the_cloud) {
  const Block block;
  const auto boundary = boundary_of(block.made.tetrahedra);
  EXPECT_EQ(boundary.size(), block.made.cloud.facets.size());
  Vec3 sum = Vec3::Zero();
  double area = 0.0, volume = 0.0;
  for (const auto& facet : boundary) {
    std::array<Vec3, 3> x;
    for (std::size_t a = 0; a < 3; ++a) x[a] = block.made.cloud.position[facet[a]];
    const Vec3 normal = area_normal<3>(x);
    sum += normal;
    area += normal.norm();
    volume += x[0].dot(normal) / 3.0;
  }
  EXPECT_LT(sum.norm(), 1e-14);
  EXPECT_NEAR(area, 10.0, 1e-12);
  EXPECT_NEAR(volume, 2.0, 1e-12); // normals point outwards
}

Curve square(double from, double to) {
  Curve curve;
  const std::array<Vec2, 4> corner{Vec2(from, from), Vec2(to, from), Vec2(to, to), Vec2(from, to)};
  for (std::size_t k = 0; k < 4; ++k)
    curve.pieces.push_back({corner[k], corner[(k + 1) % 4], {0, 0}, 0.0, false, ""});
  return curve;
}

// A tool above the body hides what is below it; on the other side of a plane of symmetry it is not there.
TEST(BodyView, tools_hide_what_is_behind_them_and_end_at_planes_of_symmetry) {
  const Block block;
  const BodyView above{{0, 0, 1}};
  const Scene scene = surface_scene(boundary_of(block.made.tetrahedra), block.position, above);
  input::ToolSolid solid;
  solid.shape = input::ToolSolid::Shape::extruded;
  solid.outline = square(-0.5, 0.5); // over a quarter of a square of the body, which begins at (0, 0)
  solid.low = 1.0;
  solid.high = 2.0;
  const TriangleSurface tool = input::tool_surface(solid, {{0, 0, 0}, {2, 1, 1}});
  const std::array sides{KeptSide{{0, 0, 0}, {-1, 0, 0}}, KeptSide{{0, 0, 0}, {0, -1, 0}}};
  SolidFaces faces;
  add_solid(faces, tool, sides, above);
  Picture picture;
  const Field values = scene.values(block.value);
  picture.cells = &scene.cells;
  picture.position = {scene.position[0], scene.position[1]};
  picture.value = values;
  picture.darkness = scene.darkness;
  picture.depth = scene.depth;
  picture.solids = &faces;
  picture.window = PictureWindow{{-0.5, -0.5}, {2.5, 1.5}};
  const PictureLayout layout = layout_picture(picture);
  const CellRaster raster = rasterise(layout, scene.cells, scene.cells.vertex, picture.depth, &faces);
  double body = 0.0, hidden = 0.0;
  for (const std::int32_t cell : raster.cell) {
    if (cell < 0) continue;
    (static_cast<std::size_t>(cell) < values.size() ? body : hidden) += 1.0 / (layout.scale * layout.scale);
  }
  EXPECT_NEAR(hidden, 0.25, 0.01);
  EXPECT_NEAR(body, 2.0 - 0.25, 0.01);
  EXPECT_FALSE(draw_png(picture).empty());

  SolidFaces below; // behind the body nothing of it is seen
  TriangleSurface moved = tool;
  for (Vec3& x : moved.points) x.z() -= 2.0;
  add_solid(below, moved, sides, above);
  for (const std::int32_t cell :
       rasterise(layout, scene.cells, scene.cells.vertex, picture.depth, &below).cell)
    EXPECT_LT(cell, static_cast<std::int32_t>(values.size()));
}

} // namespace
} // namespace cnem::report
