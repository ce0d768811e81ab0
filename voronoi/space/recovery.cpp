#include "voronoi/space/recovery.hpp"

#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/adoption.hpp"
#include "voronoi/space/bodies.hpp"
#include "voronoi/space/crossings.hpp"
#include "voronoi/space/facet_flips.hpp"
#include "voronoi/space/filling.hpp"
#include "voronoi/space/opened.hpp"
#include "voronoi/space/surface.hpp"
#include "voronoi/space/surface_fit.hpp"
#include "voronoi/space/surface_flips.hpp"
#include "voronoi/space/walls.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace cnem::voronoi {

namespace {

std::vector<std::uint8_t> on_surface(const Cloud<3>& cloud) {
  std::vector<std::uint8_t> is(cloud.position.size(), 0);
  for (const auto& facet : cloud.facets)
    for (const NodeIndex i : facet.node) is[index_of(i)] = 1;
  return is;
}

class Recovery {
public:
  Recovery(const Cloud<3>& cloud, const RecoveryRules& rules)
      : rules_(rules), fixed_(cloud.position.size(), 0), sound_(rules.sound) {
    result_.cloud = cloud;
    result_.cloud.simplices.clear();
    result_.cloud.across.clear();
    result_.now.resize(cloud.position.size());
    for (const NodeIndex i : result_.now.indices()) result_.now[i] = i;
  }

  RecoveredBoundary run() {
    Cloud<3>& cloud = result_.cloud;
    RecoveryCounts& counts = result_.counts;
    Delaunay mesh = delaunay(cloud);
    Walls walls;
    without_crossings([&] {
      counts.flipped = flip_surface(cloud, rules_.flat_angle, fixed_);
      walls = find_walls(cloud, mesh);
      return !walls.lost.empty();
    });
    sound_ = sound_ || walls.lost.empty(); // faces of tetrahedra do not cross
    counts.lost = as<int>(walls.lost.size());
    if (faces_touch(cloud, walls.lost)) {
      auto filled = filling_at_once(cloud, mesh, walls);
      if (!filled) filled = filling_of_opened(cloud, walls.lost);
      if (filled) {
        counts.held = counts.lost;
        return finish(std::move(*filled));
      }
    }
    for (int round = 0;; ++round) {
      if (round == most_rounds)
        throw GeometryError(fmt::format("{} is lost, and {} rounds of recovery did not bring it back",
                                        describe_facet(cloud, walls.lost.front()), most_rounds));
      const bool flips_help = round < most_flipping; // else they go round in a circle
      if (!walls.lost.empty() && flips_help) {
        const int flips = fit(mesh, walls.lost, rules_.flat_angle);
        counts.flipped += flips;
        if (flips > 0) walls = find_walls(cloud, mesh);
      }
      peel(mesh, walls);
      if (walls.lost.empty()) {
        counts.held = 0;
        return finish(filling(cloud, std::move(mesh), std::move(walls)));
      }
      Delaunay flipped = mesh;
      counts.held = as<int>(walls.lost.size());
      std::vector<CloudFacetIndex> lost = walls.lost;
      HeldFacets held = hold_facets(cloud, flipped, std::move(walls));
      walls = std::move(held.walls);
      const bool peeled = peel(flipped, walls);
      if (walls.lost.empty()) {
        if (peeled) { // triangulating the cloud anew has to hold its facets
          flipped = mesh;
          walls = find_walls(cloud, flipped);
          lost = walls.lost;
          held = hold_facets(cloud, flipped, std::move(walls));
          walls = std::move(held.walls);
        }
        if (walls.lost.empty()) {
          const bool other_way = !held.at_once || faces_touch(cloud, lost); // that it may go
          return finish(other_way ? filling(cloud, std::move(mesh))
                                  : filling(cloud, std::move(flipped), std::move(walls)));
        }
        walls = find_walls(cloud, mesh);
        continue;
      }
      if (const int flips = flips_help ? fit(flipped, walls.lost, rules_.smooth_angle) : 0) {
        counts.flipped += flips;
      } else if (remove_near(walls.lost)) {
        mesh = delaunay(cloud);
      } else if (counts.replaced > 0 || !adopt(mesh)) {
        break;
      }
      walls = find_walls(cloud, mesh);
    }
    return finish(filling(cloud, std::move(mesh)));
  }

private:
  RecoveredBoundary finish(Filling filling) {
    Cloud<3>& cloud = result_.cloud;
    if (!cloud.mates.empty()) cloud.mates = facets_behind(cloud);
    result_.tetrahedra = std::move(filling.tetrahedra);
    result_.flipped = filling.flipped || result_.counts.held > 0;
    return std::move(result_);
  }

