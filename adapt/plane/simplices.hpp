#pragma once
// The triangles of a cloud that nodes leave and join: some that fill it again, from which it is triangulated.
#include "adapt/plane/structure.hpp"
#include "adapt/plane/working_cloud.hpp"

namespace cnem::adapt {

/// Begins with the triangles of a structure. No two changes may concern the same one; which changes go on
/// well is found when the cloud is triangulated.
class Simplices {
public:
  using Corners = std::array<NodeIndex, 3>;

  explicit Simplices(const Structure& structure)
      : mesh_(structure.mesh), gone_(structure.mesh.node.size(), 0) {}

  /// A node goes: what is left of its surroundings is filled by triangles between its neighbours, with
  /// cloud()'s places. Of a boundary node the boundary goes straight from the one before to the one after.
  void remove(const WorkingCloud& work, NodeIndex node);
  /// An inner node becomes part of the facet opposite to it in the triangle beside the facet that leaves a.
  void promote(NodeIndex a) { gone_[mesh_.triangle_of_node[a]] = 1; }
  /// A node on the side of one triangle, and of the one across if there is one, that is opposite to neither.
  void divide(const std::array<NodeIndex, 2>& side, const std::array<SimplexIndex, 2>& triangle,
              NodeIndex made);
  /// A node inside of a triangle.
  void divide(SimplexIndex triangle, NodeIndex made);

  /// All that there are now are what triangulating the cloud begins with.
  void hand_to(WorkingCloud& work) const;
  /// With new numbers for nodes.
  void hand_to(WorkingCloud& work, const IndexedVector<NodeIndex, NodeIndex>& number) const;

private:
  IndexedVector<SimplexIndex, Corners> list() const;
  IndexedVector<SimplexIndex, std::array<SimplexIndex, 3>> across() const;

  const voronoi::Triangulation& mesh_;
  IndexedVector<SimplexIndex, char> gone_;
  std::vector<Corners> made_;
};

} // namespace cnem::adapt
