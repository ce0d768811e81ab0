#include "adapt/space/refine_surface.hpp"

#include "adapt/space/sharp_creases.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <initializer_list>
#include <tuple>

namespace cnem::adapt {

using Edge = WorkingSurface::Edge;

namespace {

class Refinement {
public:
  Refinement(WorkingSurface& surface, Field& size, const Field& matter, const SurfaceThresholds& limits,
             PassReport& report, const PeriodImages& images)
      : surface_(surface), alike_(surface, images), size_(size), matter_(matter),
        wide_(spacing_at_sharp_creases(surface, size)), limit_(limits), report_(report),
        old_nodes_(size.size()), debt_(size.size(), 0.0) {
    result_.into.assign(size.size(), NodeIndex::none);
  }

  RefinedSurface run() {
    collapse_light();
    flip_all();
    for (int round = 0; round < limit_.rounds; ++round) {
      const int before = changes_;
      split_long();
      flip_all();
      collapse_short();
      collapse_tips();
      flip_all();
      flip_films();
      if (changes_ == before) break;
    }
    give_back(surface_, std::move(debt_), size_, limit_.give_back, true);
    return std::move(result_);
  }

private:
  /// An edge that is to change, and its nodes, by which it is known to be there still.
  struct Candidate {
    double order;
    NodeIndex start, end;
    bool operator<(const Candidate& other) const {
      return std::tie(order, start, end) < std::tie(other.order, other.start, other.end);
    }
  };

  /// What volumes are measured with.
  double size(Edge e) const {
    return 0.5 * (size_[index_of(surface_.start(e))] + size_[index_of(surface_.end(e))]);
  }
  /// What lengths are measured with.
  double spacing(NodeIndex i, NodeIndex k) const { return 0.5 * (wide_[index_of(i)] + wide_[index_of(k)]); }
  double spacing(Edge e) const { return spacing(surface_.start(e), surface_.end(e)); }

  /// Edges, each once, with an order below zero for those that are to change.
  template<class Order> std::vector<Candidate> candidates(const Order& order) const {
    std::vector<Candidate> list;
    for (Edge e = 0; e < surface_.edges(); ++e) {
      if (!surface_.alive(e) || surface_.across(e) < e) continue;
      const NodeIndex a = std::min(surface_.start(e), surface_.end(e)),
                      b = std::max(surface_.start(e), surface_.end(e));
      if (const double value = order(e); value < 0.0) list.push_back({value, a, b});
    }
    std::sort(list.begin(), list.end());
    return list;
  }

  void owe(double volume, std::initializer_list<NodeIndex> nodes) {
    for (const NodeIndex i : nodes) debt_[index_of(i)] += volume / static_cast<double>(nodes.size());
  }

  void split_long() {
    constexpr int halvings = 4;
    for (int n = 0; n < halvings; ++n) {
      const auto list = candidates([&](Edge e) {
        return surface_.apart(e) ? 0.0 : limit_.split_edge - surface_.length(e) / spacing(e);
      });
      int done = 0;
      for (const Candidate& c : list) {
        for (const auto& [start, end, made] : alike_.split(surface_.between(c.start, c.end))) {
          result_.made.push_back({start, end});
          result_.into.push_back(NodeIndex::none);
          size_.push_back(0.5 * (size_[index_of(start)] + size_[index_of(end)]));
          wide_.push_back(spacing(start, end));
          debt_.push_back(0.0);
          ++report_.inserted_boundary;
          ++done;
        }
      }
      changes_ += done;
      if (done == 0) return;
      flip_all();
    }
  }

  void flip_all() {
    std::deque<std::array<NodeIndex, 2>> queue;
    const auto push = [&](Edge e) { queue.push_back({surface_.start(e), surface_.end(e)}); };
    for (Edge e = 0; e < surface_.edges(); ++e)
      if (surface_.alive(e) && e < surface_.across(e) && surface_.wants_flip(e)) push(e);
    // Lawson's flips come to an end on a plane; on a bent surface they might not
    for (std::ptrdiff_t left = 4 * surface_.edges(); left > 0 && !queue.empty(); --left) {
      const auto [a, b] = queue.front();
      queue.pop_front();
      const Edge e = surface_.on_surface(a) ? surface_.between(a, b) : WorkingSurface::no_edge;
      if (e == WorkingSurface::no_edge || !surface_.wants_flip(e)) continue;
      const std::vector<Edge> all = alike_.edges(e);
      if (!alike_.may_flip(all, size(e))) continue;
      for (const Edge k : all) flip(k, Flip::in_shape, push);
    }
  }

