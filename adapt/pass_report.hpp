#pragma once
// What a resampling pass tells of itself.

namespace cnem::adapt {

/// What a pass did, for the audit and the output.
struct PassReport {
  int cracks = 0;   ///< opened from the boundary to a tip inside
  int advances = 0; ///< times that a tip went on
  int cuts = 0;     ///< paths, in space surfaces, through broken matter that were opened
  int opened = 0;   ///< edges, in space facets, of these
  int films = 0;    ///< cuts among them at the waists of films
  int crumbs = 0;   ///< thin bodies of a few nodes that joined others
  int folded = 0;   ///< boundary nodes at which the boundary turned back on itself or crossed
  int outside = 0;  ///< interior nodes found outside the boundary, or in another part
  int removed = 0, removed_boundary = 0;
  int promoted = 0; ///< interior nodes that became part of the boundary
  int inserted = 0, inserted_boundary = 0;
  int flipped = 0;          ///< edges of a surface in space that became the other diagonal
  int recut = 0;            ///< tetrahedra below the skin that went over from one periodic side to the other
  int balanced = 0;         ///< exchanges of mass between neighbours
  int undone = 0;           ///< rounds given up because the cloud had no valid structure after them
  int crossings = 0;        ///< pairs of facets in space that crossed when the pass began
  int side_crossings = 0;   ///< those of them in which a side of a period has taken part
  double volume_change = 0; ///< of the domain: m³ per metre of thickness, or of the body
  bool changed() const {
    return opened + crumbs + folded + outside + removed + removed_boundary + promoted + inserted +
               inserted_boundary + flipped + recut + balanced >
           0;
  }
  PassReport& operator+=(const PassReport& other);
};

} // namespace cnem::adapt
