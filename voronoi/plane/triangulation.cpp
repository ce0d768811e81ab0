#include "voronoi/plane/triangulation.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "voronoi/plane/boundary_checks.hpp"
#include "voronoi/plane/retriangulation.hpp"
#include "voronoi/plane/simplex_order.hpp"
#include "voronoi/twins.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace cnem::voronoi {

namespace {

enum class Side : std::int8_t { unknown, outside, inside };

struct FaceInfo {
  static constexpr CloudFacetIndex no_facet = CloudFacetIndex::none;
  std::array<CloudFacetIndex, 3> facet{no_facet, no_facet,
                                       no_facet}; ///< the facet that has this face on its left
  SimplexIndex triangle = SimplexIndex::none;
  Side side = Side::unknown;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<NodeIndex, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Unconstrained = CGAL::Delaunay_triangulation_2<Kernel, Structure>;
using ConstrainedDelaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Vertex = ConstrainedDelaunay::Vertex_handle;
using Face = ConstrainedDelaunay::Face_handle;

/// What is triangulated for itself.
struct Body {
  std::vector<NodeIndex> node;
  std::vector<CloudFacetIndex> facet;
};

/// In the order of their first nodes.
std::vector<Body> bodies_of(const Cloud<2>& cloud) {
  std::vector<Body> bodies;
  std::map<std::int32_t, std::size_t> number;
  const auto body_of = [&](NodeIndex i) -> Body& {
    const auto [found, is_new] = number.try_emplace(cloud.body.empty() ? 0 : cloud.body[i], bodies.size());
    if (is_new) bodies.emplace_back();
    return bodies[found->second];
  };
  for (const NodeIndex i : cloud.position.indices()) body_of(i).node.push_back(i);
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    const auto [a, b] = cloud.facets[f].node;
    if (!cloud.one_body(a, b))
      throw GeometryError(fmt::format("{} leads from one body to another", describe_facet(cloud, f)));
    body_of(a).facet.push_back(f);
  }
  for (const Body& body : bodies)
    if (body.facet.empty())
      throw GeometryError(
          fmt::format("the body with {} has no boundary", describe_node(cloud, body.node[0])));
  return bodies;
}

/// The work of one call of triangulate().
class Builder {
public:
  explicit Builder(const Cloud<2>& cloud)
      : cloud_(cloud), leaving_(outgoing_facets(cloud)), group_(twin_groups(cloud)) {
    vertex_.resize(cloud.position.size());
    is_merged_.assign(cloud.position.size(), false);
    left_of_.resize(cloud.facets.size());
  }

  Triangulation build() {
    for (Body& body : bodies_of(cloud_)) {
      body_ = std::move(body);
      merged_ = false;
      insert_nodes();
      insert_facets();
      mark_sides();
      number_triangles();
      if (merged_) separate_merged_nodes();
    }
    number_by_nodes(result_, cloud_.position.size());
    check_nodes();
    return std::move(result_);
  }

private:
  const Vec2& at(NodeIndex node) const { return cloud_.position[node]; }
  bool on_boundary(NodeIndex node) const { return exists(leaving_[node]); }

  /// Nodes at the same position share one CGAL vertex, which is allowed to declared twins only. The nodes go
  /// into an unconstrained triangulation, whose flips are cheaper; the constrained one takes over its
  /// structure.
  void insert_nodes() {
    Unconstrained nodes;
    Face hint;
    for (const NodeIndex i : body_.node) {
      const std::size_t before = nodes.number_of_vertices();
      const Vertex v = nodes.insert({at(i).x(), at(i).y()}, hint);
      hint = v->face();
      vertex_[i] = v;
      if (nodes.number_of_vertices() > before) {
        v->info() = i;
        continue;
      }
      const NodeIndex first = v->info();
      if (group_.empty() || group_[first] != group_[i])
        throw GeometryError(fmt::format("{} coincides with node {}: expected distinct positions, or a "
                                        "declared pair of twins on the two faces of a crack",
                                        describe_node(cloud_, i), index_of(first)));
      is_merged_[first] = is_merged_[i] = merged_ = true;
    }
    if (nodes.dimension() < 2)
      throw GeometryError(fmt::format("empty domain: the {} nodes lie on one line", body_.node.size()));
    const Vertex infinite = nodes.infinite_vertex();
    delaunay_.tds().swap(nodes.tds());
    delaunay_.set_infinite_vertex(infinite);
  }

