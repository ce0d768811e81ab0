#include "clouds/generate_interior.hpp"
#include "clouds/node_hash.hpp"
#include "core/index.hpp"
#include "voronoi/order.hpp"
#include "voronoi/plane/delaunay_flips.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::clouds {

namespace {

/// Interior nodes on the move, behind the fixed boundary nodes in one cloud. With a uniform spacing, nodes
/// beyond `mobile` from the boundary stay, and those beyond `near` are left out.
class Smoother {
public:
  Smoother(const Cloud<2>& boundary, const voronoi::EdgeTree& tree, const SpacingField& spacing,
           const std::vector<Vec2>& interior)
      : tree_(tree), spacing_(spacing), uniform_(spacing.uniform()), fixed_(boundary.position.size()),
        cloud_(boundary) {
    for (const Vec2& x : cloud_.position) {
      h_.push_back(spacing.at(x));
      movable_.push_back(false);
    }
    for (const std::int32_t k : voronoi::hilbert_order(interior)) {
      const Vec2& x = interior[index_of(k)];
      const double h = spacing.at(x), room = uniform_ ? tree.distance(x, near * h) : 0.0;
      if (room >= near * h) {
        far_.push_back(x);
        continue;
      }
      cloud_.position.push_back(x);
      h_.push_back(h);
      movable_.push_back(room < mobile * h);
    }
    mesh_ = voronoi::triangulate(cloud_);
  }

  /// One step of Lloyd's iteration.
  void move_nodes() {
    std::vector<Vec2> moment(cloud_.position.size(), Vec2(0, 0));
    std::vector<double> mass(cloud_.position.size(), 0.0);
    std::vector<bool> by_wall(cloud_.position.size(), false);
    for (const SimplexIndex t : mesh_.node.indices()) add_shares(t, moment, mass, by_wall);
    const std::vector<Vec2> before = cloud_.position;
    for (std::size_t i = fixed_; i < cloud_.position.size(); ++i) {
      if (!movable_[i] || !(mass[i] > 0.0)) continue;
      const Vec2 step = over_relaxation * moment[i] / mass[i];
      const double length = step.norm();
      if (length < 1e-6 * h_[i]) continue; // leaves a perfect lattice alone
      const Vec2 x = cloud_.position[i] + step * std::min(1.0, 0.5 * h_[i] / length);
      const double free_distance = 0.45 * h_[i];
      if (by_wall[i] && !(tree_.inside(x) && tree_.distance(x, free_distance) >= free_distance)) continue;
      cloud_.position[i] = x;
    }
    undo_inversions(before);
    voronoi::restore_delaunay(mesh_, cloud_.position);
    if (uniform_) return;
    for (std::size_t i = fixed_; i < cloud_.position.size(); ++i) h_[i] = spacing_.at(cloud_.position[i]);
  }

  /// Puts nodes into holes and takes nodes out of crowds. Returns whether anything changed.
  bool change_nodes() {
    const std::vector<Vec2> added = hole_centres();
    const std::vector<bool> gone = crowding_nodes();
    if (added.empty() && std::ranges::none_of(gone, [](bool g) { return g; })) return false;
    std::vector<Vec2> interior = added;
    std::vector<bool> may(added.size(), true);
    for (std::size_t i = fixed_; i < cloud_.position.size(); ++i)
      if (!gone[i]) {
        interior.push_back(cloud_.position[i]);
        may.push_back(movable_[i]);
      }
    cloud_.position.resize(fixed_);
    h_.resize(fixed_);
    movable_.resize(fixed_);
    for (const std::int32_t k : voronoi::hilbert_order(interior)) {
      cloud_.position.push_back(interior[index_of(k)]);
      h_.push_back(spacing_.at(interior[index_of(k)]));
      movable_.push_back(may[index_of(k)]);
    }
    mesh_ = voronoi::triangulate(cloud_);
    return true;
  }

  std::vector<Vec2> interior() const {
    std::vector<Vec2> all(cloud_.position.begin() + static_cast<std::ptrdiff_t>(fixed_),
                          cloud_.position.end());
    all.insert(all.end(), far_.begin(), far_.end());
    return all;
  }

  /// Places without a node between the two sides of the domain.
  Necks necks() const { return find_necks(cloud_, mesh_); }

private:
  static constexpr double over_relaxation = 1.4;
  // Over h; between the distances of lattice rows from a wall, so that rounding decides nothing.
  static constexpr double mobile = 2.55, near = 5.1;

  /// Takes the nodes of triangles that turned over back to where they were.
  void undo_inversions(const std::vector<Vec2>& before) {
    for (bool again = true; again;) {
      again = false;
      for (const auto& n : mesh_.node) {
        const Vec2 b = cloud_.position[n[1]] - cloud_.position[n[0]];
        const Vec2 c = cloud_.position[n[2]] - cloud_.position[n[0]];
        if (cross(b, c) > 1e-3 * (b.squaredNorm() + c.squaredNorm())) continue;
        for (const NodeIndex i : n) {
          again = again || cloud_.position[i] != before[index_of(i)];
          cloud_.position[i] = before[index_of(i)];
        }
      }
    }
  }

  /// Circumcentre relative to the first node.
  Vec2 circumcentre(SimplexIndex t) const {
    const auto& n = mesh_.node[t];
    const Vec2 b = cloud_.position[n[1]] - cloud_.position[n[0]];
    const Vec2 c = cloud_.position[n[2]] - cloud_.position[n[0]];
    return (c.squaredNorm() * right_normal(b) - b.squaredNorm() * right_normal(c)) / (-2.0 * cross(b, c));
  }

