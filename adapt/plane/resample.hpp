#pragma once
// The resampling pass: nodes that crowd go, gaps are filled, the boundary keeps its resolution, and mass and
// volume are brought together again (docs/theory.md, "Resampling").
#include "adapt/balance.hpp"
#include "adapt/pass_report.hpp"
#include "adapt/plane/working_cloud.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace cnem::adapt {

/// Lengths are in units of the wanted spacing h at the place.
struct Thresholds {
  double boundary_gap = 0.3; ///< an interior node nearer to a boundary edge goes, or becomes part of it
  double pair = 0.4;         ///< of two nodes nearer to each other one goes
  double short_edge = 0.4;   ///< a boundary node at a shorter edge goes, when
  double flat_area = 0.12;   ///< the triangle it spans with its neighbours is smaller (in h²)
  double dense = 0.62;       ///< nodes whose neighbours are nearer than this on average go
  double straight = 0.02; ///< on the boundary only where the triangle with its neighbours is smaller (in h²)
  double spike = 25.0;    ///< degrees: boundary nodes with a sharper angle go
  double notch = 60.0;    ///< degrees: the bottoms of sharper notches go that are
  double shallow = 0.6;   ///< not deeper
  double sliver = 0.05;   ///< (in h²) the least cell at the boundary
  double gives_way = 0.05;  ///< as far what touches the boundary moves where it is straightened
  double split_edge = 1.5;  ///< longer boundary edges are split
  double film_edge = 2.0;   ///< still longer ones also where the other face of a film is near
  double long_edge = 1.6;   ///< longer Delaunay edges get a node
  double clear_node = 0.55; ///< least distance of a new node from others
  double clear_edge = 0.5;  ///< and from the boundary, unless it is on it
  double light = 0.8;       ///< ρ₀V/(mJ) below which a node gives mass away
  double heavy = 1.25;      ///< and above which it takes some
  int rounds = 4;           ///< of removal, and of insertion

  BalanceLimits balance() const { return {light, heavy, rounds}; }
};

/// Where new nodes are put (paper 004, Figure 18).
enum class Placement { between_nodes, voronoi_vertices };

/// Spacings between nodes of debris beyond which nothing holds them together: facets come to cross.
inline constexpr double debris_flown = 4.0;

/// How the cloud parts where broken matter goes through it. Lengths are in units of the wanted spacing.
struct SplitRules {
  PieceIndex piece = PieceIndex::none; ///< that new faces belong to
  double gap = 1e-3;                   ///< how far the two faces are set apart, so that no nodes coincide
  double part = 2.0;          ///< least length of boundary of a part that comes off, over that of the cut
  double least_angle = 30.0;  ///< degrees between a cut and the boundary at its ends
  int least_loop = 8;         ///< least boundary nodes of a part, besides those of the cut
  double smoothed = 0.3;      ///< how far nodes may be moved to straighten a cut
  double film = 0.15;         ///< broken matter thinner than this between two faces is cut at its waist
  double thinnest_film = 0.0; ///< m, thinner ones are cut though they are whole
  double nothing = 0.02; ///< thinner than this faces are about to cross: crumbs may come off, and join others
  bool cracks = false;   ///< also open what is broken from the boundary to a tip inside
  double first = 4.0;    ///< least length of a crack
  double advance = 2.0;  ///< and by how much it grows
  double slender = 2.0;  ///< least length of a crack over the mean width of what is broken
  double from_lip = 4.0; ///< what a cut costs that begins or ends on such a face, and not at a tip
  double apart = 5.0;    ///< least distance of its mouth from faces that are there
};

struct ResampleRules {
  Space space = Space::plane; ///< that of the structure
  Thresholds thresholds{};
  Placement placement = Placement::between_nodes;
  SplitRules split{}; ///< where NodeProperties::broken is given
};