  void insert_facets() {
    try {
      for (const CloudFacetIndex facet : body_.facet)
        delaunay_.insert_constraint(vertex_[cloud_.facets[facet].node[0]],
                                    vertex_[cloud_.facets[facet].node[1]]);
    } catch (const ConstrainedDelaunay::Intersection_of_constraints_exception&) { throw_crossing(cloud_); }
    for (const CloudFacetIndex facet : body_.facet) {
      const Vertex a = vertex_[cloud_.facets[facet].node[0]], b = vertex_[cloud_.facets[facet].node[1]];
      Face face;
      int k = 0;
      if (!delaunay_.is_edge(a, b, face, k)) throw_node_on_facet(cloud_, facet);
      if (face->vertex(ConstrainedDelaunay::ccw(k)) != a) {
        const Face other = face->neighbor(k);
        k = delaunay_.mirror_index(face, k);
        face = other;
      }
      auto& slot = face->info().facet[index_of(k)];
      if (exists(slot))
        throw GeometryError(fmt::format("{} runs along facet {} in the same direction, expected opposite "
                                        "faces of a crack or no overlap",
                                        describe_facet(cloud_, facet), index_of(slot)));
      slot = facet;
      left_of_[facet] = {face, k};
    }
  }

  /// Marks all faces that are reached from `start` without crossing a facet. Returns false when that meets
  /// the other side.
  bool flood(Face start, Side side) {
    if (start->info().side == side) return true;
    if (start->info().side != Side::unknown) return false;
    start->info().side = side;
    stack_.assign(1, start);
    while (!stack_.empty()) {
      const Face face = stack_.back();
      stack_.pop_back();
      for (int k = 0; k < 3; ++k) {
        if (face->is_constrained(k)) continue;
        const Face next = face->neighbor(k);
        if (next->info().side != Side::unknown) continue;
        next->info().side = side;
        stack_.push_back(next);
      }
    }
    return true;
  }

  void mark_sides() {
    flood(delaunay_.infinite_face(), Side::outside);
    for (const CloudFacetIndex f : body_.facet)
      if (!flood(left_of_[f].first, Side::inside)) throw_orientation(f);
    for (const CloudFacetIndex f : body_.facet) {
      const auto& [face, k] = left_of_[f];
      const auto& right = face->neighbor(k)->info();
      if (right.side == Side::inside && !exists(right.facet[index_of(delaunay_.mirror_index(face, k))]))
        throw_orientation(f);
    }
  }

  [[noreturn]] void throw_orientation(CloudFacetIndex f) const {
    throw GeometryError(
        fmt::format("{} runs the wrong way round: expected the domain on its left (outer loops "
                    "counter-clockwise, holes clockwise)",
                    describe_facet(cloud_, f)));
  }

  void number_triangles() {
    const SimplexIndex begin = result_.node.next();
    std::vector<Face> faces;
    faces.reserve(2 * body_.node.size());
    for (const Face face : delaunay_.finite_face_handles()) {
      if (face->info().side != Side::inside) continue;
      face->info().triangle = as<SimplexIndex>(index_of(begin) + faces.size());
      faces.push_back(face);
    }
    if (faces.empty())
      throw GeometryError(fmt::format("empty domain: the boundary, which starts with {}, encloses no area",
                                      describe_facet(cloud_, body_.facet.front())));
    for (const Face face : faces) {
      auto& node = result_.node.emplace_back();
      auto& neighbour = result_.neighbour.emplace_back();
      auto& facet = result_.facet.emplace_back();
      for (int k = 0; k < 3; ++k) {
        const bool wall = face->is_constrained(k);
        node[index_of(k)] = face->vertex(k)->info();
        facet[index_of(k)] = face->info().facet[index_of(k)];
        neighbour[index_of(k)] = wall ? SimplexIndex::none : face->neighbor(k)->info().triangle;
      }
    }
  }