  /// Flips edges of the surface, and where it may cross itself and does so again without those there: of two
  /// sides of a body that nearly touch one may have been pushed through the other.
  template<class Flips> void without_crossings(const Flips& flips_that_may_cross) {
    constexpr int most = 4;
    const auto before = result_.cloud.facets;
    for (int n = 1; flips_that_may_cross() && mark_crossings(before); ++n) {
      if (n == most) std::fill(fixed_.begin(), fixed_.end(), 1); // on planes alone, everywhere
      result_.cloud.facets = before;
    }
  }

  int fit(const Delaunay& mesh, const std::vector<CloudFacetIndex>& lost, double angle) {
    int flips = 0;
    without_crossings([&] { return (flips = fit_surface(result_.cloud, mesh, lost, angle, fixed_)) > 0; });
    return flips;
  }

  /// Fixes the nodes of facets that cross each other now. Whether there are any that were not fixed.
  bool mark_crossings(const IndexedVector<CloudFacetIndex, Facet<3>>& before) {
    std::vector<CloudFacetIndex> turned;
    for (const CloudFacetIndex f : before.indices())
      if (before[f].node != result_.cloud.facets[f].node) turned.push_back(f);
    const auto pairs = sound_ ? crossings(result_.cloud, turned) : crossings(result_.cloud);
    bool any = false;
    for (const auto& pair : pairs)
      for (const CloudFacetIndex f : pair)
        for (const NodeIndex i : result_.cloud.facets[f].node) {
          any = any || !fixed_[i];
          fixed_[i] = 1;
        }
    if (!any) sound_ = pairs.empty();
    return any;
  }

  /// Whether there was anything flat on the surface.
  bool peel(const Delaunay& mesh, Walls& walls) {
    for (int layer = 0; layer < most_layers; ++layer) {
      const int flips = peel_flat(result_.cloud, mesh, walls, rules_.flat_angle);
      if (flips == 0) return layer > 0;
      result_.counts.flipped += flips;
      sound_ = false;
      walls = find_walls(result_.cloud, mesh);
    }
    return true;
  }

  /// Takes the boundary of the tetrahedra inside for the surface, if that is a manifold with the same nodes.
  /// Whether it is.
  bool adopt(const Delaunay& mesh) {
    Cloud<3>& cloud = result_.cloud;
    Cloud<3> candidate = cloud;
    try {
      Adopted adopted = adopted_facets(cloud, mesh, find_walls(cloud, mesh), inside_by_winding(cloud, mesh));
      candidate.facets = std::move(adopted.facets);
      surface_edges(candidate);
      if (on_surface(candidate) != on_surface(cloud)) return false;
      result_.counts.replaced = adopted.replaced;
    } catch (const GeometryError&) { return false; }
    cloud = std::move(candidate);
    sound_ = false;
    return true;
  }

  /// Takes inner nodes out of the diametral balls of facets. Whether there were any.
  bool remove_near(const std::vector<CloudFacetIndex>& lost) {
    const Cloud<3>& cloud = result_.cloud;
    const auto surface = on_surface(cloud);
    IndexedVector<NodeIndex, std::uint8_t> goes(cloud.position.size(), 0);
    bool any = false;
    for (const CloudFacetIndex f : lost) {
      const auto& node = cloud.facets[f].node;
      const DiametralBall ball =
          diametral_ball({cloud.position[node[0]], cloud.position[node[1]], cloud.position[node[2]]});
      for (const NodeIndex i : cloud.position.indices())
        if (!surface[index_of(i)] && (cloud.position[i] - ball.centre).norm() < ball.radius)
          goes[i] = any = true;
    }
    if (any) remove(goes);
    return any;
  }

