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

/// What goes over at once: tetrahedra without common nodes.
class Layer {
public:
  Layer(WorkingBody& body, SpaceStructure& structure, const SpaceRules& rules, PassReport& report)
      : body_(body), structure_(structure), rules_(rules), report_(report), cloud_(body.cloud()),
        images_(cloud_, rules.periods), periods_of_(cloud_.position.size(), 0),
        on_boundary_(cloud_.position.size(), 0) {
    for (const std::vector<NodeIndex>& group : images_.groups())
      for (const NodeIndex i : group) periods_of_[i] = group.size() - 1;
    for (const CloudFacetIndex f : cloud_.facets.indices()) {
      const Corners& node = cloud_.facets[f].node;
      if (rules.surface.is_still(cloud_.facets[f].piece)) sides_.emplace_back(sorted(node), f);
      for (std::size_t k = 0; k < 3; ++k) {
        const NodeIndex a = node[k], b = node[(k + 1) % 3];
        on_boundary_[a] = 1;
        edges_.emplace_back(std::min(a, b), std::max(a, b));
      }
    }
    std::sort(sides_.begin(), sides_.end());
    std::sort(edges_.begin(), edges_.end());
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
  bool is_boundary_edge(NodeIndex i, NodeIndex k) const {
    return std::binary_search(edges_.begin(), edges_.end(), std::pair(std::min(i, k), std::max(i, k)));
  }

  CloudFacetIndex side_facet(const Corners& corner) const {
    const std::pair wanted(sorted(corner), as<CloudFacetIndex>(0));
    const auto found = std::lower_bound(sides_.begin(), sides_.end(), wanted);
    return found != sides_.end() && found->first == wanted.first ? found->second : CloudFacetIndex::none;
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
    if (on.size() == 1 && on_boundary_[node[on[0]]]) return false;
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
    if (sides.size() == 2) {
      const auto linked = structure_.neighbours(move.image[sides[0]]);
      if (std::find(linked.begin(), linked.end(), move.image[sides[1]]) != linked.end()) return false;
    }
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
    const voronoi::Tetrahedra& mesh = structure_.mesh;
    std::vector<std::array<NodeIndex, 4>> tetrahedra(mesh.node.begin(), mesh.node.end());
    IndexedVector<CloudFacetIndex, Facet<3>> facets = cloud_.facets;
    IndexedVector<CloudFacetIndex, char> shut(facets.size(), 0);
    std::vector<Facet<3>> opened;
    std::vector<Parcel> parcels;
    for (Move& move : moves) {
      const SimplexIndex t = move.tetrahedron;
      hand_matter(move, parcels);
      for (const CloudFacetIndex f : move.shut) shut[f] = 1;
      const auto& node = mesh.node[t];
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& face = face_of_tetrahedron[k];
        const Corners image{move.image[face[0]], move.image[face[1]], move.image[face[2]]};
        if (const CloudFacetIndex f = mesh.facet[t][k]; !exists(f)) {
          opened.push_back({{node[face[2]], node[face[1]], node[face[0]]}, facets[move.shut[0]].piece});
          opened.push_back({image, facets[move.shut[1]].piece});
        } else if (!shut[f]) {
          facets[f].node = image;
        }
      }
      tetrahedra[index_of(t)] = move.image;
    }
    IndexedVector<CloudFacetIndex, Facet<3>> kept;
    for (const CloudFacetIndex f : facets.indices())
      if (!shut[f]) kept.push_back(facets[f]);
    kept.insert(kept.end(), opened.begin(), opened.end());
    IndexedVector<NodeIndex, char> gone(body_.size(), 0);
    for (const Move& move : moves)
      if (exists(move.emptied)) {
        gone[move.emptied] = 1;
        ++report_.removed_boundary;
      }
    const IndexedVector<NodeIndex, NodeIndex> number = numbers_without(gone);
    body_.set_boundary(std::move(kept));
    body_.move(parcels);
    body_.drop(gone);
    for (auto& node : tetrahedra)
      for (NodeIndex& i : node) i = number[i];
    structure_ = structure_of(body_.cloud(), voronoi::connected(body_.cloud(), tetrahedra));
    report_.recut += static_cast<int>(moves.size());
  }

  WorkingBody& body_;
  SpaceStructure& structure_;
  const SpaceRules& rules_;
  PassReport& report_;
  const Cloud<3>& cloud_;
  const PeriodImages images_;
  IndexedVector<NodeIndex, std::size_t> periods_of_; ///< that a node is on, or one that is its image
  IndexedVector<NodeIndex, char> on_boundary_;
  std::vector<std::pair<Corners, CloudFacetIndex>> sides_; ///< facets of sides by their nodes
  std::vector<std::pair<NodeIndex, NodeIndex>> edges_;     ///< of the boundary
};

} // namespace

int hand_over(WorkingBody& body, SpaceStructure& structure, const SpaceRules& rules,
              const IndexedVector<SimplexIndex, char>& goes, PassReport& report) {
  assert(body.cloud().twins.empty());
  Marks waits = goes;
  int all = 0;
  for (int some = 1; some > 0; all += some) some = Layer(body, structure, rules, report).run(waits);
  return all;
}

} // namespace cnem::adapt
