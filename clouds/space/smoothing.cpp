#include "clouds/node_hash.hpp"
#include "clouds/space/interior.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/order.hpp"
#include "voronoi/space/delaunay.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cnem::clouds {

namespace {

/// Interior nodes on the move, behind the fixed nodes of the surface in one cloud. With a uniform spacing,
/// nodes beyond `mobile` from the surface stay, and those beyond `near` are left out.
class Smoother {
public:
  Smoother(const Cloud<3>& surface, const Room& room, const SpaceSpacing& spacing,
           const std::vector<Vec3>& interior)
      : room_(room), spacing_(spacing), uniform_(spacing.uniform()), fixed_(surface.position.size()) {
    for (const Vec3& x : surface.position) push(x, false);
    for (const Vec3& x : interior) {
      const double h = spacing.at(x);
      const double away = uniform_ ? room.tree.nearest(x, near * h).distance : 0.0;
      if (away >= near * h)
        far_.push_back(x);
      else
        push(x, away < mobile * h);
    }
    mesh_ = voronoi::delaunay(cloud_);
  }

  void move_nodes() {
    const std::size_t count = cloud_.position.size();
    std::vector<Vec3> moment(count, Vec3(0, 0, 0));
    std::vector<double> mass(count, 0.0);
    for (const auto& n : mesh_.node) {
      if (std::ranges::none_of(n, [&](NodeIndex i) { return movable(i); })) continue;
      const auto x = corners(n);
      const double volume = measure<3>(x);
      if (!(volume > 0.0)) continue;
      const Vec3 middle = 0.25 * (x[0] + x[1] + x[2] + x[3]);
      const double h =
          0.25 * (h_[index_of(n[0])] + h_[index_of(n[1])] + h_[index_of(n[2])] + h_[index_of(n[3])]);
      Vec3 to = centre(x) - middle; // slivers and tetrahedra on the surface point far away
      if (const double length = to.norm(); !(length <= 0.5 * h)) to *= 0.5 * h / length;
      const double weight = uniform_ ? volume : volume / std::pow(h, 5);
      for (const NodeIndex i : n) {
        mass[index_of(i)] += weight;
        moment[index_of(i)] += weight * (middle + to - cloud_.position[i]);
      }
    }
    for (std::size_t i = fixed_; i < count; ++i) {
      if (!movable_[i] || !(mass[i] > 0.0)) continue;
      const Vec3 step = moment[i] / mass[i];
      const double length = step.norm();
      if (length < 1e-6 * h_[i]) continue;
      const Vec3 x = cloud_.position[i] + step * std::min(1.0, 0.4 * h_[i] / length);
      if (!room_.free(x, h_[i])) continue;
      cloud_.position[i] = x;
      h_[i] = spacing_.at(x);
    }
  }

  void connect() { mesh_ = voronoi::delaunay(cloud_); }

  /// Moves a node of each flat tetrahedron aside, in a direction that follows from `round`: four nodes that
  /// are nearly on a circle are a tetrahedron by chance. Returns how many were flat.
  int shake(int round) {
    std::vector<bool> moved(cloud_.position.size(), false);
    int count = 0;
    for (const auto& n : mesh_.node) {
      if (std::ranges::none_of(n, [&](NodeIndex i) { return movable(i); })) continue;
      if (!flat(corners(n))) continue;
      ++count;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t i = index_of(n[(k + index_of(round)) % 4]);
        if (!movable_[i] || moved[i]) continue;
        moved[i] = true;
        const Vec3 x = cloud_.position[i] + 0.12 * h_[i] * direction(i, round);
        if (!room_.free(x, h_[i])) continue;
        cloud_.position[i] = x;
        break;
      }
    }
    return count;
  }

  /// Puts nodes into holes and takes nodes out of crowds. Returns whether anything changed.
  bool change_nodes() {
    const std::vector<Vec3> added = hole_centres();
    const std::vector<bool> gone = crowding_nodes();
    if (added.empty() && std::ranges::none_of(gone, [](bool g) { return g; })) return false;
    std::size_t kept = fixed_;
    for (std::size_t i = fixed_; i < gone.size(); ++i)
      if (!gone[i]) {
        cloud_.position[kept] = cloud_.position[i];
        h_[kept] = h_[i];
        movable_[kept++] = movable_[i];
      }
    cloud_.position.resize(kept);
    h_.resize(kept);
    movable_.resize(kept);
    for (const Vec3& x : added) push(x, true);
    mesh_ = voronoi::delaunay(cloud_);
    return true;
  }

