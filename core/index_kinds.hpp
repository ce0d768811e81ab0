#pragma once
// The kinds of indices, each a type of its own: a facet cannot stand where a node is meant. No function is
// here, so that kernels may include it (cmake/cnem.cmake, cnem_kernel).
#include <cstdint>

namespace cnem {

enum class NodeIndex : std::int32_t { none = -1 };         ///< node of a cloud, and the cell around it
enum class PointIndex : std::int32_t { none = -1 };        ///< stress point: row of an operator
enum class SimplexIndex : std::int32_t { none = -1 };      ///< triangle or tetrahedron
enum class EdgeIndex : std::int32_t { none = -1 };         ///< edge of tetrahedra
enum class DualPointIndex : std::int32_t { none = -1 };    ///< dual point of a tetrahedron or of a facet
enum class FaceIndex : std::int32_t { none = -1 };         ///< inner face of a complex of cells
enum class PartIndex : std::int32_t { none = -1 };         ///< part of its boundary
enum class CloudFacetIndex : std::int32_t { none = -1 };   ///< facet of the boundary of a cloud
enum class PieceIndex : std::int32_t { none = -1 };        ///< named piece of the boundary of a cloud
enum class FacetIndex : std::int32_t { none = -1 };        ///< facet of the surface that contact sees
enum class SurfaceEdgeIndex : std::int32_t { none = -1 };  ///< edge between two of its facets in space
enum class BoundaryNodeIndex : std::int32_t { none = -1 }; ///< in contact's list of the nodes on the boundary
enum class ToolIndex : std::int32_t { none = -1 };         ///< rigid tool

} // namespace cnem
