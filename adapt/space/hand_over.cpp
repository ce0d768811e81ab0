// Tetrahedra that go from one side of a period to the other.
#include "adapt/space/seams.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <utility>
#include <vector>

namespace cnem::adapt {
namespace {

using voronoi::face_of_tetrahedron;
using Corners = std::array<NodeIndex, 3>;
using Marks = IndexedVector<SimplexIndex, char>;

Corners sorted(Corners corner) {
  std::sort(corner.begin(), corner.end());
  return corner;
}

/// A tetrahedron on its way, and where it goes.
struct Move {
  SimplexIndex tetrahedron;
  std::array<NodeIndex, 4> image{};    ///< of its corners on the other side; none: made
  NodeIndex emptied = NodeIndex::none; ///< the corner that has no other tetrahedron
  std::vector<CloudFacetIndex> shut{}; ///< of one side and of the other, which come to lie within the body
};

/// What goes over at once: tetrahedra without common nodes. Of the structure, mesh and lists of tetrahedra
/// are kept up.
class Layer {
public:
  Layer(WorkingBody& body, SpaceStructure& structure, const SpaceRules& rules, PassReport& report)
      : body_(body), structure_(structure), rules_(rules), report_(report), cloud_(body.cloud()),
        images_(cloud_, rules.periods), periods_of_(cloud_.position.size(), 0) {
    for (const std::vector<NodeIndex>& group : images_.groups())
      for (const NodeIndex i : group) periods_of_[i] = group.size() - 1;
    owner_.resize(cloud_.facets.size());
    for (const SimplexIndex t : structure.mesh.node.indices())
      for (std::size_t k = 0; k < 4; ++k)
        if (const CloudFacetIndex f = structure.mesh.facet[t][k]; exists(f)) owner_[f] = {t, k};
  }

  /// Moves what may of those with a mark, and takes it off. The number of tetrahedra that went over.
  int run(Marks& waits) {
    std::vector<Move> moves;
    IndexedVector<NodeIndex, char> taken(cloud_.position.size(), 0);
    for (const SimplexIndex t : waits.indices()) {
      Move move{t};
      if (!waits[t] || !may_go(move)) continue;
      std::vector<NodeIndex> nodes(structure_.mesh.node[t].begin(), structure_.mesh.node[t].end());
      std::copy_if(move.image.begin(), move.image.end(), std::back_inserter(nodes),
                   [](NodeIndex i) { return exists(i); });
      if (std::any_of(nodes.begin(), nodes.end(), [&](NodeIndex i) { return taken[i]; })) continue;
      for (const NodeIndex i : nodes) taken[i] = 1;
      waits[t] = 0;
      moves.push_back(std::move(move));
    }
    if (!moves.empty()) carry_out(moves);
    return static_cast<int>(moves.size());
  }

private:
  /// The first facet round a node that is as wanted; none: there is no such.
  template<class Wanted> CloudFacetIndex facet_at(NodeIndex i, const Wanted& wanted) const {
    for (const SimplexIndex t : structure_.tetrahedra.of(i))
      for (std::size_t k = 0; k < 4; ++k)
        if (const CloudFacetIndex f = structure_.mesh.facet[t][k];
            exists(f) && structure_.mesh.node[t][k] != i && wanted(cloud_.facets[f]))
          return f;
    return CloudFacetIndex::none;
  }

  bool is_on_boundary(NodeIndex i) const {
    return exists(facet_at(i, [](const Facet<3>&) { return true; }));
  }

  bool is_boundary_edge(NodeIndex i, NodeIndex k) const {
    return exists(facet_at(i, [&](const Facet<3>& facet) {
      return std::find(facet.node.begin(), facet.node.end(), k) != facet.node.end();
    }));
  }

  CloudFacetIndex side_facet(const Corners& corner) const {
    return facet_at(corner[0], [&](const Facet<3>& facet) {
      return rules_.surface.is_still(facet.piece) && sorted(facet.node) == sorted(corner);
    });
  }

