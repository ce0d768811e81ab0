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

constexpr double apart = 1e-5;    ///< of a segment: what is left between faces
constexpr double deepest = 0.5;   ///< of a segment: what is deeper in the other face is not beside it
constexpr double overhang = 0.25; ///< of a segment: so far beyond its last node a face is still asked
constexpr double facing = -0.25;  ///< cosine between normals below which two faces face each other
constexpr int most_passes = 8;    ///< setting one pair apart may push another together

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
  const Vec2& place(std::size_t i) const { return from_[i]; } ///< m, of the first node of a segment
  Vec2 end(std::size_t i) const { return from_[i] + edge_[i]; }
  const Vec2& outward(std::size_t i) const { return outward_[i]; }

  struct Foot {
    std::size_t segment;
    Vec2 normal; ///< outward
    double gap;  ///< m, negative within the matter
  };
  /// Where the face is nearest; nothing where that is far beside an end of it, or the point itself.
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
    if (joined(node)) {
      const Vec2 normal = normal_at(node);
      return Foot{at, normal, std::copysign(away.norm(), normal.dot(away))};
    }
    const double gap = outward_[at].dot(away), beyond = (away - gap * outward_[at]).norm();
    return beyond < overhang * length(at) ? std::optional(Foot{at, outward_[at], gap}) : std::nullopt;
  }

private:
  const std::vector<BondedSegment>& face_;
  std::vector<Vec2> from_, edge_, outward_;
};

/// Where faces lie in each other now, which is elsewhere than where they were bonded when they slide and
/// bend.
bool part_touching(const CohesiveInterface& interface, const Fields<2>& position, Shifts& shift) {
  bool any = false;
  const std::array face{PlacedFace(interface.face[0], 0, position),
                        PlacedFace(interface.face[1], 1, position)};
  for (std::size_t s = 0; s < 2; ++s) {
    const PlacedFace &own = face[s], &other = face[1 - s];
    const auto ask = [&](NodeIndex node, const Vec2& x, const Vec2& normal) {
      const auto foot = other.nearest(x);
      if (!foot || foot->normal.dot(normal) > facing) return;
      const double length = other.length(foot->segment), wide = apart * length, missing = wide - foot->gap;
      if (missing <= 0.5 * wide || missing > deepest * length) return; // by less not at each reference
      any = true;
      wish(shift[node], 0.5 * missing * foot->normal);
      for (const NodeIndex end : other.segment(foot->segment).node)
        wish(shift[end], -0.5 * missing * foot->normal);
    };
    for (std::size_t i = 0; i < own.size(); ++i) {
      ask(own.segment(i).node[0], own.place(i), own.normal_at(i));
      if (!own.joined(i + 1)) ask(own.segment(i).node[1], own.end(i), own.outward(i));
    }
  }
  return any;
}

} // namespace

void CohesiveFaces::part(Fields<2>& position) {
  const Fields<2> before = position;
  bool any = false;
  for (int pass = 0; pass < most_passes; ++pass) {
    Shifts shift(position[0].size(), Vec2::Zero());
    bool now = false;
    for (const CohesiveInterface& interface : interface_) now |= part_touching(interface, position, shift);
    if (!now) break;
    any = true;
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
