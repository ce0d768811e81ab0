// How faces of cohesive interfaces that overlap are set apart before a cloud is made of them.
#include "mechanics/cohesive_faces.hpp"
#include "mechanics/placed_element.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace cnem {
namespace {

constexpr double apart = 1e-5;   ///< of an element or a segment: what is left between faces
constexpr double deepest = 0.5;  ///< of a segment: what is deeper in the other face is not beside it
constexpr double facing = -0.25; ///< cosine between normals below which two faces face each other
constexpr int most_passes = 8;   ///< setting one pair apart may push another together

using Shifts = IndexedVector<NodeIndex, Vec2>;

/// Of several wishes for a node the largest holds.
void wish(Vec2& own, const Vec2& wanted) {
  if (wanted.squaredNorm() > own.squaredNorm()) own = wanted;
}

/// One face of an interface at the places of its nodes, to ask how deep points lie in its matter.
class PlacedFace {
public:
  PlacedFace(const std::vector<BondedSegment>& face, std::size_t side, const Fields<2>& position)
      : face_(face) {
    for (const BondedSegment& segment : face) {
      const Vec2 a = vector_at<2>(position, index_of(segment.node[0])),
                 edge = vector_at<2>(position, index_of(segment.node[1])) - a;
      from_.push_back(a);
      edge_.push_back(edge);
      outward_.push_back((side == 0 ? -1.0 : 1.0) * left_normal(edge).normalized());
    }
  }

  std::size_t size() const { return face_.size(); }
  const BondedSegment& segment(std::size_t i) const { return face_[i]; }
  bool joined(std::size_t i) const { ///< to the one before
    return i > 0 && i < size() && face_[i].node[0] == face_[i - 1].node[1];
  }
  double length(std::size_t i) const { return edge_[i].norm(); }
  /// Outward, of the first node of a segment, or of the last one of the segment before.
  Vec2 normal_at(std::size_t i) const {
    if (joined(i)) return (outward_[i] + outward_[i - 1]).normalized();
    return i < size() ? outward_[i] : outward_.back();
  }
  const Vec2& place(std::size_t i) const { return from_[i]; }

  struct Foot {
    std::size_t segment;
    Vec2 normal; ///< outward
    double gap;  ///< m, negative within the matter
  };
  /// Where the face is nearest; nothing where that is an end of it, or the point itself.
  std::optional<Foot> nearest(const Vec2& x) const {
    double least = std::numeric_limits<double>::infinity();
    std::size_t at = 0;
    double place = 0.0;
    for (std::size_t i = 0; i < size(); ++i) {
      const double there = std::clamp(edge_[i].dot(x - from_[i]) / edge_[i].squaredNorm(), 0.0, 1.0);
      const double distance = (x - from_[i] - there * edge_[i]).squaredNorm();
      if (distance < least) least = distance, at = i, place = there;
    }
    if (least == 0.0 || !std::isfinite(least)) return std::nullopt;
    const Vec2 away = x - from_[at] - place * edge_[at];
    if (place > 0.0 && place < 1.0) return Foot{at, outward_[at], outward_[at].dot(away)};
    const std::size_t node = place == 0.0 ? at : at + 1;
    if (!joined(node)) return std::nullopt;
    const Vec2 normal = normal_at(node);
    return Foot{at, normal, std::copysign(away.norm(), normal.dot(away))};
  }

private:
  const std::vector<BondedSegment>& face_;
  std::vector<Vec2> from_, edge_, outward_;
};

/// Of pairs that were bonded and are not in contact's hands.
bool part_bonded(const CohesiveInterface& interface, const Fields<2>& position, const auto& free,
                 Shifts& shift) {
  bool any = false;
  for (std::size_t e = 0; e < interface.element.size(); ++e) {
    const CohesiveElement& element = interface.element[e];
    const PlacedElement now(element, position);
    for (std::size_t end = 0; end < 2; ++end) {
      if (free(interface.state[e][end])) continue;
      const Vec2 jump = now.jump(element, end);
      const double wide = apart * 2.0 * element.weight(), missing = wide - now.normal.dot(jump);
      if (missing <= 0.5 * wide || jump.isZero(0.0)) continue; // by less not at each reference
      any = true;
      for (std::size_t s = 0; s < 2; ++s) {
        const auto values = element.values(s, end);
        for (std::size_t a = 0; a < 2; ++a)
          if (values[a] > 0.0)
            wish(shift[element.side[s].node[a]], (s == 0 ? 0.5 : -0.5) * missing * now.normal);
      }
    }
  }
  return any;
}

/// Of what lies on each other now: faces that slide and bend overlap elsewhere than where they were bonded.
bool part_touching(const CohesiveInterface& interface, const Fields<2>& position, Shifts& shift) {
  bool any = false;
  const std::array face{PlacedFace(interface.face[0], 0, position),
                        PlacedFace(interface.face[1], 1, position)};
  for (std::size_t s = 0; s < 2; ++s) {
    const PlacedFace &own = face[s], &other = face[1 - s];
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto foot = other.nearest(own.place(i));
      if (!foot || foot->normal.dot(own.normal_at(i)) > facing) continue;
      const double length = other.length(foot->segment), wide = apart * length, missing = wide - foot->gap;
      if (missing <= 0.5 * wide || missing > deepest * length) continue;
      any = true;
      wish(shift[own.segment(i).node[0]], 0.5 * missing * foot->normal);
      for (const NodeIndex node : other.segment(foot->segment).node)
        wish(shift[node], -0.5 * missing * foot->normal);
    }
  }
  return any;
}

} // namespace

void CohesiveFaces::part(Fields<2>& position) {
  const Fields<2> before = position;
  const auto left_free = [&](const CohesiveEnd& end) { return free(end); };
  bool any = false;
  for (int pass = 0; pass < most_passes; ++pass) {
    Shifts shift(position[0].size(), Vec2::Zero());
    bool now = false;
    for (const CohesiveInterface& interface : interface_)
      now |= pass == 0 ? part_bonded(interface, position, left_free, shift)
                       : part_touching(interface, position, shift);
    if (pass > 0 && !now) break;
    any |= now;
    for (const NodeIndex i : shift.indices())
      for (std::size_t k = 0; k < 2; ++k) position[k][index_of(i)] += shift[i][static_cast<Eigen::Index>(k)];
  }
  if (!any) return;
  for (CohesiveInterface& interface : interface_)
    for (std::size_t e = 0; e < interface.element.size(); ++e) {
      const CohesiveElement& element = interface.element[e];
      const PlacedElement was(element, before), is(element, position);
      for (std::size_t end = 0; end < 2; ++end)
        interface.state[e][end].offset +=
            is.normal.dot(is.jump(element, end)) - was.normal.dot(was.jump(element, end));
    }
}

} // namespace cnem