  /// Gives every sector of triangles between two facets at a merged vertex the node of these facets.
  void separate_merged_nodes() {
    for (const CloudFacetIndex f : body_.facet) {
      const NodeIndex node = cloud_.facets[f].node[0];
      if (!is_merged_[node]) continue;
      SimplexIndex t = left_of_[f].first->info().triangle;
      int k = ConstrainedDelaunay::ccw(left_of_[f].second);
      while (true) {
        result_.node[t][index_of(k)] = node;
        const int exit = ConstrainedDelaunay::ccw(k);
        const SimplexIndex next = result_.neighbour[t][index_of(exit)];
        if (!exists(next)) {
          const CloudFacetIndex last = result_.facet[t][index_of(exit)];
          if (cloud_.facets[last].node[1] == node) break;
          throw GeometryError(fmt::format(
              "the boundary touches or crosses itself at {}: the domain to the left of {} ends "
              "at {}, which does not arrive at that node",
              describe_node(cloud_, node), describe_facet(cloud_, f), describe_facet(cloud_, last)));
        }
        int back = 0;
        while (result_.neighbour[next][index_of(back)] != t) ++back;
        t = next;
        k = ConstrainedDelaunay::ccw(back);
      }
    }
  }

  void check_nodes() const {
    for (const NodeIndex i : cloud_.position.indices()) {
      if (is_merged_[i] && !on_boundary(i))
        throw GeometryError(
            fmt::format("{} is declared a twin but belongs to no facet: expected the nodes of "
                        "the two faces of a crack",
                        describe_node(cloud_, i)));
      if (!exists(result_.triangle_of_node[i]))
        throw GeometryError(fmt::format("{} lies outside the domain", describe_node(cloud_, i)));
    }
  }

  const Cloud<2>& cloud_;
  IndexedVector<NodeIndex, CloudFacetIndex> leaving_; ///< facet that leaves it
  IndexedVector<NodeIndex, NodeIndex> group_;         ///< of twins
  Body body_;                                         ///< that is under way, and what there is of it:
  ConstrainedDelaunay delaunay_;
  IndexedVector<NodeIndex, Vertex> vertex_;
  IndexedVector<NodeIndex, bool> is_merged_; ///< shares its CGAL vertex
  bool merged_ = false;                      ///< any of them
  IndexedVector<CloudFacetIndex, std::pair<Face, int>>
      left_of_; ///< the face on its left and the edge's index there
  std::vector<Face> stack_;
  Triangulation result_;
};

/// Whether neighbours know each other and share an edge, edges without a neighbour are facets in the sense of
/// the triangle, each facet on one of them, and the triangle of each node has it.
[[maybe_unused]] bool is_consistent(const Cloud<2>& cloud, const Triangulation& mesh) {
  IndexedVector<CloudFacetIndex, int> seen(cloud.facets.size(), 0);
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex a = mesh.node[t][(k + 1) % 3], b = mesh.node[t][(k + 2) % 3];
      const SimplexIndex across = mesh.neighbour[t][k];
      const CloudFacetIndex facet = mesh.facet[t][k];
      if (exists(across) == exists(facet)) return false;
      if (exists(facet)) {
        ++seen[facet];
        if (cloud.facets[facet].node != std::array{a, b}) return false;
        continue;
      }
      const auto& back = mesh.neighbour[across];
      const auto entry = index_of(std::find(back.begin(), back.end(), t) - back.begin());
      if (entry == 3) return false;
      const auto& other = mesh.node[across];
      if (other[(entry + 1) % 3] != b || other[(entry + 2) % 3] != a) return false;
    }
  for (const int count : seen)
    if (count != 1) return false;
  for (const NodeIndex i : cloud.position.indices()) {
    const auto& corner = mesh.node[mesh.triangle_of_node[i]];
    if (std::find(corner.begin(), corner.end(), i) == corner.end()) return false;
  }
  return true;
}

} // namespace

Triangulation triangulate(const Cloud<2>& cloud) {
  std::optional<Triangulation> mesh = retriangulate(cloud);
  if (!mesh) mesh = Builder(cloud).build();
  assert(is_consistent(cloud, *mesh));
  return std::move(*mesh);
}

} // namespace cnem::voronoi
