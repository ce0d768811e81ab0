#pragma once
// From curves and cracks to boundary nodes and directed facets; shared by generated clouds and node lists.
#include "clouds/generate.hpp"

namespace cnem::clouds {

/// Consecutive vertices along one named piece of boundary.
struct Chain {
  std::vector<std::int32_t> vertex;
  PieceIndex piece{};                 ///< of the edges that run along the chain (domain on their left)
  PieceIndex back = PieceIndex::none; ///< cracks: of the edges that run back along it; none where none do
};

struct BoundaryChains {
  std::vector<Vec2> vertex; ///< m; each point once, crack or not
  std::vector<Chain> chains;
  IndexedVector<PieceIndex, std::string> piece_names;

  /// The piece of a name, added when it is new.
  PieceIndex piece(const std::string& name);
};

/// Where a crack meets the outline or a hole.
struct Mouth {
  std::size_t curve = 0; ///< 0: outline, k: hole k − 1
  std::size_t piece = 0;
  double s = 0.0; ///< fraction of the piece's length
  std::size_t crack = 0;
  bool at_end = false; ///< the last point of the path, not the first
};

/// The domain with its outline counter-clockwise and its holes clockwise.
/// Throws GeometryError for curves that are open, empty, not finite or enclose no area.
DomainShape checked_and_oriented(const DomainShape& domain);

/// Diagonal of the bounding box of the outline's pieces, m: what tolerances are relative to.
double domain_size(const DomainShape& domain);

/// Fraction of a piece's length at its point nearest to x.
double nearest_fraction(const CurvePiece& piece, const Vec2& x);

/// Ends of cracks within `tolerance` of a curve. Expects an oriented domain.
std::vector<Mouth> find_mouths(const DomainShape& domain, double tolerance);

/// Nodes along every curve and crack by the rule of generate_cloud. Expects an oriented domain.
BoundaryChains discretise_boundary(const DomainShape& domain, const SpacingField& spacing);

/// The closed loops that the chains make: vertices become nodes of the same number, points with several
/// wedges of material get further copies, declared as twins.
Cloud<2> assemble_boundary(const BoundaryChains& chains);

/// Throws GeometryError when a hole starts outside the outline. Expects an oriented domain.
void check_holes(const DomainShape& domain);

/// Throws GeometryError unless every crack lies inside the domain and keeps at least a quarter of a spacing
/// away from the boundary (except at its mouths), from other cracks and from itself.
/// `outline`: the loops without cracks.
void check_cracks(const DomainShape& domain, const SpacingField& spacing, const Cloud<2>& outline);

} // namespace cnem::clouds
