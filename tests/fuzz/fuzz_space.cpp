// Any body of tests/space_clouds.hpp, shaken, sheared, bent and turned, of which single nodes may be pushed
// about: cells and operators that keep their promises, the same bits from the recovered cloud again, or a
// GeometryError.
#include "core/error.hpp"
#include "core/index.hpp"
#include "tests/space_checks.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/triangulate.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace cnem;
using namespace cnem::testing;

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

class Bytes {
public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  /// The next byte; 0 beyond the end.
  int byte() { return at_ < size_ ? data_[at_++] : 0; }
  int below(int n) { return byte() % n; }
  double share() { return byte() / 255.0; }

private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  SpaceCloud how;
  how.shape = space_shapes[index_of(bytes.below(as<int>(space_shapes.size())))];
  how.cells = 2 + bytes.below(4);
  how.jitter = 0.45 * bytes.share();
  how.shear = 2.0 * bytes.share();
  how.shear_plane = bytes.below(6);
  how.wave = 0.1 * bytes.share();
  how.turned = bytes.below(2) == 1;
  how.seed = static_cast<std::uint64_t>(bytes.byte());
  const scni::SpaceOptions& options = space_options()[index_of(bytes.below(as<int>(space_options().size())))];
  const double spacing = 1.0 / how.cells;
  try {
    Cloud<3> cloud = unrecovered(how);
    for (int pushed = bytes.below(4); pushed > 0; --pushed) {
      const auto i = index_of(bytes.byte()) % cloud.position.size();
      for (Eigen::Index k = 0; k < 3; ++k) cloud.position[i][k] += spacing * (bytes.share() - 0.5);
    }
    const voronoi::RecoveredBoundary body = voronoi::recover_boundary(cloud);
    const auto operators = scni::CnemInSpace(options).rebuild(body.cloud).mechanics;
    const std::string broken = broken_promise(body.cloud, operators, spacing, 1e-3);
    if (!broken.empty()) fail(broken);
    if (voronoi::triangulate(body.cloud).node != body.tetrahedra.node)
      fail("triangulating the recovered cloud makes other tetrahedra");
  } catch (const GeometryError&) {} // refused with words
  return 0;
}