/// Resamples a cloud. structure: that of the cloud; empty when it has none (structure_if_valid): the boundary
/// is then mended first. Conserves Σ of every quantity carried in parcels to rounding; a node that nothing
/// happened to keeps its bits. The result depends on the arguments alone.
/// Throws GeometryError when no valid structure is found (crossing boundaries).
Resampling<2> resample(const Cloud<2>& cloud, std::optional<Structure> structure, NodeProperties properties,
                       const ResampleRules& rules, PassReport& report);

/// Exchange of mass alone, where r_i is outside [light, heavy]: the nodes stay, some as other matter.
/// structure: that of the cloud. Empty when there is nothing to do.
std::optional<Resampling<2>> balanced(const Cloud<2>& cloud, const Structure& structure,
                                      NodeProperties properties, const Thresholds& thresholds,
                                      PassReport& report);

// The parts of a pass, each a class of its own in what it looks at. They keep `structure` up to date.

/// Before anything is triangulated: boundary nodes at which the boundary turns back on itself, and short
/// loops of it, are bypassed; their mass goes to the nearer neighbour.
void mend_boundary(WorkingCloud& work, PassReport& report);
/// Interior nodes outside the boundary give their mass to the ends of the nearest edge of their own part.
void drop_outside(WorkingCloud& work, PassReport& report);
/// The same of interior nodes that have come into another part, through faces that are mates.
void drop_strayed(WorkingCloud& work, Structure& structure, PassReport& report);
/// Opens the cloud along paths of Delaunay edges between broken nodes that join two parts of the boundary,
/// through the most broken matter. Nodes are doubled, nothing is deleted; the matter of a doubled node is
/// shared out by the volumes of its two cells. Matter that is broken but does not part the body stays whole.
void split(WorkingCloud& work, Structure& structure, const SplitRules& rules, PassReport& report);
/// Opens the cloud from the boundary to a tip inside where a connected set of broken nodes is longer than
/// wide, along its most strained path, and lets tips go on with what breaks ahead of them (SplitRules::first,
/// advance, slender, apart). Nodes but the tip are doubled, matter is shared out as by split().
void open_cracks(WorkingCloud& work, Structure& structure, const SplitRules& rules, PassReport& report);
/// Cuts films, between two parts of the boundary that no interior node keeps apart, at their waists: those of
/// broken matter, and those thinner than SplitRules::thinnest_film. Matter is shared out as by split().
void cut_films(WorkingCloud& work, Structure& structure, const SplitRules& rules, PassReport& report);
/// Crumbs, bodies of at most SplitRules::least_loop nodes, none of them inside, and thinner than
/// SplitRules::thinnest_film or a fiftieth of the spacing, or of twice as many, inside too, that are debris
/// and have flown apart, go to the nearest node of the boundary of the same part, however far it is, corners
/// or not: cells of theirs, pressed between tools and bodies, mean nothing. What has none, or the last facets
/// of a piece, stays. Nothing is deleted.
void join_crumbs(WorkingCloud& work, Structure& structure, const SplitRules& rules, PassReport& report);
/// Facets shorter than a twentieth of the spacing between two nodes that stay, corners and ends of pieces, go
/// with the one of them that bends the boundary less, but for the last facet of a piece: nothing else takes
/// them away, and the step, or the inertia that scaling adds, goes with them.
void join_ends(WorkingCloud& work, Structure& structure, PassReport& report);
/// One round; false when there was nothing to do, or it was undone because the cloud would have had no valid
/// structure.
bool thin(WorkingCloud& work, Structure& structure, const Thresholds& thresholds, PassReport& report);
bool fill(WorkingCloud& work, Structure& structure, const Thresholds& thresholds, Placement placement,
          PassReport& report);

/// Parcels for nodes that were `made` without matter: what the cells beside them lost in volume since
/// `before` goes to the new cells at them.
std::vector<Parcel> stolen(const Cloud<2>& cloud, const Structure& before, const Structure& after,
                           const IndexedVector<NodeIndex, char>& made);

} // namespace cnem::adapt