  bool are_linked(NodeIndex i, NodeIndex k) const {
    const auto around = structure_.tetrahedra.of(i);
    return std::any_of(around.begin(), around.end(), [&](SimplexIndex t) {
      const auto& node = structure_.mesh.node[t];
      return std::find(node.begin(), node.end(), k) != node.end();
    });
  }

  bool may_go_together(NodeIndex i, NodeIndex k) const {
    return body_.may_mix(i, k) && cloud_.one_body(i, k);
  }

  /// Whether the boundary stays a manifold on both sides; fills in where the tetrahedron goes.
  bool may_go(Move& move) const {
    const auto& node = structure_.mesh.node[move.tetrahedron];
    const auto& facet = structure_.mesh.facet[move.tetrahedron];
    std::vector<std::size_t> sides, on, inner; // faces by the corner opposite: on sides, on the boundary
    PieceIndex piece = PieceIndex::none;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!exists(facet[k])) {
        inner.push_back(k);
        continue;
      }
      on.push_back(k);
      const PieceIndex own = cloud_.facets[facet[k]].piece;
      if (!rules_.surface.is_still(own)) continue;
      if (!sides.empty() && own != piece) return false;
      piece = own;
      sides.push_back(k);
    }
    if (sides.empty() || inner.empty()) return false;
    // here
    if (on.size() == 1 && is_on_boundary(node[on[0]])) return false;
    if (on.size() == 2 && is_boundary_edge(node[on[0]], node[on[1]])) return false;
    if (on.size() == 3) {
      move.emptied = node[inner[0]];
      if (body_.held(move.emptied) || structure_.tetrahedra.of(move.emptied).size() > 1) return false;
    }
    // there
    for (std::size_t c = 0; c < 4; ++c) {
      const NodeIndex i = node[c], image = images_.image(i, piece);
      const bool beyond = sides.size() == 1 && sides[0] == c; // of the side, and of all others
      if (!may_go_together(node[0], i) || periods_of_[i] != (beyond ? 0 : 1) || (beyond && body_.held(i)))
        return false;
      if (exists(image) == beyond || (exists(image) && !may_go_together(i, image))) return false;
      move.image[c] = image;
    }
    if (sides.size() == 2 && are_linked(move.image[sides[0]], move.image[sides[1]])) return false;
    for (const std::size_t k : sides) {
      Corners corner;
      for (std::size_t c = 0; c < 3; ++c) corner[c] = move.image[face_of_tetrahedron[k][c]];
      const CloudFacetIndex there = side_facet(corner);
      if (!exists(there)) return false; // diagonals differ
      move.shut.push_back(facet[k]);
      move.shut.push_back(there);
    }
    return true;
  }

  /// The images of its corners, those that are made too, and the matter that they take.
  void hand_matter(Move& move, std::vector<Parcel>& parcels) {
    const auto& node = structure_.mesh.node[move.tetrahedron];
    const double volume = volume_of(cloud_, node);
    for (std::size_t c = 0; c < 4; ++c) {
      double all = 0.0;
      for (const SimplexIndex t : structure_.tetrahedra.of(node[c]))
        all += volume_of(cloud_, structure_.mesh.node[t]);
      if (!exists(move.image[c])) {
        const std::size_t beside = (c + 1) % 4;
        move.image[c] = body_.insert_image(node[c], node[beside], move.image[beside]);
        ++report_.inserted_boundary;
      }
      const double share = node[c] == move.emptied ? 1.0 : volume / all;
      if (share > 0.0 && body_.node().mass[index_of(node[c])] > 0.0)
        parcels.push_back({node[c], move.image[c], share});
    }
  }

