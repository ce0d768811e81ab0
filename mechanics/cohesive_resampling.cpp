// How cohesive interfaces follow a changed cloud, and what a checkpoint keeps of them.
#include "core/index.hpp"
#include "mechanics/cohesive_faces.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace cnem {
namespace {

constexpr double elsewhere = 0.5; ///< of a facet: chords of what was bent are nearer
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Linear between the ends of an element.
CohesiveEnd between(const std::array<CohesiveEnd, 2>& ends, double place) {
  const auto mean = [&](double a, double b) {
    return place == 0.0 ? a : place == 1.0 ? b : (1.0 - place) * a + place * b;
  };
  CohesiveEnd result;
  result.damage = mean(ends[0].damage, ends[1].damage);
  result.offset = mean(ends[0].offset, ends[1].offset);
  for (Eigen::Index k = 0; k < 2; ++k)
    result.separation[k] = mean(ends[0].separation[k], ends[1].separation[k]);
  return result;
}

using Arcs = IndexedVector<NodeIndex, double>; ///< [node] m, NaN where it is not known

/// Of the old nodes of a face.
Arcs old_arcs(const std::vector<BondedSegment>& before, const Resampling<2>& change) {
  Arcs old(change.new_of.size(), unknown);
  for (const BondedSegment& segment : before)
    for (std::size_t k = 0; k < 2; ++k) old[segment.node[k]] = segment.arc[k];
  return old;
}

/// Of new nodes that are old nodes of a face, or made of such alone.
Arcs known_arcs(const Arcs& old, const Resampling<2>& change) {
  Arcs now(change.old_of.size(), unknown);
  for (const NodeIndex i : now.indices()) {
    if (exists(change.old_of[i])) {
      now[i] = old[change.old_of[i]];
      continue;
    }
    now[i] = 0.0;
    const auto p = index_of(i);
    for (auto e = index_of(change.labels.begin[p]); e < index_of(change.labels.begin[p + 1]); ++e)
      now[i] += change.labels.weight[e] * old[change.labels.from[e]];
  }
  return now;
}

/// Where the first or last node of a chain is another than before, and the one of before went into it, it
/// takes over: the outermost of several, beyond all that is known of the chain.
void take_over_end(const std::vector<NodeIndex>& chain, bool first, const Arcs& old,
                   const Resampling<2>& change, Arcs& arc) {
  const NodeIndex end = first ? chain.front() : chain.back();
  if (!std::isnan(arc[end])) return;
  double outermost =
      first ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  const auto beyond = [&](double a) { return first ? a < outermost : a > outermost; };
  const auto p = index_of(end);
  for (auto e = index_of(change.parcels.begin[p]); e < index_of(change.parcels.begin[p + 1]); ++e) {
    const NodeIndex from = change.parcels.from[e];
    if (!exists(change.new_of[from]) && !std::isnan(old[from]) && beyond(old[from])) outermost = old[from];
  }
  if (std::isinf(outermost)) return;
  for (const NodeIndex i : chain)
    if (!std::isnan(arc[i]) && !(first ? outermost < arc[i] : outermost > arc[i])) return;
  arc[end] = outermost;
}

/// Nodes of a chain of segments that have no arc length take it between their neighbours, by distance. What
/// begins or ends without one is left out.
void fill_chain(const std::vector<NodeIndex>& chain, const Cloud<2>& cloud, Arcs& arc) {
  for (std::size_t a = 0; a < chain.size(); ++a) {
    if (std::isnan(arc[chain[a]])) continue;
    std::size_t b = a + 1;
    while (b < chain.size() && std::isnan(arc[chain[b]])) ++b;
    if (b == chain.size()) break;
    const auto length = [&](std::size_t k) {
      return (cloud.position[chain[k]] - cloud.position[chain[k - 1]]).norm();
    };
    double whole = 0.0, part = 0.0;
    for (std::size_t k = a + 1; k <= b; ++k) whole += length(k);
    for (std::size_t k = a + 1; k < b; ++k) {
      part += length(k);
      arc[chain[k]] = arc[chain[a]] + part / whole * (arc[chain[b]] - arc[chain[a]]);
    }
  }
}

std::vector<BondedSegment> follow(const std::vector<BondedSegment>& before, PieceIndex piece,
                                  std::size_t side, const Resampling<2>& change) {
  std::vector<BondedSegment> face = segments_of(change.cloud, piece, side);
  const Arcs old = old_arcs(before, change);
  Arcs arc = known_arcs(old, change);
  for (std::size_t first = 0; first < face.size();) {
    std::size_t last = first + 1;
    while (last < face.size() && face[last].node[0] == face[last - 1].node[1]) ++last;
    std::vector<NodeIndex> chain{face[first].node[0]};
    for (std::size_t i = first; i < last; ++i) chain.push_back(face[i].node[1]);
    for (const bool begin : {true, false}) take_over_end(chain, begin, old, change, arc);
    fill_chain(chain, change.cloud, arc);
    first = last;
  }
  for (BondedSegment& segment : face)
    for (std::size_t k = 0; k < 2; ++k) segment.arc[k] = arc[segment.node[k]];
  std::erase_if(face, [](const BondedSegment& segment) { return !(segment.arc[0] < segment.arc[1]); });
  std::sort(face.begin(), face.end(),
            [](const BondedSegment& a, const BondedSegment& b) { return a.arc[0] < b.arc[0]; });
  return face;
}

/// m, where arc length `at` of a face is.
std::optional<Vec2> place_of(const std::vector<BondedSegment>& face, double at,
                             const IndexedVector<NodeIndex, Vec2>& position) {
  const auto after =
      std::upper_bound(face.begin(), face.end(), at,
                       [](double a, const BondedSegment& segment) { return a < segment.arc[0]; });
  if (after == face.begin()) return std::nullopt;
  const auto& [node, arc] = *std::prev(after);
  const double share = (at - arc[0]) / (arc[1] - arc[0]);
  if (share > 1.0 + 1e-9) return std::nullopt;
  const Vec2 &a = position[node[0]], &b = position[node[1]];
  return (1.0 - share) * a + share * b;
}

} // namespace

