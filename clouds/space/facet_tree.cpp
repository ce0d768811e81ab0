#include "clouds/space/facet_tree.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace cnem::clouds {

namespace {

/// Weights of the corners at the point of a triangle that is nearest to x (Ericson 2005, 5.1.5); exactly 0
/// for corners that have no part in it.
std::array<double, 3> nearest_weights(const std::array<Vec3, 3>& t, const Vec3& x) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = x - t[0];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {1, 0, 0};
  const Vec3 bp = x - t[1];
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {1.0 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const Vec3 cp = x - t[2];
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {1.0 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1.0 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

} // namespace

FacetTree::FacetTree(const Cloud<3>& surface)
    : node_normal_(surface.position.size(), Vec3(0, 0, 0)), edge_normal_(surface.facets.size()) {
  std::map<std::array<NodeIndex, 2>, Vec3> edge;
  const auto key = [](NodeIndex a, NodeIndex b) { return std::array{std::min(a, b), std::max(a, b)}; };
  for (const CloudFacetIndex f : surface.facets.indices()) {
    const auto& node = surface.facets[f].node;
    Item item{corners_of(surface.facets[f], surface.position), node, {0, 0, 0}, 0.0, as<std::int32_t>(f)};
    const auto& x = item.corner;
    const Vec3 u = x[1] - x[0], v = x[2] - x[0], n = u.cross(v);
    const Vec3 to = (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2.0 * n.squaredNorm());
    item.centre = x[0] + to;
    item.radius = to.norm();
    facet_normal_.push_back(n.normalized());
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = x[(k + 1) % 3] - x[k], b = x[(k + 2) % 3] - x[k];
      node_normal_[node[k]] += std::atan2(a.cross(b).norm(), a.dot(b)) * facet_normal_.back();
      edge.try_emplace(key(node[k], node[(k + 1) % 3]), 0, 0, 0).first->second += facet_normal_.back();
    }
    items_.push_back(item);
  }
  for (const CloudFacetIndex f : surface.facets.indices())
    for (std::size_t k = 0; k < 3; ++k)
      edge_normal_[index_of(f)][k] =
          edge.at(key(surface.facets[f].node[k], surface.facets[f].node[(k + 1) % 3]));
  build(0, 0, static_cast<int>(items_.size()));
}

void FacetTree::build(int node, int begin, int end) {
  if (boxes_.size() <= index_of(node)) {
    boxes_.resize(index_of(node) + 1);
    range_.resize(index_of(node) + 1, {0, 0});
  }
  Box box{Vec3::Constant(std::numeric_limits<double>::max()),
          Vec3::Constant(-std::numeric_limits<double>::max())};
  for (int k = begin; k < end; ++k) {
    const Item& item = items_[index_of(k)];
    box.low = box.low.cwiseMin((item.centre.array() - item.radius).matrix());
    box.high = box.high.cwiseMax((item.centre.array() + item.radius).matrix());
  }
  boxes_[index_of(node)] = box;
  range_[index_of(node)] = {begin, end};
  if (end - begin <= leaf_size) return;
  int axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                   [&](const Item& a, const Item& b) {
                     return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis]
                                                             : a.facet < b.facet;
                   });
  build(2 * node + 1, begin, middle);
  build(2 * node + 2, middle, end);
}

Vec3 FacetTree::normal_at(const Item& item, const std::array<double, 3>& weight) const {
  const auto f = index_of(item.facet);
  for (std::size_t k = 0; k < 3; ++k) {
    if (weight[k] == 1.0) return node_normal_[item.node[k]];
    if (weight[k] == 0.0 && weight[(k + 1) % 3] > 0.0 && weight[(k + 2) % 3] > 0.0)
      return edge_normal_[f][(k + 1) % 3];
  }
  return facet_normal_[f];
}

FacetTree::Nearest FacetTree::nearest(const Vec3& x, double bound) const {
  double least = bound * bound;
  const Item* found = nullptr;
  std::array<double, 3> weights{};
  const auto away = [&](int node) {
    const Box& box = boxes_[index_of(node)];
    return (x - x.cwiseMax(box.low).cwiseMin(box.high)).squaredNorm();
  };
  std::array<std::pair<double, int>, 128> stack;
  int top = 0;
  stack[0] = {away(0), 0};
  while (top >= 0) {
    const auto [square, node] = stack[index_of(top--)];
    if (square > least) continue;
    const auto [begin, end] = range_[index_of(node)];
    if (end - begin > leaf_size) {
      std::pair<double, int> one{away(2 * node + 1), 2 * node + 1}, other{away(2 * node + 2), 2 * node + 2};
      if (one.first < other.first) std::swap(one, other);
      stack[index_of(++top)] = one;
      stack[index_of(++top)] = other;
      continue;
    }
    for (int k = begin; k < end; ++k) {
      const Item& item = items_[index_of(k)];
      const auto w = nearest_weights(item.corner, x);
      const Vec3 point = w[0] * item.corner[0] + w[1] * item.corner[1] + w[2] * item.corner[2];
      const double distance = (x - point).squaredNorm();
      if (distance > least || (distance == least && found && item.facet > found->facet)) continue;
      least = distance;
      found = &item;
      weights = w;
    }
  }
  if (!found) return {bound, x, -1};
  const Vec3 point =
      weights[0] * found->corner[0] + weights[1] * found->corner[1] + weights[2] * found->corner[2];
  const double side = normal_at(*found, weights).dot(x - point);
  return {side > 0.0 ? -std::sqrt(least) : std::sqrt(least), point, found->facet};
}

bool FacetTree::in_ball(const Vec3& x, double factor) const {
  std::array<int, 128> stack;
  int top = 0;
  stack[0] = 0;
  while (top >= 0) {
    const int node = stack[index_of(top--)];
    const Box& box = boxes_[index_of(node)];
    const Vec3 slack = Vec3::Constant(0.5 * (factor - 1.0) * (box.high - box.low).maxCoeff());
    if ((x.array() < (box.low - slack).array()).any() || (x.array() > (box.high + slack).array()).any())
      continue;
    const auto [begin, end] = range_[index_of(node)];
    if (end - begin > leaf_size) {
      stack[index_of(++top)] = 2 * node + 1;
      stack[index_of(++top)] = 2 * node + 2;
      continue;
    }
    for (int k = begin; k < end; ++k) {
      const Item& item = items_[index_of(k)];
      const double reach = factor * item.radius;
      if ((x - item.centre).squaredNorm() < reach * reach) return true;
    }
  }
  return false;
}

} // namespace cnem::clouds