  void flip_films() {
    for (Edge e = 0; e < surface_.edges(); ++e) {
      if (!surface_.alive(e) || surface_.across(e) < e) continue;
      const std::vector<Edge> all = alike_.edges(e);
      if (!surface_.try_flip(e, size(e), Flip::of_film).done() ||
          !alike_.may_flip(all, size(e), Flip::of_film))
        continue;
      for (const Edge k : all) flip(k, Flip::of_film, [](Edge) {});
    }
  }

  template<class Push> void flip(Edge e, Flip kind, const Push& push) {
    const NodeIndex a = surface_.start(e), b = surface_.end(e), c = surface_.apex(e),
                    d = surface_.apex(surface_.across(e));
    const SurfaceChange change = surface_.flip(e, size(e), kind);
    if (!change.done()) return;
    owe(-change.volume, {a, b, c, d});
    ++report_.flipped;
    ++changes_;
    for (const auto& [from, to] : {std::array{a, c}, {c, b}, {b, d}, {d, a}})
      push(surface_.between(from, to));
  }

  /// The less there is to lose with a node, the sooner it goes: new nodes, those inside of faces, on creases.
  int rank(NodeIndex i) const {
    if (surface_.held(i) || surface_.corner(i)) return 3;
    return surface_.on_crease(i) ? 2 : index_of(i) < old_nodes_ ? 1 : 0;
  }

  void collapse_short() {
    const auto shortness = [&](Edge e) { return surface_.length(e) / spacing(e) - limit_.short_edge; };
    // of a row of short edges every second node goes, not all
    IndexedVector<NodeIndex, char> stays(surface_.nodes(), 0);
    const auto go = [&](NodeIndex gone, NodeIndex into) {
      if (!surface_.on_surface(gone) || !surface_.on_surface(into)) return false;
      const Edge short_edge = surface_.between(gone, into);
      if (short_edge == WorkingSurface::no_edge) return false;
      std::vector<NodeIndex> beside;
      for (const Edge image : alike_.edges(short_edge)) { // those shifted by a period go with it
        const NodeIndex start = surface_.start(image);
        if (stays[start]) return false;
        surface_.around(start, [&](Edge e) { beside.push_back(surface_.end(e)); });
      }
      if (!collapse(gone, into)) return false;
      for (const NodeIndex i : beside) stays[i] = 1;
      return true;
    };
    for (const Candidate& c : candidates(shortness)) {
      const bool first = rank(c.start) <= rank(c.end);
      if (!go(first ? c.start : c.end, first ? c.end : c.start))
        go(first ? c.end : c.start, first ? c.start : c.end);
    }
    // nodes that creases have come near to
    std::vector<Candidate> list;
    for (Edge e = 0; e < surface_.edges(); ++e) {
      if (!surface_.alive(e) || !surface_.crease(e)) continue;
      const NodeIndex a = surface_.start(e), b = surface_.end(e), i = surface_.apex(e);
      const Vec3 along = surface_.at(b) - surface_.at(a), to = surface_.at(i) - surface_.at(a);
      const double place = to.dot(along) / along.squaredNorm();
      const double height = along.cross(to).norm() / along.norm() / spacing(e);
      if (!(place > 0.0 && place < 1.0 && height < limit_.low_height)) continue;
      list.push_back({height, i, place < 0.5 ? a : b});
    }
    std::sort(list.begin(), list.end());
    for (const Candidate& c : list) collapse(c.start, c.end);
  }

  /// Nodes with next to no matter: they stand on a facet of nodes around them, whose tetrahedra are theirs,
  /// or are the flat top of one tetrahedron.
  void collapse_light() {
    std::vector<Candidate> list;
    for (std::size_t i = 0; i < old_nodes_; ++i) {
      const double share = matter_[i] / (size_[i] * size_[i] * size_[i]);
      const auto node = as<NodeIndex>(i);
      if (share < limit_.light && surface_.on_surface(node)) list.push_back({share, node, node});
    }
    std::sort(list.begin(), list.end());
    for (const Candidate& light : list)
      if (surface_.on_surface(light.start)) collapse_some_way(light.start, Collapse::of_light);
  }

  /// Ends of whiskers and corners of films, one after the other: each goes into the nearest of the nodes
  /// beside it.
  void collapse_tips() {
    for (bool any = true; any;) {
      any = false;
      for (const NodeIndex i : IndexRange<NodeIndex>(surface_.nodes())) {
        if (surface_.is_tip(i, size_[index_of(i)])) any = collapse_some_way(i, Collapse::of_tip) || any;
      }
    }
  }