  std::vector<Vec3> interior() const {
    std::vector<Vec3> all(cloud_.position.begin() + static_cast<std::ptrdiff_t>(fixed_),
                          cloud_.position.end());
    all.insert(all.end(), far_.begin(), far_.end());
    return all;
  }

private:
  // Over h.
  static constexpr double mobile = 2.1, near = 4.0;
  static constexpr double hole = 0.85;  // circumradius; 0.645 in the lattice
  static constexpr double crowd = 0.62; // distance; 1 in the lattice

  void push(const Vec3& x, bool movable) {
    cloud_.position.push_back(x);
    h_.push_back(spacing_.at(x));
    movable_.push_back(movable);
  }
  bool movable(NodeIndex i) const { return movable_[index_of(i)]; }
  std::array<Vec3, 4> corners(const std::array<NodeIndex, 4>& n) const {
    return {cloud_.position[n[0]], cloud_.position[n[1]], cloud_.position[n[2]], cloud_.position[n[3]]};
  }
  static Vec3 centre(const std::array<Vec3, 4>& x) {
    const Vec3 a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
    const double six = a.cross(b).dot(c);
    return x[0] +
           (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) /
               (2.0 * six);
  }

  /// Whether the angle between two of its faces is below about 12°.
  static bool flat(const std::array<Vec3, 4>& x) { return least_dihedral(x) < 0.21; }

  /// As good as random, the same everywhere.
  static Vec3 direction(std::size_t node, int round) {
    std::uint64_t bits = 0x9E3779B97F4A7C15U * (8 * node + index_of(round) + 1);
    Vec3 x;
    do
      for (double& component : x) {
        bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
        component = static_cast<double>(bits >> 11) * 0x1.0p-52 - 1.0;
      }
    while (x.squaredNorm() > 1.0 || x.squaredNorm() < 0.01);
    return x.normalized();
  }

  std::vector<Vec3> hole_centres() const {
    std::vector<Hole<3>> holes;
    for (const auto& n : mesh_.node) {
      if (std::ranges::none_of(n, [&](NodeIndex i) { return movable(i) || index_of(i) < fixed_; })) continue;
      const auto x = corners(n);
      const Vec3 at = centre(x);
      const double radius = (at - x[0]).norm();
      double low = h_[index_of(n[0])];
      for (const NodeIndex i : n) low = std::min(low, h_[index_of(i)]);
      if (!(radius > hole * low) || !(radius < 4.0 * low)) continue;
      const double h = spacing_.at(at);
      if (radius < hole * h || !(room_.tree.nearest(at, 2.0 * h).distance > 0.0) || !inside(at) ||
          !room_.free(at, h))
        continue;
      holes.push_back({radius / h, at});
    }
    return centres_apart<3>(std::move(holes), spacing_);
  }

  bool inside(const Vec3& x) const {
    return room_.tree.nearest(x, std::numeric_limits<double>::max()).distance > 0.0;
  }

  std::vector<bool> crowding_nodes() const {
    std::vector<bool> gone(cloud_.position.size(), false);
    for (const auto& n : mesh_.node)
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t l = k + 1; l < 4; ++l) {
          const auto a = index_of(std::min(n[k], n[l])), b = index_of(std::max(n[k], n[l]));
          if (!movable_[b] || gone[a] || gone[b]) continue;
          const double limit = 0.5 * crowd * (h_[a] + h_[b]);
          if ((cloud_.position[a] - cloud_.position[b]).squaredNorm() < limit * limit) gone[b] = true;
        }
    return gone;
  }

  const Room& room_;
  const SpaceSpacing& spacing_;
  bool uniform_;
  std::size_t fixed_; ///< nodes of the surface come first
  Cloud<3> cloud_;
  std::vector<double> h_;
  std::vector<bool> movable_;
  std::vector<Vec3> far_; ///< interior nodes that take no part
  voronoi::Delaunay mesh_;
};

} // namespace

void smooth_nodes(const Cloud<3>& surface, const Room& room, const SpaceSpacing& spacing,
                  std::vector<Vec3>& interior) {
  Smoother smoother(surface, room, spacing, interior);
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    for (int sweep = 0; sweep < 2; ++sweep) smoother.move_nodes();
    smoother.connect();
    if (round + 1 < rounds && !smoother.change_nodes() && round > 0) break;
  }
  for (int round = 0; round < 4 && smoother.shake(round) > 0; ++round) smoother.connect();
  interior = smoother.interior();
}

} // namespace cnem::clouds
