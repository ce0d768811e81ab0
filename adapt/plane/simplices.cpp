#include "adapt/plane/simplices.hpp"

#include "core/index.hpp"

#include <algorithm>

namespace cnem::adapt {

namespace {

/// Cuts ears off a polygon, nodes counter-clockwise. Where rounding leaves none that is clean any corner
/// goes: triangulating notices.
void fill_polygon(const IndexedVector<NodeIndex, Vec2>& at, std::vector<NodeIndex> polygon,
                  std::vector<std::array<NodeIndex, 3>>& made) {
  while (polygon.size() > 2) {
    const std::size_t n = polygon.size();
    const auto is_ear = [&](std::size_t k) {
      const Vec2 &a = at[polygon[(k + n - 1) % n]], &b = at[polygon[k]], &c = at[polygon[(k + 1) % n]];
      if (!(cross(b - a, c - a) > 0.0)) return false;
      for (std::size_t m = 2; m + 1 < n; ++m) {
        const Vec2& x = at[polygon[(k + m) % n]];
        if (cross(b - a, x - a) >= 0.0 && cross(c - b, x - b) >= 0.0 && cross(a - c, x - c) >= 0.0)
          return false;
      }
      return true;
    };
    std::size_t ear = 0;
    while (ear < n && !is_ear(ear)) ++ear;
    ear %= n;
    made.push_back({polygon[(ear + n - 1) % n], polygon[ear], polygon[(ear + 1) % n]});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
  }
}

} // namespace

void Simplices::remove(const WorkingCloud& work, NodeIndex node) {
  std::vector<NodeIndex> polygon;
  const SimplexIndex first = mesh_.triangle_of_node[node];
  for (SimplexIndex t = first;
       exists(t);) { // counter-clockwise, of boundary nodes from the facet that leaves
    const auto& corner = mesh_.node[t];
    const auto k = index_of(std::find(corner.begin(), corner.end(), node) - corner.begin());
    if (polygon.empty()) polygon.push_back(corner[(k + 1) % 3]);
    polygon.push_back(corner[(k + 2) % 3]);
    gone_[t] = 1;
    t = mesh_.neighbour[t][(k + 1) % 3];
    if (t == first) {
      polygon.pop_back();
      break;
    }
  }
  fill_polygon(work.cloud().position, std::move(polygon), made_);
}

void Simplices::divide(const std::array<NodeIndex, 2>& side, const std::array<SimplexIndex, 2>& triangle,
                       NodeIndex made) {
  for (const SimplexIndex t : triangle) {
    if (!exists(t)) continue;
    gone_[t] = 1;
    for (const NodeIndex end : side) {
      Corners half = mesh_.node[t];
      std::replace(half.begin(), half.end(), end, made);
      made_.push_back(half);
    }
  }
}

void Simplices::divide(SimplexIndex triangle, NodeIndex made) {
  gone_[triangle] = 1;
  for (const NodeIndex corner : mesh_.node[triangle]) {
    Corners third = mesh_.node[triangle];
    std::replace(third.begin(), third.end(), corner, made);
    made_.push_back(third);
  }
}

IndexedVector<SimplexIndex, Simplices::Corners> Simplices::list() const {
  IndexedVector<SimplexIndex, Corners> list;
  list.reserve(mesh_.node.size() + made_.size());
  for (const SimplexIndex t : mesh_.node.indices())
    if (!gone_[t]) list.push_back(mesh_.node[t]);
  list.insert(list.end(), made_.begin(), made_.end());
  return list;
}

/// Of triangles that stay, by their new numbers; of those that were made it is left to be found.
IndexedVector<SimplexIndex, std::array<SimplexIndex, 3>> Simplices::across() const {
  constexpr std::array unknown{SimplexIndex::none, SimplexIndex::none, SimplexIndex::none};
  IndexedVector<SimplexIndex, SimplexIndex> number(mesh_.node.size(), SimplexIndex::none);
  std::size_t kept = 0;
  for (const SimplexIndex t : mesh_.node.indices())
    if (!gone_[t]) number[t] = as<SimplexIndex>(kept++);
  IndexedVector<SimplexIndex, std::array<SimplexIndex, 3>> across;
  across.reserve(mesh_.node.size() + made_.size());
  for (const SimplexIndex t : mesh_.node.indices()) {
    if (gone_[t]) continue;
    across.push_back(unknown);
    for (std::size_t k = 0; k < 3; ++k)
      if (exists(mesh_.neighbour[t][k])) across.back()[k] = number[mesh_.neighbour[t][k]];
  }
  across.resize(across.size() + made_.size(), unknown);
  return across;
}

void Simplices::hand_to(WorkingCloud& work) const { work.begin_with(list(), across()); }

void Simplices::hand_to(WorkingCloud& work, const IndexedVector<NodeIndex, NodeIndex>& number) const {
  IndexedVector<SimplexIndex, Corners> renamed = list();
  for (Corners& corner : renamed)
    for (NodeIndex& i : corner) i = number[i];
  work.begin_with(std::move(renamed), across());
}

} // namespace cnem::adapt
