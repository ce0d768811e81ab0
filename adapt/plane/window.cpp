#include "adapt/plane/window.hpp"

#include "adapt/plane/cloud_edit.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cnem::adapt {

namespace {

constexpr double straight = 0.25;   ///< of the spacing: so far off a line nodes of a side may lie
constexpr double clear_node = 0.5;  ///< of the spacing: least distance of nodes from a new face
constexpr double clear_facet = 0.4; ///< the same along the boundary

/// The side that lies furthest along a direction, in the order of the boundary; empty where it is not one
/// straight piece.
std::vector<NodeIndex> leading_side(const CloudEdit& edit, const Vec2& along) {
  NodeIndex first = NodeIndex::none;
  double furthest = 0.0;
  for (const NodeIndex i : edit.old_nodes()) {
    if (!edit.on_boundary(i)) continue;
    const double reach = edit.at(i).dot(along);
    if (!exists(first) || reach > furthest) {
      first = i;
      furthest = reach;
    }
  }
  if (!exists(first)) return {};
  const auto belongs = [&](NodeIndex i) {
    return edit.at(i).dot(along) > furthest - straight * edit.size(i) && !edit.has_mates(i);
  };
  const NodeIndex start = first;
  while (belongs(edit.previous(first)) && edit.previous(first) != start) first = edit.previous(first);
  std::vector<NodeIndex> side;
  for (NodeIndex i = first; belongs(i); i = edit.next(i)) {
    if (!side.empty() && i == first) return {};
    side.push_back(i);
  }
  for (std::size_t k = 0; k + 1 < side.size(); ++k)
    if (edit.piece(side[k]) != edit.piece(side.front())) return {};
  return side.size() < 2 ? std::vector<NodeIndex>{} : side;
}

/// Nodes of the boundary from a corner of the leading side, without it, back along the strip; empty where
/// they do not lie on a straight line along the strip.
template<class Step>
std::optional<std::vector<NodeIndex>> flank(const CloudEdit& edit, NodeIndex corner, const Vec2& along,
                                            double from, const Step& step) {
  const Vec2 across = left_normal(along);
  const double level = edit.at(corner).dot(across);
  std::vector<NodeIndex> nodes;
  for (NodeIndex i = step(corner); edit.at(i).dot(along) > from; i = step(i)) {
    if (i == corner || std::abs(edit.at(i).dot(across) - level) > straight * edit.size(i) ||
        edit.has_mates(i))
      return std::nullopt;
    nodes.push_back(i);
  }
  return nodes;
}

} // namespace

std::optional<Resampling<2>> feed(const Cloud<2>& cloud, const Structure& structure,
                                  const NodeProperties& node,
                                  const IndexedVector<NodeIndex, Vec2>& undeformed, const Vec2& along,
                                  double length) {
  CloudEdit edit(cloud, structure, node);
  const std::vector<NodeIndex> side = leading_side(edit, along);
  if (side.empty()) return std::nullopt;
  const double end = edit.at(side.front()).dot(along), from = end - length;
  const auto before = flank(edit, side.front(), along, from, [&](NodeIndex i) { return edit.previous(i); }),
             after = flank(edit, side.back(), along, from, [&](NodeIndex i) { return edit.next(i); });
  if (!before || !after) return std::nullopt;
  const PieceIndex piece_before = edit.piece(edit.previous(side.front())),
                   piece_side = edit.piece(side.front()), piece_after = edit.piece(side.back());

  // the inside of the strip; nothing else of the boundary may lie in it
  Vec2 way = length * along; // of copies, with the side
  for (const NodeIndex i : side) way += (edit.at(i) - undeformed[i]) / static_cast<double>(side.size());
  const auto copy = [&](NodeIndex i) { return edit.add(undeformed[i] + way, i, true); };
  const auto clear = [&](NodeIndex i, double distance) {
    return edit.at(i).dot(along) - from > distance * edit.size(i);
  };
  std::size_t of_boundary = 0;
  for (const NodeIndex i : edit.old_nodes()) {
    if (!(edit.at(i).dot(along) > from)) continue;
    if (edit.on_boundary(i))
      ++of_boundary;
    else if (clear(i, clear_node))
      copy(i);
  }
  if (of_boundary != side.size() + before->size() + after->size()) return std::nullopt;

  // nodes of the side go inside, but for its ends
  const NodeIndex enters = edit.previous(side.front()), leaves = edit.next(side.back());
  std::vector<NodeIndex> replaced;
  for (const NodeIndex i : side) {
    edit.drop(i);
    replaced.push_back(edit.add(edit.at(i), i, false));
  }
  NodeIndex last = replaced.front();
  edit.link(enters, last, piece_before);
  const auto go_on = [&](NodeIndex to, PieceIndex piece) { edit.link(std::exchange(last, to), to, piece); };
  for (auto i = before->rbegin(); i != before->rend(); ++i)
    if (clear(*i, clear_facet)) go_on(copy(*i), piece_before);
  for (std::size_t k = 0; k < side.size(); ++k) go_on(copy(side[k]), k == 0 ? piece_before : piece_side);
  for (const NodeIndex i : *after)
    if (clear(i, clear_facet)) go_on(copy(i), piece_after);
  go_on(replaced.back(), piece_after);
  go_on(leaves, piece_after);
  return edit.finish();
}

namespace {

/// A straight line from one point to another, and where others lie beside it.
struct Line {
  Vec2 from, to;

