#include "core/geometry/box_tree.hpp"

#include "core/index.hpp"

#include <numeric>
#include <utility>

namespace cnem {
namespace {

constexpr std::size_t leaf = 4; ///< boxes at most

} // namespace

BoxTree::BoxTree(std::vector<Box<3>> boxes) : box_(std::move(boxes)), order_(box_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) grow(order_);
}

std::int32_t BoxTree::grow(std::span<std::int32_t> part) {
  const auto at = branch_.size();
  branch_.emplace_back();
  Box<3> around = box_[index(part.front())];
  for (const std::int32_t i : part) {
    around.low = around.low.cwiseMin(box_[index(i)].low);
    around.high = around.high.cwiseMax(box_[index(i)].high);
  }
  branch_[at].box = around;
  if (part.size() <= leaf) {
    branch_[at].first = as<std::int32_t>(part.data() - order_.data());
    branch_[at].count = as<std::int32_t>(part.size());
    return as<std::int32_t>(at);
  }
  Eigen::Index axis = 0;
  (around.high - around.low).maxCoeff(&axis);
  const auto middle = [&](std::int32_t i) { return box_[index(i)].low[axis] + box_[index(i)].high[axis]; };
  const auto half = part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2);
  std::nth_element(part.begin(), half, part.end(), [&](std::int32_t i, std::int32_t j) {
    return std::pair(middle(i), i) < std::pair(middle(j), j);
  });
  const std::int32_t left = grow(part.first(part.size() / 2)), right = grow(part.subspan(part.size() / 2));
  branch_[at].left = left;
  branch_[at].right = right;
  return as<std::int32_t>(at);
}

} // namespace cnem
