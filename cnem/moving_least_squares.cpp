#include "cnem/moving_least_squares.hpp"

#include "core/error.hpp"
#include "core/geometry/box_tree.hpp"
#include "core/index.hpp"
#include "core/machine/parallel.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <limits>

namespace cnem::scni {
namespace {

Field radii(const Cloud<2>& cloud, const CellLists<NodeIndex>& edges, double size) {
  constexpr double over_longest = 1.1;
  Field radius(cloud.position.size());
  for (std::size_t j = 0; j < radius.size(); ++j) {
    double sum = 0.0, longest = 0.0;
    for (const NodeIndex i : edges.of(j)) {
      const double length = (cloud.position[i] - cloud.position[j]).norm();
      sum += length;
      longest = std::max(longest, length);
    }
    radius[j] = std::max(size * sum / static_cast<double>(edges.of(j).size()), over_longest * longest);
  }
  return radius;
}

/// Lists of consecutive owners, put together from blocks.
template<class Item> struct ListBlock {
  std::vector<std::int32_t> size;
  std::vector<Item> item;
};
template<class Item> CellLists<Item> joined(const std::vector<ListBlock<Item>>& blocks) {
  CellLists<Item> lists;
  lists.begin.push_back(0);
  for (const auto& block : blocks) {
    for (const std::int32_t size : block.size) lists.begin.push_back(lists.begin.back() + size);
    lists.item.insert(lists.item.end(), block.item.begin(), block.item.end());
  }
  return lists;
}

/// Of each node J the nodes i with |x_i − x_J| < D_J + reach_i that edges lead to over such nodes. What of a
/// support sees its node is in one piece, so that the cells it is in are joined, and none is left out.
CellLists<NodeIndex> reached(const Cloud<2>& cloud, const CellLists<NodeIndex>& edges, const Field& radius,
                             const Field& reach) {
  const std::size_t nodes = radius.size();
  std::vector<ListBlock<NodeIndex>> lists(blocks(nodes));
  const auto list_block = [&](std::size_t b, IndexedVector<NodeIndex, NodeIndex>& seen_from) {
    ListBlock<NodeIndex>& list = lists[b];
    for (std::size_t k = b * block_size; k < std::min((b + 1) * block_size, nodes); ++k) {
      const auto j = as<NodeIndex>(k);
      const std::size_t first = list.item.size();
      list.item.push_back(j);
      seen_from[j] = j;
      for (std::size_t next = first; next < list.item.size(); ++next)
        for (const NodeIndex i : edges.of(list.item[next])) {
          if (seen_from[i] == j) continue;
          seen_from[i] = j;
          const double far = radius[k] + reach[index_of(i)];
          if ((cloud.position[i] - cloud.position[j]).squaredNorm() < far * far) list.item.push_back(i);
        }
      list.size.push_back(static_cast<std::int32_t>(list.item.size() - first));
    }
  };
#pragma omp parallel
  {
    IndexedVector<NodeIndex, NodeIndex> seen_from(nodes, NodeIndex::none);
#pragma omp for schedule(static)
    for (std::size_t b = 0; b < lists.size(); ++b) list_block(b, seen_from);
  }
  return joined(lists);
}

/// The facets that come as near to each node as the nodes around it and the points within its reach do.
CellLists<CloudFacetIndex> walls_near(const Cloud<2>& cloud, const CellLists<NodeIndex>& around,
                                      const Field& reach) {
  const auto in_space = [](const Vec2& x) { return Vec3(x.x(), x.y(), 0.0); };
  std::vector<Box<3>> boxes;
  for (const Facet<2>& facet : cloud.facets) {
    const Vec2 &a = cloud.position[facet.node[0]], &b = cloud.position[facet.node[1]];
    boxes.push_back({in_space(a.cwiseMin(b)), in_space(a.cwiseMax(b))});
  }
  const BoxTree tree(std::move(boxes));
  const auto distance2 = [&](const Vec2& x, const Facet<2>& facet) {
    const Vec2 &a = cloud.position[facet.node[0]], &b = cloud.position[facet.node[1]];
    const double s = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (x - a - s * (b - a)).squaredNorm();
  };
  std::vector<ListBlock<CloudFacetIndex>> lists(blocks(reach.size()));
  for_each_block(reach.size(), [&](std::size_t begin, std::size_t end) {
    ListBlock<CloudFacetIndex>& list = lists[begin / block_size];
    for (std::size_t i = begin; i < end; ++i) {
      const Vec2& x = cloud.position[i];
      double far2 = reach[i] * reach[i];
      for (const NodeIndex j : around.of(i)) far2 = std::max(far2, (cloud.position[j] - x).squaredNorm());
      const Vec2 half = Vec2::Constant(std::sqrt(far2));
      const std::size_t first = list.item.size();
      tree.overlapping({in_space(x - half), in_space(x + half)}, [&](std::int32_t f) {
        if (distance2(x, cloud.facets[index_of(f)]) <= far2) list.item.push_back(as<CloudFacetIndex>(f));
      });
      std::sort(list.item.begin() + static_cast<std::ptrdiff_t>(first), list.item.end());
      list.size.push_back(static_cast<std::int32_t>(list.item.size() - first));
    }
  });
  return joined(lists);
}

} // namespace

RegularisedWeight regularised_weight(double distance2, double support) {
  constexpr double omega = 1e-5;
  constexpr double end = 1.0 / ((1.0 + omega) * (1.0 + omega)), range = 1.0 / (omega * omega) - end;
  const double unit = 1.0 / (support * support), s = distance2 * unit;
  if (s >= 1.0) return {0.0, 0.0};
  const double inverse = 1.0 / (s + omega), square = inverse * inverse;
  return {(square - end) / range, -2.0 * square * inverse * unit / range};
}

void check_support(double size) {
  if (!(size >= 1.5 && size <= 5.0))
    throw InputError(fmt::format("a support of {:g} spacings: expected 1.5 to 5", size));
}

Supports supports(const Cloud<2>& cloud, const CellLists<NodeIndex>& edges, const Field& reach, double size) {
  check_support(size);
  Supports result;
  result.radius = radii(cloud, edges, size);
  const CellLists<NodeIndex> of_each = reached(cloud, edges, result.radius, reach);
  result.around = group_by_cell(
      reach.size(), reach.size(), [&](std::size_t j) { return of_each.of(j); },
      [](std::size_t j, NodeIndex) { return as<NodeIndex>(j); });
  result.walls = walls_near(cloud, result.around, reach);
  result.beside.assign(reach.size(), {NodeIndex::none, NodeIndex::none});
  for (const Facet<2>& facet : cloud.facets) {
    result.beside[facet.node[0]][1] = facet.node[1];
    result.beside[facet.node[1]][0] = facet.node[0];
  }
  return result;
}

MovingLeastSquares::MovingLeastSquares(const Cloud<2>& cloud, const Supports& supports)
    : cloud_(cloud), supports_(supports) {}

/// Facets that end where the node is do not stand between; whether they leave room for the way is seen from
/// what is beside the node on the boundary, as two faces of a crack may have nodes there.
bool MovingLeastSquares::hidden(NodeIndex node, const Vec2& way) const {
  if (const auto& [before, after] = supports_.beside[node]; exists(before)) {
    const Vec2& x = cloud_.position[node];
    const Vec2 in = cloud_.position[before] - x, out = cloud_.position[after] - x;
    const double from_out = -cross(out, way), to_in = cross(in, way); // of −way, which leads to the point
    if (cross(out, in) > 0.0 ? from_out < 0.0 || to_in < 0.0 : from_out < 0.0 && to_in < 0.0) return true;
  }
  return std::any_of(wall_.begin(), wall_.end(), [&](const Wall& wall) {
    if (cross(way, wall.a) * cross(way, wall.b) > 0.0 || wall.a == way || wall.b == way) return false;
    return cross(wall.b - wall.a, way - wall.a) < 0.0;
  });
}

void MovingLeastSquares::collect(const Vec2& x, NodeIndex near) {
  wall_.clear();
  for (const CloudFacetIndex f : supports_.walls.of(near)) {
    const Facet<2>& facet = cloud_.facets[f];
    const Vec2 a = cloud_.position[facet.node[0]] - x, b = cloud_.position[facet.node[1]] - x;
    if (cross(a, b) > 0.0) wall_.push_back({a, b}); // the domain is on its left, and so is x
  }
  node_.clear(), weight_.clear(), weight_gradient_.clear(), place_.clear();
  double least = std::numeric_limits<double>::infinity();
  NodeIndex nearest = near;
  for (const NodeIndex j : supports_.around.of(near)) {
    const Vec2 way = cloud_.position[j] - x;
    const double distance2 = way.squaredNorm();
    const double radius = supports_.radius[index_of(j)];
    if (distance2 >= radius * radius || hidden(j, way)) continue;
    const auto [weight, slope] = regularised_weight(distance2, radius);
    node_.push_back(j);
    weight_.push_back(weight);
    weight_gradient_.push_back(-2.0 * slope * way);
    if (distance2 < least) least = distance2, nearest = j;
  }
  const Vec2& origin = cloud_.position[nearest];
  for (const NodeIndex j : node_) place_.push_back(cloud_.position[j] - origin);
  at_ = x - origin;
}

MovingLeastSquares::Moments MovingLeastSquares::moments(const Vec2& x) const {
  constexpr double narrowest = 1e-24; // of moments; functions beyond it would be rounding
  Moments m{0.0, Vec2::Zero(), Mat2::Zero(), Vec2::Zero(), Vec2::Zero()};
  for (std::size_t k = 0; k < node_.size(); ++k) {
    m.total += weight_[k];
    m.mean += weight_[k] * place_[k];
  }
  m.mean /= m.total;
  Mat2 second = Mat2::Zero();
  for (std::size_t k = 0; k < node_.size(); ++k) {
    const Vec2 off = place_[k] - m.mean;
    second += weight_[k] * off * off.transpose();
  }
  const double trace = second.trace();
  if (!(second.determinant() > narrowest * trace * trace))
    throw GeometryError(fmt::format("the nodes that see the point ({:g}, {:g}) m lie in one line, expected a "
                                    "cloud with several rows of nodes",
                                    x.x(), x.y()));
  m.inverse = second.inverse();
  m.place = at_ - m.mean;
  m.a = m.inverse * m.place;
  return m;
}

void MovingLeastSquares::values(const Moments& m) {
  value_.resize(node_.size());
  double rest = 1.0;
  Vec2 off = m.place;
  for (std::size_t k = 0; k < node_.size(); ++k) {
    const Vec2 place = place_[k] - m.mean;
    value_[k] = weight_[k] * (1.0 / m.total + m.a.dot(place));
    rest -= value_[k];
    off -= value_[k] * place;
  }
  const Vec2 a = m.inverse * off;
  for (std::size_t k = 0; k < node_.size(); ++k)
    value_[k] += weight_[k] * (rest / m.total + a.dot(place_[k] - m.mean));
}

/// ∂_i of the values, with S_,i = Σ w_,i (ξ − μ) ⊗ (ξ − μ), as Σ w (ξ − μ) = 0.
void MovingLeastSquares::gradients(const Moments& m) {
  gradient_.assign(node_.size(), Vec2::Zero());
  for (Eigen::Index i = 0; i < 2; ++i) {
    double total = 0.0;
    Vec2 mean = Vec2::Zero(), turned = Vec2::Zero(); // S_,i a
    for (std::size_t k = 0; k < node_.size(); ++k) {
      const Vec2 place = place_[k] - m.mean;
      const double w = weight_gradient_[k][i];
      total += w;
      mean += w * place;
      turned += w * m.a.dot(place) * place;
    }
    mean /= m.total;
    const Vec2 a = m.inverse * (Vec2::Unit(i) - mean - turned);
    const double constant = -total / (m.total * m.total) - m.a.dot(mean);
    double rest = 0.0;
    Vec2 off = Vec2::Unit(i);
    for (std::size_t k = 0; k < node_.size(); ++k) {
      const Vec2 place = place_[k] - m.mean;
      const double slope =
          weight_gradient_[k][i] * (1.0 / m.total + m.a.dot(place)) + weight_[k] * (constant + a.dot(place));
      gradient_[k][i] = slope;
      rest -= slope;
      off -= slope * place;
    }
    const Vec2 mended = m.inverse * off;
    for (std::size_t k = 0; k < node_.size(); ++k)
      gradient_[k][i] += weight_[k] * (rest / m.total + mended.dot(place_[k] - m.mean));
  }
}

void MovingLeastSquares::evaluate(const Vec2& x, NodeIndex near) {
  collect(x, near);
  values(moments(x));
}

void MovingLeastSquares::evaluate_with_gradients(const Vec2& x, NodeIndex near) {
  collect(x, near);
  const Moments m = moments(x);
  values(m);
  gradients(m);
}

} // namespace cnem::scni
