// Insertion: nodes where the cloud has become too coarse.
#include "adapt/plane/resample.hpp"
#include "adapt/plane/simplices.hpp"
#include "core/index.hpp"
#include "voronoi/plane/locate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cnem::adapt {

namespace {

struct Gap {
  double length;                        ///< over its limit
  std::array<NodeIndex, 2> node;        ///< between these; none: at a Voronoi vertex
  std::array<SimplexIndex, 2> triangle; ///< that the new node lies in or between
  Vec2 x;
  bool of_film = false; ///< an edge so long that the nodes of the other face are no hindrance
};

/// The triangles that a new node at x does away with, and their nodes.
class Cavity {
public:
  Cavity(const WorkingCloud& work, const Structure& structure)
      : work_(work), structure_(structure), seen_(structure.mesh.node.size(), -1) {}

  void collect(const Gap& gap, std::int32_t stamp) {
    triangle_.clear();
    for (const SimplexIndex t : gap.triangle)
      if (exists(t)) visit(t, stamp);
    for (std::size_t k = 0; k < triangle_.size(); ++k)
      for (const SimplexIndex across : structure_.mesh.neighbour[triangle_[k]])
        if (exists(across) &&
            (structure_.circles.centre[across] - gap.x).squaredNorm() < structure_.circles.limit[across])
          visit(across, stamp);
  }
  const std::vector<SimplexIndex>& triangles() const { return triangle_; }

  /// Nothing is nearer to x than it should be.
  bool clear(const Gap& gap, bool on_boundary, const Thresholds& limit) const {
    for (const SimplexIndex t : triangle_)
      for (std::size_t k = 0; k < 3; ++k) {
        const NodeIndex i = structure_.mesh.node[t][k];
        const double h = work_.node().size[index_of(i)];
        const Vec2& x = work_.cloud().position[i];
        const bool across = gap.of_film && work_.on_boundary(i); // a film is as thin as it is
        if (!across && (x - gap.x).norm() < limit.clear_node * h) return false;
        if (on_boundary || !exists(structure_.mesh.facet[t][k])) continue;
        const Vec2 &a = work_.cloud().position[structure_.mesh.node[t][(k + 1) % 3]],
                   &b = work_.cloud().position[structure_.mesh.node[t][(k + 2) % 3]];
        if (cross(b - a, gap.x - a) < limit.clear_edge * h * (b - a).norm()) return false;
      }
    return true;
  }

private:
  void visit(SimplexIndex t, std::int32_t stamp) {
    if (seen_[t] == stamp) return;
    seen_[t] = stamp;
    triangle_.push_back(t);
  }

  const WorkingCloud& work_;
  const Structure& structure_;
  IndexedVector<SimplexIndex, std::int32_t> seen_; ///< by which gap
  std::vector<SimplexIndex> triangle_;
};

/// Debris is left as it is: a shred whose nodes have different velocities opens without end.
class Filling {
public:
  Filling(const WorkingCloud& work, const Structure& structure, const Thresholds& limit, Placement placement)
      : work_(work), structure_(structure), limit_(limit) {
    edges(placement == Placement::between_nodes);
    if (placement == Placement::voronoi_vertices) vertices();
    std::sort(gaps_.begin(), gaps_.end(), [](const Gap& a, const Gap& b) {
      if (a.length != b.length) return a.length > b.length;
      return a.triangle != b.triangle ? a.triangle < b.triangle : a.node < b.node;
    });
  }
  const std::vector<Gap>& gaps() const { return gaps_; }

  /// The gap on the mate of a boundary edge.
  Gap facing(const Gap& gap) const {
    const NodeIndex a = work_.facing(gap.node[0]), b = work_.next(a);
    Gap other = gap;
    other.node = {a, b};
    other.triangle = {structure_.mesh.triangle_of_node[a], SimplexIndex::none};
    other.x = 0.5 * (at(a) + at(b));
    return other;
  }

private:
  const Vec2& at(NodeIndex i) const { return work_.cloud().position[i]; }

  void edges(bool interior) {
    const auto& mesh = structure_.mesh;
    for (const SimplexIndex t : mesh.node.indices())
      for (std::size_t k = 0; k < 3; ++k) {
        const SimplexIndex across = mesh.neighbour[t][k];
        if (across > t || (exists(across) && !interior)) continue;
        const NodeIndex a = mesh.node[t][(k + 1) % 3], b = mesh.node[t][(k + 2) % 3];
        const double limit =
            (exists(across) ? limit_.long_edge : limit_.split_edge) * work_.size_between(a, b);
        const double squared = (at(b) - at(a)).squaredNorm();
        if (squared <= limit * limit || (work_.is_debris(a) && work_.is_debris(b))) continue;
        // boundary edges first
        const double length = std::sqrt(squared) / limit;
        gaps_.push_back({exists(across) ? length : 1e3 * length,
                         {a, b},
                         {t, across},
                         0.5 * (at(a) + at(b)),
                         !exists(across) && length * limit_.split_edge > limit_.film_edge});
      }
  }

