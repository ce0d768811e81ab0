#include "clouds/generate_boundary.hpp"

#include "core/error.hpp"
#include "core/geometry/place_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <utility>

namespace cnem::clouds {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

void check_curve(const Curve& curve, const std::string& what, double size) {
  if (curve.pieces.empty()) throw GeometryError(what + " has no pieces; expected segments or arcs");
  for (std::size_t k = 0; k < curve.pieces.size(); ++k) {
    const CurvePiece& piece = curve.pieces[k];
    const CurvePiece& next = curve.pieces[(k + 1) % curve.pieces.size()];
    if (!(piece.from.allFinite() && piece.to.allFinite() && piece.centre.allFinite() &&
          std::isfinite(piece.radius)))
      throw GeometryError(fmt::format("{}: piece {} ('{}') is not finite", what, k + 1, piece.name));
    if ((piece.to - next.from).norm() > 1e-9 * size)
      throw GeometryError(
          fmt::format("{} is open: piece {} ('{}') ends at {} but the next one starts at {}; expected pieces "
                      "joined end to end",
                      what, k + 1, piece.name, place_text(piece.to), place_text(next.from)));
    if (piece.length() <= 1e-9 * size)
      throw GeometryError(fmt::format("{}: piece {} ('{}') at {} has no length", what, k + 1, piece.name,
                                      place_text(piece.from)));
    if (!piece.is_arc()) continue;
    for (const Vec2& end : {piece.from, piece.to})
      if (std::abs((end - piece.centre).norm() - piece.radius) > 1e-6 * size)
        throw GeometryError(fmt::format(
            "{}: arc {} ('{}') has its end {} at {:.6g} m from its centre {}; expected its radius, "
            "{:.6g} m",
            what, k + 1, piece.name, place_text(end), (end - piece.centre).norm(), place_text(piece.centre),
            piece.radius));
  }
  if (std::abs(curve.area()) <= 1e-12 * size * size)
    throw GeometryError(fmt::format("{} encloses no area", what));
}

/// Wanted edge length at x on a piece: h, on arcs also no more than 20° unless that were below 0.6 h, and no
/// more than 45° in any case.
double wanted_edge(const CurvePiece& piece, const SpacingField& spacing, const Vec2& x) {
  const double h = spacing.at(x);
  if (!piece.is_arc()) return h;
  const double by_angle =
      std::max(piece.radius * full_turn / 18.0, std::min(0.6 * h, piece.radius * full_turn / 8.0));
  return std::min(h, by_angle);
}

/// Fractions of a piece at which its nodes lie, from `begin` to `end` inclusive, so that each edge has the
/// same share of ∫ ds/h.
std::vector<double> share_out(const CurvePiece& piece, const SpacingField& spacing, double begin, double end,
                              int least) {
  const double length = piece.length();
  std::vector<double> s{begin}, sum{0.0};
  if (spacing.uniform()) {
    s.push_back(end);
    sum.push_back((end - begin) * length / wanted_edge(piece, spacing, piece.point(begin)));
  }
  while (s.back() < end) { // h changes by at most its growth (≤ 1) times the step
    const double start = wanted_edge(piece, spacing, piece.point(s.back()));
    const double step = std::min({0.2 * start / length, (end - begin) / 8.0, end - s.back()});
    const double middle = wanted_edge(piece, spacing, piece.point(s.back() + 0.5 * step));
    sum.push_back(sum.back() + step * length / middle);
    s.push_back(end - s.back() - step < 1e-9 * (end - begin) ? end : s.back() + step);
  }
  int count = static_cast<int>(piece.is_arc() ? std::ceil(sum.back() - 1e-6) : std::round(sum.back()));
  if (piece.is_arc())
    least = std::max(least, static_cast<int>(std::ceil(
                                (end - begin) * std::abs(piece.sweep()) / (full_turn / 8.0) - 1e-6)));
  count = std::max({count, least, 1});
  std::vector<double> nodes{begin};
  std::size_t interval = 1;
  for (int k = 1; k < count; ++k) {
    const double wanted = sum.back() * k / count;
    while (sum[interval] < wanted) ++interval;
    const double f = (wanted - sum[interval - 1]) / (sum[interval] - sum[interval - 1]);
    nodes.push_back(s[interval - 1] + f * (s[interval] - s[interval - 1]));
  }
  nodes.push_back(end);
  return nodes;
}

} // namespace

PieceIndex BoundaryChains::piece(const std::string& name) {
  const auto found = std::ranges::find(piece_names, name);
  const auto piece = as<PieceIndex>(found - piece_names.begin());
  if (found == piece_names.end()) piece_names.push_back(name);
  return piece;
}

double domain_size(const DomainShape& domain) {
  if (domain.outer.pieces.empty()) return 0.0;
  Vec2 low = domain.outer.pieces[0].from, high = low;
  for (const CurvePiece& piece : domain.outer.pieces)
    for (const double s : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      low = low.cwiseMin(piece.point(s));
      high = high.cwiseMax(piece.point(s));
    }
  return (high - low).norm();
}

