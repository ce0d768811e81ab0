// Bodies in space as pictures show them.
#include "clouds/tetrahedral_block.hpp"
#include "report/body_view.hpp"

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
  const Scene scene = surface_scene(block.made.cloud.facets, block.position, block.value, {eye});
  EXPECT_NEAR(std::abs(area_of(scene)), eye.x() * 1.0 - eye.y() * 2.0 + eye.z() * 2.0, 1e-12);
  ASSERT_EQ(scene.darkness.size(), scene.value.size());
  for (const float darkness : scene.darkness) {
    EXPECT_GE(darkness, 0.0F);
    EXPECT_LE(darkness, 1.0F);
  }
}

TEST(BodyView, a_cut_shows_each_cell_around_its_node_and_all_of_the_section) {
  const Block block;
  for (const SectionCells cells : {SectionCells::median, SectionCells::voronoi}) {
    const Scene scene = section_scene(block.made.tetrahedra, block.position, block.value, Vec3(0, 0.45, 0),
                                      Vec3(0, -3, 0), cells);
    EXPECT_NEAR(std::abs(area_of(scene)), 2.0, 1e-6);
    const double low = *std::min_element(scene.cells.vertex.begin(), scene.cells.vertex.end(),
                                         [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); })
                            ->data();
    EXPECT_NEAR(low, 0.0, 1e-12) << "x to the right, seen along y";
    for (std::size_t c = 0; c < scene.value.size(); ++c) { // no part is far from its node
      const auto node = static_cast<std::size_t>(scene.value[c]);
      const Vec2& x = scene.cells.vertex[static_cast<std::size_t>(
          scene.cells.index[static_cast<std::size_t>(scene.cells.begin[c])])];
      EXPECT_LT(std::hypot(x.x() - block.position[0][node], x.y() - block.position[2][node]), 0.6);
    }
  }
  EXPECT_TRUE(section_scene(block.made.tetrahedra, block.position, block.value, Vec3(0, 5, 0), Vec3(0, 1, 0),
                            SectionCells::median)
                  .value.empty());
}

} // namespace
} // namespace cnem::report