  /// Into the nearest of the nodes beside it that it can go into.
  bool collapse_some_way(NodeIndex i, Collapse kind) {
    std::vector<Candidate> ways;
    surface_.around(i, [&](Edge e) { ways.push_back({surface_.length(e), i, surface_.end(e)}); });
    std::sort(ways.begin(), ways.end());
    return std::any_of(ways.begin(), ways.end(), [&](const Candidate& way) {
      const std::vector<Edge> all = alike_.edges(surface_.between(i, way.end));
      const double spacing = size_[index_of(i)];
      if (!alike_.may_collapse(all, spacing, kind)) return false;
      bool done = false;
      for (const Edge k : all) done |= collapse(k, spacing, kind);
      return done;
    });
  }

  bool collapse(NodeIndex gone, NodeIndex stays) {
    if (!surface_.on_surface(gone) || !surface_.on_surface(stays)) return false;
    const Edge e = surface_.between(gone, stays);
    if (e == WorkingSurface::no_edge) return false;
    constexpr double at_once = 0.25; // h: so short that long edges beside it do not matter
    bool too_long = false;
    surface_.around(gone, [&](Edge k) {
      const NodeIndex i = surface_.end(k);
      too_long |= (surface_.at(i) - surface_.at(stays)).norm() > limit_.split_edge * spacing(i, stays);
    });
    if (too_long && surface_.length(e) > at_once * size(e)) return false;
    const std::vector<Edge> all = alike_.edges(e);
    if (!alike_.may_collapse(all, size(e))) return false;
    bool done = false;
    for (const Edge k : all) done |= collapse(k, size(k), Collapse::in_shape);
    return done;
  }

  bool collapse(Edge e, double spacing, Collapse kind) {
    const NodeIndex gone = surface_.start(e), stays = surface_.end(e), c = surface_.apex(e),
                    d = surface_.apex(surface_.across(e));
    const SurfaceChange change = surface_.collapse(e, spacing, kind);
    if (!change.done()) return false;
    owe(debt_[index_of(gone)] - change.volume, {stays, c, d});
    debt_[index_of(gone)] = 0.0;
    result_.into[gone] = stays;
    ++report_.removed_boundary;
    ++changes_;
    return true;
  }

  WorkingSurface& surface_;
  AlikeEdits alike_;
  Field& size_;
  const Field& matter_;
  Field wide_; ///< [node] m, spacing of the surface, wider than wanted at sharp creases
  const SurfaceThresholds& limit_;
  PassReport& report_;
  std::size_t old_nodes_;
  Field debt_; ///< [node] m³, volume that it is to win back
  RefinedSurface result_;
  int changes_ = 0;
};

} // namespace

void give_back(WorkingSurface& surface, Field debt, const Field& size, double most, bool further) {
  const int times = further ? 12 : 3;
  for (int n = 0; n < times; ++n) {
    Field left(debt.size(), 0.0);
    for (const NodeIndex i : IndexRange<NodeIndex>(debt.size())) {
      const double owed = debt[index_of(i)], h = size[index_of(i)];
      if (std::abs(owed) < 1e-12 * h * h * h) continue;
      if (surface.swell(i, owed, most * h)) continue;
      std::vector<NodeIndex> beside, all;
      surface.around(i, [&](Edge e) {
        all.push_back(surface.end(e));
        if (surface.way_of_volume(surface.end(e)) != Vec3::Zero()) beside.push_back(surface.end(e));
      });
      if (further && beside.empty()) beside = all; // who pass it on
      for (const NodeIndex k : beside) left[index_of(k)] += owed / static_cast<double>(beside.size());
    }
    debt = std::move(left);
  }
}

WorkingSurface swollen_by(double volume, const Cloud<3>& cloud, std::span<const NodeIndex> giving,
                          const IndexedVector<NodeIndex, char>& fixed, const Field& size,
                          const SurfaceRules& rules, double most) {
  Field debt(cloud.position.size(), 0.0);
  for (const NodeIndex i : giving) debt[index_of(i)] = volume / static_cast<double>(giving.size());
  WorkingSurface surface(cloud, fixed, rules);
  give_back(surface, std::move(debt), size, most);
  return surface;
}

RefinedSurface refine_surface(WorkingSurface& surface, Field& size, const Field& matter,
                              const SurfaceThresholds& limits, PassReport& report,
                              const PeriodImages& images) {
  assert(matter.size() == size.size());
  return Refinement(surface, size, matter, limits, report, images).run();
}

} // namespace cnem::adapt