  /// Adds the shares of one triangle in the Voronoi cells of its nodes: signed triangles between node, edge
  /// midpoint and circumcentre. Moments are relative to each node.
  void add_shares(SimplexIndex t, std::vector<Vec2>& moment, std::vector<double>& mass,
                  std::vector<bool>& by_wall) const {
    const auto& n = mesh_.node[t];
    if (!movable_[index_of(n[0])] && !movable_[index_of(n[1])] && !movable_[index_of(n[2])]) return;
    std::array<Vec2, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = cloud_.position[n[k]];
    const Vec2 origin = x[0];
    Vec2 centre = circumcentre(t);
    for (Vec2& point : x) point -= origin;
    const double area2 = cross(x[1], x[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 &a = x[(k + 1) % 3], &b = x[(k + 2) % 3];
      if (exists(mesh_.facet[t][k]) && cross(b - a, centre - a) < 0.0)
        centre = 0.5 * (a + b); // cut at the wall
    }
    const double low = std::min({h_[index_of(n[0])], h_[index_of(n[1])], h_[index_of(n[2])]});
    double h_centre = low;
    if (!uniform_) {
      h_centre = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        h_centre +=
            h_[index_of(n[k])] * cross(x[(k + 2) % 3] - x[(k + 1) % 3], centre - x[(k + 1) % 3]) / area2;
      h_centre = std::clamp(h_centre, 0.7 * low,
                            1.5 * std::max({h_[index_of(n[0])], h_[index_of(n[1])], h_[index_of(n[2])]}));
    }
    bool wall = false;
    for (const NodeIndex i : n) wall = wall || index_of(i) < fixed_;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = index_of(n[k]);
      if (wall) by_wall[i] = true;
      const Vec2 to_centre = centre - x[k];
      for (const std::size_t j : {(k + 1) % 3, (k + 2) % 3}) {
        const Vec2 to_middle = 0.5 * (x[j] - x[k]);
        double share = 0.5 * (j == (k + 1) % 3 ? cross(to_middle, to_centre) : cross(to_centre, to_middle));
        if (!uniform_) {
          const double h = (1.5 * h_[i] + 0.5 * h_[index_of(n[j])] + h_centre) / (3.0 * h_[i]);
          share /= h * h * h * h;
        }
        mass[i] += share;
        moment[i] += share * (to_middle + to_centre) / 3.0;
      }
    }
  }

  std::vector<Vec2> hole_centres() const {
    std::vector<Hole<2>> holes;
    for (const SimplexIndex t : mesh_.node.indices()) {
      const auto& n = mesh_.node[t];
      if (!movable_[index_of(n[0])] && !movable_[index_of(n[1])] && !movable_[index_of(n[2])] &&
          std::ranges::any_of(n, [&](NodeIndex i) { return index_of(i) >= fixed_; }))
        continue;
      const Vec2 radius = circumcentre(t);
      const Vec2 centre = cloud_.position[n[0]] + radius;
      const double low = std::min({h_[index_of(n[0])], h_[index_of(n[1])], h_[index_of(n[2])]});
      if (radius.norm() < hole * low) continue;
      const double h = spacing_.at(centre);
      if (radius.norm() < hole * h || !tree_.inside(centre) || tree_.distance(centre, 0.5 * h) < 0.5 * h)
        continue;
      holes.push_back({radius.norm() / h, centre});
    }
    return centres_apart<2>(std::move(holes), spacing_);
  }

  std::vector<bool> crowding_nodes() const {
    std::vector<bool> gone(cloud_.position.size(), false);
    for (const SimplexIndex t : mesh_.node.indices())
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = index_of(mesh_.node[t][(k + 1) % 3]), b = index_of(mesh_.node[t][(k + 2) % 3]);
        const std::size_t late = std::max(a, b);
        if (!movable_[late] || gone[a] || gone[b]) continue;
        const double limit = 0.5 * crowd * (h_[a] + h_[b]);
        if ((cloud_.position[a] - cloud_.position[b]).squaredNorm() < limit * limit) gone[late] = true;
      }
    return gone;
  }

  static constexpr double hole =
      0.88; // circumradius over h; 0.58 in a hexagonal lattice, 0.71 in a square one
  static constexpr double crowd = 0.65; // distance over h

  const voronoi::EdgeTree& tree_;
  const SpacingField& spacing_;
  bool uniform_;
  std::size_t fixed_; ///< boundary nodes come first
  Cloud<2> cloud_;
  std::vector<double> h_;
  std::vector<bool> movable_;
  std::vector<Vec2> far_; ///< interior nodes that take no part
  voronoi::Triangulation mesh_;
};

} // namespace

Necks smooth_nodes(const Cloud<2>& boundary, const voronoi::EdgeTree& tree, const SpacingField& spacing,
                   std::vector<Vec2>& interior) {
  Smoother smoother(boundary, tree, spacing, interior);
  for (int round = 0; round < 3; ++round) {
    for (int sweep = 0; sweep < 2; ++sweep) smoother.move_nodes();
    if (!smoother.change_nodes() && round > 0) break;
  }
  for (int sweep = 0; sweep < 2; ++sweep) smoother.move_nodes();
  interior = smoother.interior();
  return smoother.necks();
}

} // namespace cnem::clouds