std::vector<BondedSegment> segments_of(const Cloud<2>& cloud, PieceIndex piece, std::size_t side) {
  std::vector<BondedSegment> all;
  std::map<NodeIndex, std::size_t> leaving;
  std::set<NodeIndex> entered;
  for (const Facet<2>& facet : cloud.facets) {
    if (facet.piece != piece) continue;
    const auto [a, b] = facet.node;
    const std::array ends = side == 0 ? std::array{a, b} : std::array{b, a};
    leaving[ends[0]] = all.size();
    entered.insert(ends[1]);
    all.push_back({ends, {}});
  }
  std::vector<BondedSegment> face;
  for (const BondedSegment& begin : all) {
    if (entered.contains(begin.node[0])) continue;
    for (auto at = leaving.find(begin.node[0]); at != leaving.end(); at = leaving.find(face.back().node[1]))
      face.push_back(all[at->second]);
  }
  return face;
}

void CohesiveFaces::resample(const Resampling<2>& change) {
  for (CohesiveInterface& interface : interface_) {
    const std::vector<CohesiveElement> element = std::move(interface.element);
    const std::vector<std::array<CohesiveEnd, 2>> state = std::move(interface.state);
    const std::array<std::vector<BondedSegment>, 2> face = interface.face;
    for (std::size_t s = 0; s < 2; ++s)
      interface.face[s] = follow(face[s], interface.spec.piece[s], s, change);
    const auto laid_elsewhere = [&](const CohesiveElement& made, std::size_t end) {
      for (std::size_t s = 0; s < 2; ++s) {
        const std::optional<Vec2> before = place_of(face[s], made.arc[end], change.old_position);
        const auto values = made.values(s, end);
        const Vec2 &a = change.cloud.position[made.side[s].node[0]],
                   &b = change.cloud.position[made.side[s].node[1]];
        if (before && (values[0] * a + values[1] * b - *before).norm() > elsewhere * (b - a).norm())
          return true;
      }
      return false;
    };
    build(interface);
    std::size_t old = 0;
    for (std::size_t e = 0; e < interface.element.size() && !element.empty(); ++e) {
      const auto& [from, to] = interface.element[e].arc;
      const double middle = 0.5 * (from + to);
      while (old + 1 < element.size() && element[old].arc[1] < middle) ++old;
      for (std::size_t end = 0; end < 2; ++end) {
        // an end beyond the old element has the state of the one that holds it
        std::size_t holder = old;
        const double at = interface.element[e].arc[end];
        while (end == 0 && holder > 0 && element[holder].arc[0] > at) --holder;
        while (end == 1 && holder + 1 < element.size() && element[holder].arc[1] < at) ++holder;
        const auto& [first, last] = element[holder].arc;
        double place = std::clamp((at - first) / (last - first), 0.0, 1.0);
        // where an end is broken each speaks for its half, so that nothing heals
        if (place > 0.0 && place < 1.0 && std::max(state[holder][0].damage, state[holder][1].damage) >= 1.0)
          place = middle - first < last - middle ? 0.0 : 1.0;
        interface.state[e][end] = between(state[holder], place);
        if (laid_elsewhere(interface.element[e], end)) interface.state[e][end].damage = 1.0;
      }
    }
  }
}

void CohesiveFaces::archive(Archive& archive) {
  for (CohesiveInterface& interface : interface_) {
    const std::string place = "solver/cohesive/" + interface.spec.name;
    for (std::size_t s = 0; s < 2; ++s) {
      std::vector<NodeIndex> node;
      std::vector<double> arc;
      for (const BondedSegment& segment : interface.face[s])
        for (std::size_t k = 0; k < 2; ++k) {
          node.push_back(segment.node[k]);
          arc.push_back(segment.arc[k]);
        }
      archive.integers(fmt::format("{}/face.{}/node", place, s), node);
      archive.list(fmt::format("{}/face.{}/arc", place, s), "m", arc);
      if (!archive.loading()) continue;
      interface.face[s].assign(node.size() / 2, {});
      for (std::size_t i = 0; i < interface.face[s].size(); ++i)
        interface.face[s][i] = {{node[2 * i], node[2 * i + 1]}, {arc[2 * i], arc[2 * i + 1]}};
    }
    if (archive.loading()) build(interface);
    Field damage, offset, across, along;
    for (const auto& ends : interface.state)
      for (const CohesiveEnd& end : ends) {
        damage.push_back(end.damage);
        offset.push_back(end.offset);
        across.push_back(end.separation.x());
        along.push_back(end.separation.y());
      }
    archive.field(place + "/damage", "1", damage);
    archive.field(place + "/offset", "m", offset);
    archive.field(place + "/separation.0", "m", across);
    archive.field(place + "/separation.1", "m", along);
    for (std::size_t i = 0; i < damage.size(); ++i)
      interface.state[i / 2][i % 2] = {damage[i], {across[i], along[i]}, offset[i]};
  }
}

} // namespace cnem
