#pragma once
// Cohesive interfaces of the plane: pairs of faces that separate under tractions of their own.
#include "contact/bonds.hpp"
#include "core/fields/archive.hpp"
#include "core/fields/state.hpp"
#include "core/fields/vector_at.hpp"
#include "core/geometry/cloud.hpp"
#include "core/operators/resampling.hpp"
#include "plasticity/cohesive.hpp"

#include <array>
#include <string>
#include <vector>

namespace cnem {

/// What an interface is made of at the start.
struct CohesiveSpec {
  std::string name;
  plasticity::CohesiveLaw law;
  std::array<PieceIndex, 2> piece{}; ///< of the boundary: the face on the left of the path, and the other
  std::vector<std::array<double, 2>> open{}; ///< m, arc lengths between which it is broken
};

/// A stretch of a face between two nodes, in the order of the arc length.
struct BondedSegment {
  std::array<NodeIndex, 2> node{};
  std::array<double, 2> arc{}; ///< m, along the interface where the nodes were bonded
};

/// The facets of a piece of the boundary chain by chain, side 0 as they run, side 1 against it, as the path
/// of an interface with the body of side 0 on its left runs. Arc lengths are left to be found.
std::vector<BondedSegment> segments_of(const Cloud<2>& cloud, PieceIndex piece, std::size_t side);

/// Where both faces have one segment each: the four-node element of zero thickness of Goodman (1968),
/// integrated at its ends (Newton-Cotes; Schellekens and de Borst 1993), which leaves tractions without
/// oscillations. Elements begin and end where a node of either face was bonded, so that linear tractions do
/// the same work on both faces whether or not their nodes match.
struct CohesiveElement {
  std::array<BondedSegment, 2> side{};
  std::array<double, 2> arc{};

  double weight() const { return 0.5 * (arc[1] - arc[0]); } ///< m, of either end
  /// Of the nodes of a side at an end.
  std::array<double, 2> values(std::size_t of_side, std::size_t end) const {
    const BondedSegment& segment = side[of_side];
    const double at = (arc[end] - segment.arc[0]) / (segment.arc[1] - segment.arc[0]);
    return {1.0 - at, at};
  }
};

/// What an end of an element has undergone.
struct CohesiveEnd {
  double damage = 0.0;
  Vec2 separation = Vec2::Zero(); ///< m, normal and along, at the last look; of what is free, as it broke
  double offset = 0.0;            ///< m, normal distance of the faces at which they are as they were bonded
};

struct CohesiveInterface {
  CohesiveSpec spec;
  double length = 0.0; ///< m
  std::array<std::vector<BondedSegment>, 2> face;
  std::vector<CohesiveElement> element;
  std::vector<std::array<CohesiveEnd, 2>> state; ///< [element][end]
};

/// Energies of cohesive faces, J/m.
struct CohesiveWork {
  double stored = 0.0;     ///< now
  double dissipated = 0.0; ///< by growth of damage since the last look
};

/// The traction potential ψ(δn, δs) of plasticity::CohesiveLaw per bonded length, with δ the difference of
/// the places of two points that were bonded and its axes those of the mean tangent of both faces. Nodal
/// forces are −∂ψ/∂x with the turning of the axes, so that they have neither sum nor moment, whatever the
/// separation. Segments that have turned across each other have no such axes, and are broken.
class CohesiveFaces {
public:
  CohesiveFaces() = default;
  /// left_to_contact: what is broken is free, because contact of bodies holds its faces apart; else
  /// compression is borne by K for good. Faces of the cloud have the same nodes.
  CohesiveFaces(std::vector<CohesiveSpec> specs, const Cloud<2>& cloud, bool left_to_contact);

  bool empty() const { return interface_.empty(); }
  const std::vector<CohesiveInterface>& interfaces() const { return interface_; }

  /// Forces on nodes, N/m, written to force() of as many as there are positions. Damage grows with the
  /// separations.
  CohesiveWork evaluate(const Fields<2>& position);
  const Fields<2>& force() const { return force_; }
  /// Whether the last look broke anything.
  bool has_broken() const { return has_broken_; }
  /// Rows of the stiffness of what is bonded, undamaged, [node] Pa.
  Field stiffness_rows(const Fields<2>& position) const;
  /// A bound on the squares of the frequencies that the faces add to those of the body, 1/s²: the largest row
  /// of M⁻¹ K (Gershgorin). mass: [node] kg/m.
  double frequency_bound(const Fields<2>& position, const Field& mass) const;

  /// Sets faces apart that are nearer than a 100,000th of an element, where they were bonded or, slid, touch
  /// now, so that a new reference finds no matter of one in the other; offsets follow, and so no traction
  /// changes. Faces that coincide stay. Returns the interface whose faces still lie in each other after as
  /// many passes as are made; null: none. The boundary of the cloud says where bodies lie in each other.
  const CohesiveInterface* part(const Cloud<2>& cloud, Fields<2>& position);

  /// Follows a changed cloud: nodes that stay keep their arc length, new ones take it from their neighbours
  /// on the face, damage and offsets are interpolated along the arc. Where the face was laid elsewhere, by
  /// more than half a facet, as where a fold of it went, it is broken.
  void resample(const Resampling<2>& change);

  contact::Bonds bonds(const Cloud<2>& cloud) const;
  /// m, broken length of an interface.
  static double broken_length(const CohesiveInterface& interface);

  void archive(Archive& archive);

private:
  void build(CohesiveInterface& interface) const;
  bool free(const CohesiveEnd& end) const { return left_to_contact_ && end.damage >= 1.0; }

  std::vector<CohesiveInterface> interface_;
  bool left_to_contact_ = false;
  bool has_broken_ = false;
  Fields<2> force_;
};

} // namespace cnem
