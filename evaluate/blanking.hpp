#pragma once
// What a cut came to: where punch and die have cut, which bodies lie there, their faces and springback.
#include "evaluate/blanking_result.hpp"
#include "evaluate/springback.hpp"
#include "input/case.hpp"
#include "results/history_writer.hpp"
#include "results/snapshot.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cnem::evaluate {

/// The workpiece as it is, in parts.
struct CutSheet {
  std::vector<Vec2> position; ///< [node] m
  const IndexedVector<CloudFacetIndex, Facet<2>>& facets;
  PieceIndex fracture_piece = PieceIndex::none; ///< that separation makes
  std::vector<std::int32_t> part;               ///< [node] connected part
  const Field& volume;                          ///< [node] share of the volume
  std::vector<char> on_plane;                   ///< [node] on a plane of symmetry along the cutting direction
  std::vector<Vec2> initial_outline;            ///< m, closed polygon of the sheet before
  std::vector<PieceIndex> other_pieces{};       ///< of the boundary that are neither new nor of that outline
  std::vector<Vec2> initial{};                  ///< [node] m, before; empty: bodies have not turned
  std::vector<char> broken{};                   ///< [node] whether the metal is broken; empty: nowhere
};

/// Tools as they stand, m.
struct CutTools {
  Vec2 direction{0, -1};   ///< unit vector of the punch's motion against the die
  std::vector<Vec2> punch; ///< points of its outline
  std::vector<Vec2> die;   ///< points of the outlines of all dies

  /// t across the cutting direction, s along it, m.
  double across(const Vec2& x) const { return x.dot(left_normal(direction)); }
  double along(const Vec2& x) const { return x.dot(direction); }
  Vec2 place(double across_it, double along_it) const {
    return across_it * left_normal(direction) + along_it * direction;
  }
};

/// The gap between a side of the punch and the edge of the die beyond it. t counts across the cutting
/// direction, to the right when the punch goes down.
struct CutEdges {
  double side = 1.0;             ///< +1: the die lies at larger t than the punch
  double punch = 0.0, die = 0.0; ///< m, t

  double middle() const { return 0.5 * (punch + die); }
};

/// One cut: such a gap where there was sheet.
struct Cut : CutEdges {
  std::string name;                      ///< "left" or "right"; empty when there is one
  double thickness = 0.0;                ///< m, of the sheet before, half-way
  std::int32_t slug = -1, skeleton = -1; ///< parts on the two sides: equal until they have come apart
};

/// Points of an outline that has moved by `shift`, m; arcs are divided.
std::vector<Vec2> points_of(const Curve& curve, const Vec2& shift);

/// The gap that a side of the punch leaves to the edge of the die, before it is known whether it passes.
struct Clearance {
  std::string name;       ///< as of a cut
  double gap = 0.0;       ///< m, negative where they overlap
  double thickness = 0.0; ///< m, of the sheet there
  Vec2 at{0, 0};          ///< m, half-way between the edges and in the sheet
  Vec2 across{1, 0};      ///< unit vector, from the punch to the die
};
/// Of both sides of the punch, where a die stands under sheet. outline: m, of the sheet.
std::vector<Clearance> find_clearances(const CutTools& tools, const std::vector<Vec2>& outline);

/// How much of the line at t lies between the outermost crossings of closed polygons (m), m; 0 where there is
/// none.
double thickness_at(const CutTools& tools, std::span<const std::vector<Vec2>> outlines, double t);

/// On a side of the punch; none without a die beyond it.
std::optional<CutEdges> edges_on(const CutTools& tools, double side);

/// The cut there, of a sheet of that thickness (m), with the bodies beside it. Does without the initial
/// outline.
Cut cut_between(const CutTools& tools, const CutSheet& sheet, const CutEdges& edges, double thickness);

/// All cuts where there was sheet.
std::vector<Cut> find_cuts(const CutTools& tools, const CutSheet& sheet);

/// The faces of slug and skeleton at a cut. smoothing: m, 0: a fiftieth of the thickness.
std::vector<ShearedFace> measure_cut(const Cut& cut, const CutTools& tools, const CutSheet& sheet,
                                     double parallel, double smoothing);

/// How far letting go moves and bends slug and skeletons. displacement: [k][node] m.
std::vector<BodySpringback> springback_of_bodies(std::span<const Cut> cuts, const CutTools& tools,
                                                 const CutSheet& sheet, const Fields<2>& displacement,
                                                 const Field& mass);

/// The whole evaluation of a run at its end: what the case asks for. springback: null when it does not.
BlankingResult evaluate_blanking(const input::Case& input, const results::Snapshot<2>& shot,
                                 const Supports<2>& supports, const Springback* springback,
                                 const results::HistoryTable& history);

} // namespace cnem::evaluate