  void remove(const IndexedVector<NodeIndex, std::uint8_t>& goes) {
    Cloud<3>& cloud = result_.cloud;
    IndexedVector<NodeIndex, NodeIndex> number(goes.size(), NodeIndex::none);
    IndexedVector<NodeIndex, Vec3> kept;
    FixedNodes fixed;
    for (const NodeIndex i : goes.indices())
      if (!goes[i]) {
        number[i] = kept.next();
        kept.push_back(cloud.position[i]);
        fixed.push_back(fixed_[i]);
      } else {
        ++result_.counts.removed;
      }
    cloud.position = std::move(kept);
    fixed_ = std::move(fixed);
    for (auto& facet : cloud.facets)
      for (NodeIndex& i : facet.node) i = number[i];
    for (auto& pair : cloud.twins)
      for (NodeIndex& i : pair) i = number[i];
    for (NodeIndex& i : result_.now)
      if (exists(i)) i = number[i];
  }

  static constexpr int most_rounds = 30;
  static constexpr int most_flipping = 15; ///< of these rounds
  static constexpr int most_layers = 10;   ///< of flat tetrahedra on each other

  RecoveryRules rules_;
  FixedNodes fixed_; ///< [node of the cloud now]
  bool sound_;       ///< whether facets are known not to cross each other
  RecoveredBoundary result_;
};

/// The recovered bodies of a cloud in one. Facets stand body after body.
RecoveredBoundary joined(const Cloud<3>& cloud, std::vector<SingleBody> bodies,
                         std::vector<RecoveredBoundary> recovered) {
  IndexedVector<NodeIndex, std::pair<std::size_t, NodeIndex>> own(
      cloud.position.size()); // body, number there
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (const NodeIndex k : bodies[b].node.indices()) own[bodies[b].node[k]] = {b, recovered[b].now[k]};
    bodies[b].node.assign(recovered[b].cloud.position.size(), NodeIndex::none);
  }
  RecoveredBoundary all;
  all.cloud.piece_names = cloud.piece_names;
  for (const NodeIndex i : cloud.position.indices()) {
    const auto& [b, now] = own[i];
    all.now.push_back(exists(now) ? all.cloud.position.next() : NodeIndex::none);
    if (!exists(now)) continue;
    bodies[b].node[now] = all.now[i];
    all.cloud.position.push_back(recovered[b].cloud.position[now]);
    all.cloud.body.push_back(cloud.body[i]);
  }
  std::vector<Tetrahedra> meshes;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].facet.clear();
    for (Facet<3> facet : recovered[b].cloud.facets) {
      for (NodeIndex& i : facet.node) i = bodies[b].node[i];
      bodies[b].facet.push_back(all.cloud.facets.next());
      all.cloud.facets.push_back(facet);
    }
    meshes.push_back(std::move(recovered[b].tetrahedra));
    const RecoveryCounts& counts = recovered[b].counts;
    all.counts.lost += counts.lost;
    all.counts.flipped += counts.flipped;
    all.counts.held += counts.held;
    all.counts.removed += counts.removed;
    all.counts.replaced += counts.replaced;
    all.flipped = all.flipped || recovered[b].flipped;
  }
  for (const auto& [a, b] : cloud.twins) // those of two bodies too
    if (exists(all.now[a]) && exists(all.now[b])) all.cloud.twins.push_back({all.now[a], all.now[b]});
  if (!cloud.mates.empty()) all.cloud.mates = facets_behind(all.cloud);
  all.tetrahedra = joined(all.cloud, bodies, meshes);
  return all;
}

} // namespace

RecoveredBoundary recover_boundary(const Cloud<3>& cloud, const RecoveryRules& rules) {
  if (cloud.body.empty()) return Recovery(cloud, rules).run();
  std::vector<SingleBody> bodies = single_bodies(cloud);
  std::vector<RecoveredBoundary> recovered;
  for (const SingleBody& body : bodies) recovered.push_back(Recovery(body.cloud, rules).run());
  return joined(cloud, std::move(bodies), std::move(recovered));
}

} // namespace cnem::voronoi
