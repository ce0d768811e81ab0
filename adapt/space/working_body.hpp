#pragma once
// A cloud in space while it is being resampled: nodes come and go, and mass goes with them in parcels.
#include "adapt/matter.hpp"
#include "adapt/space/structure.hpp"
#include "core/geometry/cloud.hpp"

#include <array>

namespace cnem::adapt {

class WorkingBody : public Matter {
public:
  WorkingBody(Cloud<3> cloud, NodeProperties properties)
      : Matter(std::move(properties)), cloud_(std::move(cloud)) {
    cloud_.simplices.clear();
    cloud_.across.clear();
  }

  const Cloud<3>& cloud() const { return cloud_; }
  std::size_t size() const { return cloud_.position.size(); }
  IndexRange<NodeIndex> nodes() const { return cloud_.position.indices(); }
  const Vec3& at(NodeIndex i) const { return cloud_.position[i]; }
  double spacing(NodeIndex i) const { return node().size[index_of(i)]; } ///< m, wanted

  /// A node without matter between two others.
  NodeIndex insert_between(NodeIndex a, NodeIndex b, const Vec3& x) {
    append({{a, 0.5}, {b, 0.5}});
    add(x, a);
    return as<NodeIndex>(size() - 1);
  }
  /// A node without matter at the place of another, and held if that is.
  NodeIndex double_node(NodeIndex i) {
    append({{i, 1.0}});
    add(Vec3(at(i)), i);
    const NodeIndex made = as<NodeIndex>(size() - 1);
    hold(made, held(i));
    return made;
  }
  /// A node without matter that lies to `there`, and of its body, as i lies to `here`.
  NodeIndex insert_image(NodeIndex i, NodeIndex here, NodeIndex there) {
    append({{i, 1.0}, {here, -1.0}, {there, 1.0}});
    add(at(i) + (at(there) - at(here)), there);
    return as<NodeIndex>(size() - 1);
  }
  void place(NodeIndex i, const Vec3& x) {
    cloud_.position[i] = x;
    sound_ = false;
  }
  void set_boundary(IndexedVector<CloudFacetIndex, Facet<3>> facets) {
    cloud_.facets = std::move(facets);
    sound_ = false;
  }
  /// Whether facets are known not to cross each other; until one of them changes or moves.
  bool sound() const { return sound_; }
  void set_sound() { sound_ = true; }

  /// New numbers of all nodes; those that have none go, which have no matter left, and no facet.
  void renumber(const IndexedVector<NodeIndex, NodeIndex>& number);

  /// Everything since construction. The tetrahedra of the structure go with the cloud where they are those
  /// that triangulating it gives: not where some were flipped while bodies that are apart now were one.
  Resampling<3> finish(const SpaceStructure& structure) const;

private:
  void add(const Vec3& x, NodeIndex like) {
    cloud_.position.push_back(x);
    if (!cloud_.body.empty()) cloud_.body.push_back(std::int32_t{cloud_.body[like]});
  }

  Cloud<3> cloud_;
  bool sound_ = false;
};

} // namespace cnem::adapt