  void carry_out(std::vector<Move>& moves) {
    voronoi::Tetrahedra& mesh = structure_.mesh;
    IndexedVector<CloudFacetIndex, Facet<3>> facets = cloud_.facets; // those that open come last
    IndexedVector<NodeIndex, char> gone(body_.size(), 0);
    IndexedVector<CloudFacetIndex, char> shut(facets.size(), 0);
    std::vector<Parcel> parcels;
    for (Move& move : moves) {
      hand_matter(move, parcels);
      for (const CloudFacetIndex f : move.shut) shut[f] = 1;
      connect(move, facets);
      if (exists(move.emptied)) {
        gone[move.emptied] = 1;
        ++report_.removed_boundary;
      }
    }
    shut.resize(facets.size(), 0);
    gone.resize(body_.size(), 0);
    IndexedVector<CloudFacetIndex, Facet<3>> kept;
    IndexedVector<CloudFacetIndex, CloudFacetIndex> facet_number(facets.size(), CloudFacetIndex::none);
    for (const CloudFacetIndex f : facets.indices()) {
      if (shut[f]) continue;
      facet_number[f] = kept.next();
      kept.push_back(facets[f]);
    }
    const IndexedVector<NodeIndex, NodeIndex> number = numbers_without(gone);
    body_.set_boundary(std::move(kept));
    body_.move(parcels);
    body_.renumber(number);
    mesh.of_node.assign(body_.size(), SimplexIndex::none);
    for (const SimplexIndex t : mesh.node.indices())
      for (std::size_t k = 0; k < 4; ++k) {
        NodeIndex& i = mesh.node[t][k];
        i = number[i];
        if (!exists(mesh.of_node[i])) mesh.of_node[i] = t;
        if (CloudFacetIndex& f = mesh.facet[t][k]; exists(f)) f = facet_number[f];
      }
    structure_.tetrahedra = tetrahedra_of_nodes(body_.size(), mesh);
    report_.recut += static_cast<int>(moves.size());
  }

  /// Opens the faces that a tetrahedron leaves, and closes those that it comes to.
  void connect(const Move& move, IndexedVector<CloudFacetIndex, Facet<3>>& facets) {
    voronoi::Tetrahedra& mesh = structure_.mesh;
    const SimplexIndex t = move.tetrahedron;
    const PieceIndex here = facets[move.shut[0]].piece, there = facets[move.shut[1]].piece;
    const std::array<NodeIndex, 4> node = std::exchange(mesh.node[t], move.image);
    for (std::size_t k = 0, side = 0; k < 4; ++k) {
      const auto& face = face_of_tetrahedron[k];
      const Corners image{move.image[face[0]], move.image[face[1]], move.image[face[2]]};
      SimplexIndex& neighbour = mesh.neighbour[t][k];
      CloudFacetIndex& facet = mesh.facet[t][k];
      if (exists(neighbour)) {
        auto& back = mesh.neighbour[neighbour];
        const auto from = index_of(std::find(back.begin(), back.end(), t) - back.begin());
        back[from] = SimplexIndex::none;
        mesh.facet[neighbour][from] = facets.next();
        facets.push_back({{node[face[2]], node[face[1]], node[face[0]]}, here});
        neighbour = SimplexIndex::none;
        facet = facets.next();
        facets.push_back({image, there});
      } else if (side < move.shut.size() && facet == move.shut[side]) {
        const auto [other, face_there] = owner_[move.shut[side + 1]];
        mesh.neighbour[other][face_there] = t;
        mesh.facet[other][face_there] = facet = CloudFacetIndex::none;
        neighbour = other;
        side += 2;
      } else {
        facets[facet].node = image;
      }
    }
  }

  WorkingBody& body_;
  SpaceStructure& structure_;
  const SpaceRules& rules_;
  PassReport& report_;
  const Cloud<3>& cloud_;
  const PeriodImages images_;
  IndexedVector<NodeIndex, std::size_t> periods_of_; ///< that a node is on, or one that is its image
  IndexedVector<CloudFacetIndex, std::pair<SimplexIndex, std::size_t>>
      owner_; ///< whose face it is, and which
};

} // namespace

int hand_over(WorkingBody& body, SpaceStructure& structure, const SpaceRules& rules,
              const IndexedVector<SimplexIndex, char>& goes, PassReport& report) {
  assert(body.cloud().twins.empty());
  Marks waits = goes;
  int all = 0;
  while (std::find(waits.begin(), waits.end(), 1) != waits.end()) {
    const int some = Layer(body, structure, rules, report).run(waits);
    if (some == 0) break;
    all += some;
  }
  if (all > 0) structure = structure_of(body.cloud(), std::move(structure.mesh));
  return all;
}

} // namespace cnem::adapt
