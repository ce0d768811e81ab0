#include "clouds/generate_list.hpp"

#include "core/error.hpp"
#include "core/geometry/place_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <optional>

namespace cnem::clouds {

namespace {

void check_distinct(const std::vector<Vec2>& nodes, double tolerance) {
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t k) { return nodes[k].x(); });
  // Columns of nearly equal x, each then searched along y.
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    end = begin + 1;
    while (end < order.size() && nodes[order[end]].x() - nodes[order[end - 1]].x() <= tolerance) ++end;
    std::sort(order.begin() + std::ptrdiff_t(begin), order.begin() + std::ptrdiff_t(end),
              [&](std::size_t a, std::size_t b) {
                return nodes[a].y() != nodes[b].y() ? nodes[a].y() < nodes[b].y() : a < b;
              });
    for (std::size_t k = begin + 1; k < end; ++k) {
      const auto [first, second] = std::minmax(order[k - 1], order[k]);
      if ((nodes[first] - nodes[second]).norm() <= tolerance)
        throw GeometryError(
            fmt::format("nodes {} and {} of the list coincide at {}; expected each node once, also "
                        "on cracks, whose faces are doubled automatically",
                        first, second, place_text(nodes[second], 9)));
    }
  }
}

struct OnPiece {
  double s;
  std::int32_t node;
};

/// Nodes on a piece in the sense of travel, ends included.
std::vector<OnPiece> nodes_on(const CurvePiece& piece, const std::vector<Vec2>& nodes, double tolerance) {
  Vec2 low = piece.from.cwiseMin(piece.to), high = piece.from.cwiseMax(piece.to);
  if (piece.is_arc()) {
    low = piece.centre.array() - piece.radius;
    high = piece.centre.array() + piece.radius;
  }
  low.array() -= tolerance;
  high.array() += tolerance;
  std::vector<OnPiece> found;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec2& x = nodes[k];
    if (x.x() < low.x() || x.y() < low.y() || x.x() > high.x() || x.y() > high.y()) continue;
    const double s = nearest_fraction(piece, x);
    if ((piece.point(s) - x).norm() <= tolerance) found.push_back({s, static_cast<std::int32_t>(k)});
  }
  std::ranges::sort(found, {}, &OnPiece::s);
  return found;
}

} // namespace

BoundaryChains list_boundary(const DomainShape& domain, const std::vector<Vec2>& nodes) {
  const double tolerance = 1e-9 * domain_size(domain);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (!nodes[k].allFinite()) throw GeometryError(fmt::format("node {} of the list is not finite", k));
  check_distinct(nodes, tolerance);

  BoundaryChains chains;
  chains.vertex = nodes;
  const auto node_at = [&](const std::vector<OnPiece>& on, const Vec2& x) -> std::optional<std::int32_t> {
    for (const OnPiece& candidate : on)
      if ((nodes[std::size_t(candidate.node)] - x).norm() <= tolerance) return candidate.node;
    return std::nullopt;
  };
  const auto chain_along = [&](const CurvePiece& piece, const std::string& where) {
    const std::vector<OnPiece> on = nodes_on(piece, nodes, tolerance);
    Chain chain;
    if (piece.is_arc() && (piece.to - piece.from).norm() <= tolerance) { // a full circle has no corner
      if (on.size() < 3)
        throw GeometryError(fmt::format("{}: {} nodes of the list lie on the circle; expected at least three",
                                        where, on.size()));
      for (const OnPiece& node : on) chain.vertex.push_back(node.node);
      chain.vertex.push_back(on.front().node);
      return chain;
    }
    const auto first = node_at(on, piece.from), last = node_at(on, piece.to);
    for (const auto& [node, x] : {std::pair(first, piece.from), std::pair(last, piece.to)})
      if (!node)
        throw GeometryError(
            fmt::format("{}: no node of the list lies at {}; expected one at every corner, at "
                        "every end of a boundary piece and at the tips and kinks of cracks",
                        where, place_text(x, 9)));
    chain.vertex.push_back(*first);
    for (const OnPiece& node : on)
      if (node.node != *first && node.node != *last) chain.vertex.push_back(node.node);
    chain.vertex.push_back(*last);
    return chain;
  };

  for (std::size_t curve = 0; curve <= domain.holes.size(); ++curve)
    for (const CurvePiece& piece : (curve == 0 ? domain.outer : domain.holes[curve - 1]).pieces) {
      chains.chains.push_back(chain_along(piece, fmt::format("boundary piece '{}'", piece.name)));
      chains.chains.back().piece = chains.piece(piece.name);
    }
  for (const Crack& crack : domain.cracks) {
    Chain whole;
    for (std::size_t k = 1; k < crack.path.size(); ++k) {
      CurvePiece segment;
      segment.from = crack.path[k - 1];
      segment.to = crack.path[k];
      const Chain part = chain_along(segment, fmt::format("crack '{}'", crack.name));
      whole.vertex.insert(whole.vertex.end(), part.vertex.begin() + (k > 1 ? 1 : 0), part.vertex.end());
    }
    whole.piece = chains.piece(crack.name + "+");
    whole.back = chains.piece(crack.name + "-");
    chains.chains.push_back(std::move(whole));
  }
  return chains;
}

} // namespace cnem::clouds