  Vec2 way() const { return to - from; }
  double length() const { return way().norm(); }
  Vec2 point(double s) const { return from + s * way(); }
  double left_of(const Vec2& x) const { return cross(way(), x - from) / length(); }
  double distance(const Vec2& x) const { return foot_on(x, from, to).distance; }
  /// Whether it parts two points.
  bool crosses(const Vec2& a, const Vec2& b) const {
    const double la = left_of(a), lb = left_of(b);
    if ((la > 0.0) == (lb > 0.0)) return false;
    const double place = foot_on(a + la / (la - lb) * (b - a), from, to).place;
    constexpr double end = 1e-3; // that of a facet which the line ends on is crossed
    return place > -end && place < 1.0 + end;
  }
};

/// The facet nearest to x, by the node it leaves, and the point on it.
std::pair<NodeIndex, Vec2> nearest_facet(const CloudEdit& edit, const Cloud<2>& cloud, const Vec2& x) {
  NodeIndex nearest = NodeIndex::none;
  Foot best{};
  for (const Facet<2>& facet : cloud.facets) {
    const Foot foot = foot_on(x, edit.at(facet.node[0]), edit.at(facet.node[1]));
    if (exists(nearest) && foot.distance >= best.distance) continue;
    nearest = facet.node[0];
    best = foot;
  }
  const double s = std::clamp(best.place, 0.0, 1.0);
  return {nearest, (1.0 - s) * edit.at(nearest) + s * edit.at(edit.next(nearest))};
}

NodeIndex nearest_node(const Cloud<2>& cloud, const Vec2& x) {
  const auto& at = cloud.position;
  return as<NodeIndex>(std::min_element(at.begin(), at.end(),
                                        [&](const Vec2& a, const Vec2& b) {
                                          return (a - x).squaredNorm() < (b - x).squaredNorm();
                                        }) -
                       at.begin());
}

/// Points between the ends of a line, as far apart as the nodes along it want to be.
std::vector<Vec2> divisions(const Line& line, const Cloud<2>& cloud, const CloudEdit& edit) {
  constexpr int samples = 64;
  std::vector<double> cells{0.0}; // that fit in until there
  for (int k = 0; k < samples; ++k) {
    const double h = edit.size(nearest_node(cloud, line.point((k + 0.5) / samples)));
    cells.push_back(cells.back() + line.length() / samples / h);
  }
  const int count = std::max(1, static_cast<int>(std::lround(cells.back())));
  std::vector<Vec2> points;
  std::size_t k = 0;
  for (int c = 1; c < count; ++c) {
    const double wanted = cells.back() * c / count;
    while (cells[k + 1] < wanted) ++k;
    const double s = static_cast<double>(k) + (wanted - cells[k]) / (cells[k + 1] - cells[k]);
    points.push_back(line.point(s / samples));
  }
  return points;
}

/// Drops what can be reached from the nodes that are gone without crossing the line.
void drop_beyond(CloudEdit& edit, const Structure& structure, const Line& line,
                 std::vector<NodeIndex> front) {
  while (!front.empty()) {
    const NodeIndex i = front.back();
    front.pop_back();
    for (const NodeIndex k : structure.neighbours(i)) {
      if (edit.gone(k) || line.crosses(edit.at(i), edit.at(k))) continue;
      edit.drop(k);
      front.push_back(k);
    }
  }
}

} // namespace

std::optional<Resampling<2>> take_off(const Cloud<2>& cloud, const Structure& structure,
                                      const NodeProperties& node, const Vec2& from, const Vec2& to) {
  CloudEdit edit(cloud, structure, node);
  auto [before, start] = nearest_facet(edit, cloud, from);
  const auto [last, end] = nearest_facet(edit, cloud, to);
  const Line line{start, end};
  NodeIndex after = edit.next(last);
  if (before == last || !(line.length() > 0.0)) return std::nullopt;

  // what goes of the boundary
  std::vector<NodeIndex> front;
  PieceIndex piece = edit.piece(before);
  double furthest = 0.0;
  for (NodeIndex i = edit.next(before); i != after; i = edit.next(i)) {
    if (i == before) return std::nullopt; // the line joins two loops
    edit.drop(i);
    front.push_back(i);
    if (const double beyond = -line.left_of(edit.at(i)); beyond > furthest) {
      furthest = beyond;
      piece = edit.piece(i);
    }
  }

  // what would crowd the new face, and the rest beyond it
  const PieceIndex piece_after = edit.piece(last);
  const auto crowds = [&](NodeIndex i, const Vec2& x) {
    return (edit.at(i) - x).norm() < clear_facet * edit.size(i);
  };
  for (; crowds(before, start); before = edit.previous(before)) edit.drop(before);
  for (; crowds(after, end); after = edit.next(after)) edit.drop(after);
  if (edit.gone(before) || edit.gone(after) || edit.has_mates(before) || edit.has_mates(after))
    return std::nullopt;
  for (const NodeIndex i : edit.old_nodes()) {
    if (edit.gone(i) || line.distance(edit.at(i)) >= clear_node * edit.size(i)) continue;
    if (edit.on_boundary(i) && i != before && i != after) return std::nullopt;
    if (edit.on_boundary(i)) continue;
    edit.drop(i);
    if (line.left_of(edit.at(i)) < 0.0) front.push_back(i);
  }
  drop_beyond(edit, structure, line, std::move(front));

  const auto make = [&](const Vec2& x) { return edit.add(x, nearest_node(cloud, x)); };
  NodeIndex made = make(start);
  edit.link(before, made, edit.piece(before));
  for (const Vec2& x : divisions(line, cloud, edit)) {
    const NodeIndex inner = make(x);
    edit.link(made, inner, piece);
    made = inner;
  }
  const NodeIndex corner = make(end);
  edit.link(made, corner, piece);
  edit.link(corner, after, piece_after);
  return edit.finish();
}

} // namespace cnem::adapt