  /// A lattice of edges d has its Voronoi vertices d/√3 from the nodes.
  void vertices() {
    const auto& mesh = structure_.mesh;
    for (const SimplexIndex t : mesh.node.indices()) {
      const auto& nodes = mesh.node[t];
      if (structure_.cells.hidden_of_triangle[t] >= 0 ||
          std::all_of(nodes.begin(), nodes.end(), [&](NodeIndex i) { return work_.is_debris(i); }))
        continue;
      double h = 0.0;
      for (const NodeIndex i : nodes) h += work_.node().size[index_of(i)] / 3.0;
      const Vec2& centre = structure_.circles.centre[t];
      const double radius = (centre - at(mesh.node[t][0])).norm();
      const double limit = limit_.long_edge / std::sqrt(3.0) * h;
      if (radius <= limit) continue;
      const auto end = voronoi::walk(work_.cloud(), mesh, t, centre);
      if (exists(end.facet)) continue;
      gaps_.push_back({radius / limit, {NodeIndex::none, NodeIndex::none}, {end.triangle, t}, centre});
    }
  }

  const WorkingCloud& work_;
  const Structure& structure_;
  const Thresholds& limit_;
  std::vector<Gap> gaps_;
};

} // namespace

std::vector<Parcel> stolen(const Cloud<2>& cloud, const Structure& before, const Structure& after,
                           const IndexedVector<NodeIndex, char>& made) {
  std::vector<Contribution> list = contributions(cloud, after, made);
  Field claimed(made.size(), 0.0);
  for (const Contribution& c : list) claimed[index_of(c.other)] += c.volume;
  std::vector<Parcel> parcels;
  for (const Contribution& c : list) {
    const double volume = before.volume(c.other), lost = (volume - after.volume(c.other)) / volume;
    if (lost > 0.0 && c.volume > 0.0)
      parcels.push_back({c.other, c.marked, lost * c.volume / claimed[index_of(c.other)]});
  }
  return parcels;
}

bool fill(WorkingCloud& work, Structure& structure, const Thresholds& thresholds, Placement placement,
          PassReport& report) {
  const Filling filling(work, structure, thresholds, placement);
  if (filling.gaps().empty()) return false;
  Cavity cavity(work, structure);
  IndexedVector<SimplexIndex, char> taken(structure.mesh.node.size(), 0);
  WorkingCloud filled = work;
  Simplices simplices(structure);
  PassReport done = report;
  std::int32_t stamp = 0;
  for (const Gap& gap : filling.gaps()) {
    const bool edge = exists(gap.node[0]), on_boundary = !exists(gap.triangle[1]);
    std::vector<Gap> together{gap};
    if (on_boundary && exists(work.facing(gap.node[0]))) together.push_back(filling.facing(gap));
    std::vector<SimplexIndex> triangles;
    bool clear = true;
    for (const Gap& one : together) {
      cavity.collect(one, stamp++);
      clear &= cavity.clear(one, on_boundary, thresholds);
      triangles.insert(triangles.end(), cavity.triangles().begin(), cavity.triangles().end());
    }
    if (!clear ||
        std::any_of(triangles.begin(), triangles.end(), [&](SimplexIndex t) { return taken[t] != 0; }))
      continue;
    for (const SimplexIndex t : triangles) taken[t] = 1;
    if (edge) {
      const NodeIndex made = filled.insert_between(gap.node[0], gap.node[1], on_boundary);
      for (std::size_t k = 0; k < together.size(); ++k)
        simplices.divide(together[k].node, together[k].triangle, as<NodeIndex>(index_of(made) + k));
    } else {
      simplices.divide(gap.triangle[0], filled.insert_at(gap.x, structure.mesh.node[gap.triangle[0]],
                                                         voronoi::barycentric(work.cloud(), structure.mesh,
                                                                              gap.triangle[0], gap.x)));
    }
    (on_boundary ? done.inserted_boundary : done.inserted) += static_cast<int>(together.size());
  }
  if (filled.size() == work.size()) return false;

  filled.refresh_facets();
  simplices.hand_to(filled);
  std::optional<Structure> after = structure_if_valid(filled.cloud(), structure.space);
  if (!after) {
    ++report.undone;
    return false;
  }
  IndexedVector<NodeIndex, char> made(filled.size(), 0);
  std::fill(made.begin() + static_cast<std::ptrdiff_t>(work.size()), made.end(), 1);
  filled.move(stolen(filled.cloud(), structure, *after, made));
  for (std::size_t i = work.size(); i < filled.size(); ++i)
    if (!(filled.node().mass[i] > 0.0)) {
      ++report.undone;
      return false;
    }
  work = std::move(filled);
  structure = std::move(*after);
  report = done;
  return true;
}

} // namespace cnem::adapt
