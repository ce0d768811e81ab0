#pragma once
// Cuts in space: radial sections round the punch, each measured as a cut in the plane.
#include "core/geometry/plane_section.hpp"
#include "evaluate/blanking.hpp"

#include <optional>
#include <vector>

namespace cnem::evaluate {

/// The axis of a punch. Angles count counter-clockwise from x (from y where the cut runs along x) as seen
/// from where the punch comes from, rad.
struct CutAxis {
  Vec3 centre{0, 0, 0};     ///< m
  Vec3 direction{0, 0, -1}; ///< unit vector of the punch's motion against the die

  char counts_from() const; ///< 'x' or 'y'
  Vec3 outwards(double angle) const;
  /// Its coordinates are the distance from the axis and the height against the cutting direction, m: with
  /// CutTools::direction (0, −1) they are across and along.
  CutPlane plane(double angle) const;
};

/// Tools as they stand: closed surfaces, m.
struct RoundTools {
  TriangleSurface punch;
  std::vector<TriangleSurface> dies;
};

/// The workpiece as it is.
struct RoundSheet {
  TriangleSurface now;                          ///< points: nodes
  TriangleSurface before;                       ///< the same, where it was at the start
  std::vector<PieceIndex> piece;                ///< [triangle] of the boundary
  PieceIndex fracture_piece = PieceIndex::none; ///< that separation makes
  std::vector<PieceIndex> other_pieces; ///< of the boundary that are neither new nor of the sheet's outline
  std::vector<char> on_plane; ///< [triangle] held by a plane of symmetry along the cutting direction
  std::vector<char> broken;   ///< [node]; empty: nowhere
  Field volume;               ///< [node] m³
};

/// A place round the punch where it cuts.
struct RoundGap {
  double angle = 0.0;     ///< rad
  CutTools tools;         ///< in the plane at that angle, the half that begins at the axis
  CutEdges edges;         ///< m from the axis
  double thickness = 0.0; ///< m, of the sheet before, half-way between them
};
/// None where no die stands under sheet beyond the punch.
std::optional<RoundGap> gap_at(const CutAxis& axis, double angle, const RoundTools& tools,
                               const RoundSheet& sheet);

/// A run of angles without an interruption at which a punch cuts.
struct CutArc {
  double from = 0.0, to = 0.0; ///< rad, −2π to 2π; a whole turn apart where it cuts all round
  double length = 0.0;         ///< m, round the punch
};
/// All of them, looked for every two degrees, by angle. Empty: the punch cuts nowhere.
std::vector<CutArc> find_arcs(const CutAxis& axis, const RoundTools& tools, const RoundSheet& sheet);
/// In the middle of equal parts of them all, rad. There is at least one.
std::vector<double> section_angles(const std::vector<CutArc>& arcs, int parts);

/// The faces of slug and skeleton in a section. A body there is what is connected in the section. parallel:
/// rad; smoothing: m.
std::vector<ShearedFace> measure_section(const CutAxis& axis, const RoundGap& gap, const RoundSheet& sheet,
                                         double parallel, double smoothing);

/// The faces of sections at all angles (rad) into a result that has its tools and `parallel`, and with which
/// smoothing (m; none: a fiftieth of the first thickness) they were measured. A note says where there are
/// none.
void measure_round(BlankingResult& result, const CutAxis& axis, const std::vector<double>& angles,
                   const RoundTools& tools, const RoundSheet& sheet, std::optional<double> smoothing);

/// The whole evaluation of a run in space at its end: what the case asks for, without springback.
BlankingResult evaluate_blanking(const input::Case& input, const results::Snapshot<3>& shot,
                                 const Supports<3>& supports, const results::HistoryTable& history);

} // namespace cnem::evaluate
