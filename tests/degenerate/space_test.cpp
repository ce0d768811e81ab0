// Cells and operators in space on a thousand random clouds: all shapes, shaken, sheared, turned.
#include "cnem/space.hpp"
#include "core/error.hpp"
#include "core/operators/operator_checks.hpp"
#include "tests/space_clouds.hpp"

#include <gtest/gtest.h>
#include <numeric>
#include <omp.h>

namespace cnem::testing {
namespace {

constexpr int clouds = 1000;

SpaceCloud random_body(int seed) {
  Random random(static_cast<std::uint64_t>(seed) + 100);
  SpaceCloud how;
  how.shape = space_shapes[static_cast<std::size_t>(seed) % space_shapes.size()];
  how.cells = how.shape == SpaceShape::slit || how.shape == SpaceShape::notch ? 4 : 3;
  how.jitter = random.uniform(0.0, 0.45);
  how.shear = random.uniform(0, 1) < 0.5 ? 0.0 : random.uniform(0.0, 2.0);
  how.shear_plane = static_cast<int>(random.uniform(0, 6));
  how.turned = random.uniform(0, 1) < 0.5;
  how.seed = static_cast<std::uint64_t>(seed) + 1;
  return how;
}

TEST(RandomBodies, fill_their_volume_and_reproduce_linear_fields) {
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1); // bodies are too small to share
  int built = 0;
  for (int seed = 0; seed < clouds; ++seed) {
    const SpaceCloud how = random_body(seed);
    SCOPED_TRACE(std::string(name_of(how.shape)) + " of seed " + std::to_string(seed));
    Cloud<3> cloud;
    try {
      cloud = recovered(how).cloud;
    } catch (const GeometryError&) { continue; } // how many is asked where boundaries are recovered
    ++built;
    scni::SpaceOptions options;
    options.cells = seed % 4 == 0 ? scni::CellKind::median : scni::CellKind::voronoi;
    options.functions = seed % 3 == 0 ? voronoi::Functions::sibson : voronoi::Functions::laplace;
    options.gauss_points = seed % 7 == 0 ? 3 : 1;
    const auto approximation = scni::CnemInSpace(options).rebuild(cloud);
    const auto& op = approximation.mechanics;
    EXPECT_TRUE(rows_are_complete(op));
    EXPECT_NEAR(std::accumulate(op.volume.begin(), op.volume.end(), 0.0) / enclosed_measure(cloud), 1.0,
                1e-12);
    std::vector<Vec3> force(cloud.position.size(), Vec3::Zero());
    for (std::size_t i = 0; i < op.volume.size(); ++i) {
      Vec3 sum = Vec3::Zero();
      Mat<3> positions = Mat<3>::Zero();
      for (auto e = index_of(op.row_begin[i]); e < index_of(op.row_begin[i + 1]); ++e) {
        const Vec3 b(op.gradient[0][e], op.gradient[1][e], op.gradient[2][e]);
        sum += b;
        positions += cloud.position[op.node[e]] * b.transpose();
        force[index_of(op.node[e])] += op.volume[i] * b;
      }
      EXPECT_GT(op.volume[i], 0.0);
      EXPECT_LT(sum.norm() / how.cells, 1e-11);
      EXPECT_LT((positions - Mat<3>::Identity()).norm(), 1e-11);
    }
    for (const auto& facet : cloud.facets)
      for (const NodeIndex i : facet.node)
        force[index_of(i)] -= area_normal<3>(corners_of<3>(facet, cloud.position)) / 3.0;
    for (const Vec3& f : force) EXPECT_LT(f.norm() * how.cells * how.cells, 1e-11);
    if (HasFailure()) break;
  }
  omp_set_num_threads(threads);
  if (!HasFailure()) { EXPECT_GT(built, clouds / 2); }
}

} // namespace
} // namespace cnem::testing
