// Cells and operators in space on a thousand random clouds: all shapes, shaken, sheared, turned.
#include "core/error.hpp"
#include "tests/space_checks.hpp"
#include "tests/space_clouds.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cstdlib>

namespace cnem::testing {
namespace {

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

// With CNEM_ALL_CLOUDS each cloud has all cells and functions, else one after another.
TEST(RandomBodies, fill_their_volume_and_reproduce_linear_fields) {
  constexpr int clouds = 1000;
  const bool all = std::getenv("CNEM_ALL_CLOUDS") != nullptr;
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1); // bodies are too small to share
  int built = 0;
  for (int seed = 0; seed < clouds; ++seed) {
    const SpaceCloud how = random_body(seed);
    SCOPED_TRACE(fmt::format("{} of seed {}, sheared by {}", name_of(how.shape), seed, how.shear));
    Cloud<3> cloud;
    try {
      cloud = recovered(how).cloud;
    } catch (const GeometryError& error) {
      EXPECT_GT(how.shear, 1.0) << error.what(); // beside holes one cell wide: no flips hold the facets
      continue;
    }
    ++built;
    const std::vector<scni::SpaceOptions>& options = space_options();
    for (std::size_t k = 0; k < options.size(); ++k)
      if (all || k == index_of(seed / 9) % options.size()) {
        const auto approximation = scni::CnemInSpace(options[k]).rebuild(cloud);
        EXPECT_EQ(broken_promise(cloud, approximation.mechanics, 1.0 / how.cells), "") << "choice " << k;
      }
    if (HasFailure()) break;
  }
  omp_set_num_threads(threads);
  if (!HasFailure()) { EXPECT_GE(built, 995); }
}

} // namespace
} // namespace cnem::testing
