// Any body of tests/space_clouds.hpp, shaken, sheared, bent and turned, of which single nodes may be pushed
// about, crowded along creases or laid on facets: cells and operators that keep their promises, the same bits
// from the recovered cloud again, or a GeometryError.
#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "tests/space_checks.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/triangulate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <vector>

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
  bool left() const { return at_ < size_; }

private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

/// Of nodes at which two edges between pieces meet, the ends of these edges; of others fewer or more.
std::map<NodeIndex, std::vector<NodeIndex>> ends_of_creases(const Cloud<3>& cloud) {
  std::map<std::array<NodeIndex, 2>, std::vector<PieceIndex>> pieces;
  for (const auto& facet : cloud.facets)
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex a = facet.node[k], b = facet.node[(k + 1) % 3];
      pieces[{std::min(a, b), std::max(a, b)}].push_back(facet.piece);
    }
  std::map<NodeIndex, std::vector<NodeIndex>> ends;
  for (const auto& [edge, beside] : pieces) {
    if (beside.size() != 2 || beside[0] == beside[1]) continue;
    ends[edge[0]].push_back(edge[1]);
    ends[edge[1]].push_back(edge[0]);
  }
  return ends;
}

/// A node goes most of the way to the next one of its crease, if it is on one, and its twins with it.
void crowd(Cloud<3>& cloud, NodeIndex i, bool to_second, double share) {
  const auto creases = ends_of_creases(cloud);
  const auto at = creases.find(i);
  if (at == creases.end() || at->second.size() != 2) return;
  const Vec3 from = cloud.position[i];
  const Vec3 to = from + share * (cloud.position[at->second[to_second ? 1 : 0]] - from);
  for (Vec3& x : cloud.position)
    if (x == from) x = to;
}

/// A node that no facet has goes to a place behind a facet, 2^-bits spacings deep: tetrahedra there are flat.
void lay(Cloud<3>& cloud, std::size_t inner, std::size_t facet, double spacing, int bits) {
  IndexedVector<NodeIndex, char> outer(cloud.position.size(), 0);
  for (const auto& f : cloud.facets)
    for (const NodeIndex i : f.node) outer[i] = 1;
  std::vector<NodeIndex> nodes;
  for (const NodeIndex i : outer.indices())
    if (!outer[i]) nodes.push_back(i);
  if (nodes.empty()) return;
  const auto corner =
      corners_of<3>(cloud.facets[as<CloudFacetIndex>(facet % cloud.facets.size())], cloud.position);
  cloud.position[nodes[inner % nodes.size()]] =
      (corner[0] + corner[1] + corner[2]) / 3.0 -
      std::ldexp(spacing, -bits) * area_normal<3>(corner).normalized();
}

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
    // what was added later stands at the end of the bytes: old entries of the corpus keep their meaning
    const auto number = [&] {
      const int high = bytes.byte();
      return index_of(256 * high + bytes.byte());
    };
    for (int crowded = bytes.below(32); crowded > 0 && bytes.left(); --crowded) {
      const auto i = as<NodeIndex>(number() % cloud.position.size());
      const int how_far = bytes.byte();
      crowd(cloud, i, how_far % 2 == 1, 0.5 + how_far / 256.0 * 0.499);
    }
    for (int laid = bytes.below(8); laid > 0 && bytes.left(); --laid) {
      const auto inner = number(), facet = number();
      lay(cloud, inner, facet, spacing, bytes.below(32));
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