DomainShape checked_and_oriented(const DomainShape& domain) {
  const double size = domain_size(domain);
  DomainShape result = domain;
  check_curve(domain.outer, "the outline", size);
  if (domain.outer.area() < 0.0) result.outer = domain.outer.reversed();
  for (std::size_t k = 0; k < domain.holes.size(); ++k) {
    check_curve(domain.holes[k], fmt::format("hole {}", k + 1), size);
    if (domain.holes[k].area() > 0.0) result.holes[k] = domain.holes[k].reversed();
  }
  for (const Crack& crack : domain.cracks) {
    if (crack.path.size() < 2)
      throw GeometryError(
          fmt::format("crack '{}' has {} points; expected at least two", crack.name, crack.path.size()));
    for (std::size_t k = 0; k < crack.path.size(); ++k) {
      if (!crack.path[k].allFinite())
        throw GeometryError(fmt::format("crack '{}': point {} is not finite", crack.name, k + 1));
      if (k > 0 && (crack.path[k] - crack.path[k - 1]).norm() <= 1e-9 * size)
        throw GeometryError(fmt::format("crack '{}': its points {} and {} coincide at {}", crack.name, k,
                                        k + 1, place_text(crack.path[k])));
    }
  }
  return result;
}

double nearest_fraction(const CurvePiece& piece, const Vec2& x) {
  if (!piece.is_arc()) {
    const Vec2 along = piece.to - piece.from;
    return std::clamp((x - piece.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  }
  const double sweep = piece.sweep();
  const Vec2 a = piece.from - piece.centre, b = x - piece.centre;
  double angle = std::atan2(cross(a, b), a.dot(b));
  if (sweep < 0.0) angle = -angle;
  if (angle < 0.0) angle += full_turn;
  const double s = angle / std::abs(sweep);
  if (s <= 1.0) return s;
  return (x - piece.from).norm() < (x - piece.to).norm() ? 0.0 : 1.0;
}

std::vector<Mouth> find_mouths(const DomainShape& domain, double tolerance) {
  std::vector<Mouth> mouths;
  for (std::size_t c = 0; c < domain.cracks.size(); ++c)
    for (const bool at_end : {false, true}) {
      const std::vector<Vec2>& path = domain.cracks[c].path;
      const Vec2 x = at_end ? path.back() : path.front();
      double nearest = tolerance;
      Mouth mouth;
      bool found = false;
      for (std::size_t curve = 0; curve <= domain.holes.size(); ++curve) {
        const auto& pieces = (curve == 0 ? domain.outer : domain.holes[curve - 1]).pieces;
        for (std::size_t p = 0; p < pieces.size(); ++p) {
          const double s = nearest_fraction(pieces[p], x);
          const double distance = (pieces[p].point(s) - x).norm();
          if (distance > nearest) continue;
          nearest = distance;
          mouth = {curve, p, s, c, at_end};
          found = true;
        }
      }
      if (!found) continue;
      const auto& pieces = (mouth.curve == 0 ? domain.outer : domain.holes[mouth.curve - 1]).pieces;
      const double length = pieces[mouth.piece].length();
      if (mouth.s * length <= tolerance) mouth.s = 0.0;
      if ((1.0 - mouth.s) * length <= tolerance) { // a corner belongs to the piece that starts there
        mouth.piece = (mouth.piece + 1) % pieces.size();
        mouth.s = 0.0;
      }
      mouths.push_back(mouth);
    }
  return mouths;
}

BoundaryChains discretise_boundary(const DomainShape& domain, const SpacingField& spacing) {
  BoundaryChains chains;
  const auto add = [&](const Vec2& x) {
    chains.vertex.push_back(x);
    return static_cast<std::int32_t>(chains.vertex.size()) - 1;
  };
  const std::vector<Mouth> mouths = find_mouths(domain, 1e-6 * domain_size(domain));
  std::map<std::pair<std::size_t, bool>, std::int32_t> vertex_of_mouth; // (crack, at_end)

  for (std::size_t curve = 0; curve <= domain.holes.size(); ++curve) {
    const auto& pieces = (curve == 0 ? domain.outer : domain.holes[curve - 1]).pieces;
    const auto first = static_cast<std::int32_t>(chains.vertex.size());
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      std::vector<double> cuts{0.0};
      for (const Mouth& mouth : mouths)
        if (mouth.curve == curve && mouth.piece == p && mouth.s > 0.0) cuts.push_back(mouth.s);
      std::ranges::sort(cuts);
      cuts.push_back(1.0);
      Chain chain;
      chain.piece = chains.piece(pieces[p].name);
      for (std::size_t c = 1; c < cuts.size(); ++c) {
        if (cuts[c] <= cuts[c - 1]) continue;
        const int least = pieces[p].is_arc() && pieces.size() < 3 ? 2 : 1;
        const auto nodes = share_out(pieces[p], spacing, cuts[c - 1], cuts[c], least);
        for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
          chain.vertex.push_back(add(pieces[p].point(nodes[k])));
        for (const Mouth& mouth : mouths)
          if (mouth.curve == curve && mouth.piece == p && mouth.s == cuts[c - 1])
            vertex_of_mouth[{mouth.crack, mouth.at_end}] =
                chain.vertex[chain.vertex.size() - nodes.size() + 1];
      }
      chain.vertex.push_back(p + 1 < pieces.size() ? static_cast<std::int32_t>(chains.vertex.size()) : first);
      chains.chains.push_back(std::move(chain));
    }
  }

  for (std::size_t c = 0; c < domain.cracks.size(); ++c) {
    const Crack& crack = domain.cracks[c];
    const auto mouth = [&](bool at_end) {
      const auto found = vertex_of_mouth.find({c, at_end});
      return found == vertex_of_mouth.end() ? -1 : found->second;
    };
    Chain chain;
    chain.piece = chains.piece(crack.name + "+");
    chain.back = chains.piece(crack.name + "-");
    chain.vertex.push_back(mouth(false) >= 0 ? mouth(false) : add(crack.path.front()));
    for (std::size_t k = 1; k < crack.path.size(); ++k) {
      CurvePiece segment;
      segment.from = crack.path[k - 1];
      segment.to = crack.path[k];
      const int least = crack.path.size() == 2 ? 2 : 1; // a single edge could not open
      const auto nodes = share_out(segment, spacing, 0.0, 1.0, least);
      for (std::size_t i = 1; i + 1 < nodes.size(); ++i) chain.vertex.push_back(add(segment.point(nodes[i])));
      const bool last = k + 1 == crack.path.size();
      chain.vertex.push_back(last && mouth(true) >= 0 ? mouth(true) : add(crack.path[k]));
    }
    chains.chains.push_back(std::move(chain));
  }
  return chains;
}

Cloud<2> assemble_boundary(const BoundaryChains& chains) {
  struct HalfEdge {
    std::int32_t from, to;
    PieceIndex piece;
    std::int32_t opposite = -1; ///< the other face of the same crack edge
    std::int32_t next = -1;
    NodeIndex start_node = NodeIndex::none;
  };
  std::vector<HalfEdge> edges;
  for (const Chain& chain : chains.chains)
    for (std::size_t k = 1; k < chain.vertex.size(); ++k) {
      const std::int32_t a = chain.vertex[k - 1], b = chain.vertex[k];
      const auto e = static_cast<std::int32_t>(edges.size());
      edges.push_back({a, b, chain.piece});
      if (!exists(chain.back)) continue;
      edges.back().opposite = e + 1;
      edges.push_back({b, a, chain.back});
      edges.back().opposite = e;
    }
  std::vector<std::vector<std::int32_t>> leaving(chains.vertex.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
    leaving[std::size_t(edges[e].from)].push_back(static_cast<std::int32_t>(e));

  Cloud<2> cloud;
  cloud.position = IndexedVector<NodeIndex, Vec2>(chains.vertex);
  cloud.piece_names = chains.piece_names;
  const auto direction = [&](const HalfEdge& e) {
    return Vec2(chains.vertex[std::size_t(e.to)] - chains.vertex[std::size_t(e.from)]);
  };
  std::vector<std::vector<NodeIndex>> copies(chains.vertex.size());
  for (HalfEdge& edge : edges) {
    // The wedge of material at the end of an edge lies clockwise of the way back, up to the next edge out.
    double smallest = 2.0 * full_turn;
    for (const std::int32_t out : leaving[std::size_t(edge.to)]) {
      const Vec2 back = -direction(edge), on = direction(edges[std::size_t(out)]);
      double turn = full_turn;
      if (out != edge.opposite) {
        turn = std::atan2(cross(on, back), on.dot(back));
        if (turn <= 0.0) turn += full_turn;
      }
      if (turn >= smallest) continue;
      smallest = turn;
      edge.next = out;
    }
    auto& nodes = copies[std::size_t(edge.to)];
    auto node = as<NodeIndex>(edge.to);
    if (!nodes.empty()) {
      node = cloud.position.next();
      cloud.position.push_back(chains.vertex[std::size_t(edge.to)]);
      for (const NodeIndex twin : nodes) cloud.twins.push_back({twin, node});
    }
    nodes.push_back(node);
    HalfEdge& next = edges[std::size_t(edge.next)];
    if (exists(next.start_node))
      throw GeometryError(
          fmt::format("the boundary '{}' runs over another part of itself at {}; expected curves "
                      "that meet nothing",
                      chains.piece_names[next.piece], place_text(chains.vertex[std::size_t(edge.to)])));
    next.start_node = node;
  }
  std::vector<bool> done(edges.size(), false);
  for (std::size_t begin = 0; begin < edges.size(); ++begin)
    for (std::size_t e = begin; !done[e]; e = std::size_t(edges[e].next)) {
      done[e] = true;
      cloud.facets.push_back(
          {{edges[e].start_node, edges[std::size_t(edges[e].next)].start_node}, edges[e].piece});
    }
  return cloud;
}

} // namespace cnem::clouds
