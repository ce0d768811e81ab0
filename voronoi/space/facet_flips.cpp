#include "voronoi/space/facet_flips.hpp"

#include "core/index.hpp"
#include "voronoi/space/exchanges.hpp"
#include "voronoi/space/surface.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <type_traits>
#include <utility>

namespace cnem::voronoi {

namespace {

using Nodes = FlipMesh::Nodes;

bool has(Stars& stars, const Edge& e) { return exists(stars.with(e.first, e.second)); }
bool has(Stars& stars, const Face& f) { return exists(stars.with(f[0], f[1], f[2])); }

/// Edges and facets that are to be brought into the tetrahedra.
struct Wanted {
  std::vector<Edge> edges;
  std::vector<Face> facets;

  Wanted(const Cloud<3>& cloud, const SurfaceParts& surface, const std::vector<CloudFacetIndex>& lost) {
    for (const CloudFacetIndex f : lost) {
      facets.push_back(surface.at_first(cloud.facets[f]));
      for (std::size_t k = 0; k < 3; ++k)
        edges.push_back(edge_of(facets.back()[k], facets.back()[(k + 1) % 3]));
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::sort(facets.begin(), facets.end());
    facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  }

  Wanted in_order(std::uint64_t order) const {
    Wanted other = *this;
    if (order == 0) return other;
    std::mt19937_64 random(order);
    const auto shuffle = [&](auto& list) {
      for (std::size_t n = list.size(); n > 1; --n) std::swap(list[n - 1], list[random() % n]);
    };
    shuffle(other.edges);
    shuffle(other.facets);
    return other;
  }

  /// Those that some tetrahedra lack.
  Wanted missing(Stars& stars) const {
    Wanted left = *this;
    std::erase_if(left.edges, [&](const Edge& e) { return has(stars, e); });
    std::erase_if(left.facets, [&](const Face& f) { return has(stars, f); });
    return left;
  }

  auto operator<=>(const Wanted&) const = default;
};

class Holder {
public:
  Holder(const Cloud<3>& cloud, const SurfaceParts& surface, Delaunay& mesh)
      : exchanges_(cloud, surface, mesh), mesh_(exchanges_.mesh) {}

  void hold(Wanted wanted) {
    auto& [edges, facets] = wanted;
    for (int round = 0; round < 3; ++round) {
      const std::size_t left = edges.size() + facets.size();
      std::erase_if(edges, [&](const Edge& e) { return bring(e); });
      std::erase_if(facets, [&](const auto& f) { return bring(f); });
      if (edges.size() + facets.size() == left) break;
    }
  }

  FlipMesh& mesh() { return mesh_; }

private:
  /// What stands in the way of an edge or a facet.
  struct Crossings {
    std::vector<Face> faces;
    std::vector<Edge> edges;
    std::vector<SimplexIndex> tetrahedra; ///< that have them
    int measure() const { return static_cast<int>(8 * faces.size() + 6 * edges.size() + tetrahedra.size()); }
  };

  template<class Target> bool is_there(const Target& target) { return has(mesh_.stars(), target); }

  /// Faces and edges that the open segment between two nodes passes.
  Crossings crossings(const Edge& edge) {
    const auto [a, b] = edge;
    Crossings found;
    std::vector<SimplexIndex> list = mesh_.stars().of(a);
    const auto add = [&](SimplexIndex t) {
      if (std::find(list.begin(), list.end(), t) == list.end()) list.push_back(t);
    };
    for (std::size_t n = 0; n < list.size(); ++n) {
      const SimplexIndex t = list[n];
      const Nodes node = mesh_.nodes(t);
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& corner = face_of_tetrahedron[k];
        const Face face{node[corner[0]], node[corner[1]], node[corner[2]]};
        if (std::find(face.begin(), face.end(), a) != face.end() ||
            std::find(face.begin(), face.end(), b) != face.end())
          continue;
        if (mesh_.sign(face[0], face[1], face[2], a) * mesh_.sign(face[0], face[1], face[2], b) >= 0)
          continue;
        std::array<int, 3> turn;
        for (std::size_t q = 0; q < 3; ++q) turn[q] = mesh_.sign(a, b, face[q], face[(q + 1) % 3]);
        if (std::min({turn[0], turn[1], turn[2]}) * std::max({turn[0], turn[1], turn[2]}) < 0) continue;
        const auto zeros = std::count(turn.begin(), turn.end(), 0);
        if (zeros == 0) {
          auto sorted = face;
          std::sort(sorted.begin(), sorted.end());
          if (std::find(found.faces.begin(), found.faces.end(), sorted) == found.faces.end())
            found.faces.push_back(sorted);
          found.tetrahedra.push_back(t);
          if (exists(mesh_.neighbours(t)[k])) add(mesh_.neighbours(t)[k]);
        } else if (zeros == 1) {
          const auto q = index_of(std::find(turn.begin(), turn.end(), 0) - turn.begin());
          const Edge crossed = edge_of(face[q], face[(q + 1) % 3]);
          if (std::find(found.edges.begin(), found.edges.end(), crossed) != found.edges.end()) continue;
          found.edges.push_back(crossed);
          for (const SimplexIndex other : mesh_.ring(crossed.first, crossed.second, t).tetrahedra) {
            add(other);
            found.tetrahedra.push_back(other);
          }
        }
      }
    }
    return found;
  }

  bool pierces(const Edge& edge, const Face& f) const {
    const auto [p, q] = edge;
    for (const NodeIndex i : f)
      if (i == p || i == q) return false;
    if (mesh_.sign(f[0], f[1], f[2], p) * mesh_.sign(f[0], f[1], f[2], q) >= 0) return false;
    const int one = mesh_.sign(p, q, f[0], f[1]), two = mesh_.sign(p, q, f[1], f[2]),
              three = mesh_.sign(p, q, f[2], f[0]);
    return one != 0 && one == two && two == three;
  }

  /// Edges that pass the inside of a triangle whose edges are there.
  Crossings crossings(const Face& facet) {
    Crossings found;
    std::vector<SimplexIndex> list = mesh_.stars().of(facet[0]);
    for (std::size_t n = 0; n < list.size(); ++n) {
      const SimplexIndex t = list[n];
      const Nodes node = mesh_.nodes(t);
      for (std::size_t p = 0; p < 4; ++p)
        for (std::size_t q = 0; q < p; ++q) {
          const Edge edge = edge_of(node[p], node[q]);
          if (std::find(found.edges.begin(), found.edges.end(), edge) != found.edges.end()) continue;
          if (!pierces(edge, facet)) continue;
          found.edges.push_back(edge);
          for (const SimplexIndex other : mesh_.ring(edge.first, edge.second, t).tetrahedra) {
            if (std::find(list.begin(), list.end(), other) == list.end()) list.push_back(other);
            found.tetrahedra.push_back(other);
          }
        }
    }
    return found;
  }

  /// Exchanges of what crosses, or, `wide`, of anything of the tetrahedra that are crossed.
  std::vector<Exchange> exchanges_for(const Crossings& crossings, bool wide) {
    std::vector<Edge> edges = crossings.edges;
    std::vector<Face> faces = crossings.faces;
    for (const Face& face : crossings.faces)
      for (std::size_t k = 0; k < 3; ++k) edges.push_back(edge_of(face[k], face[(k + 1) % 3]));
    for (const Edge& edge : crossings.edges)
      for (const NodeIndex i :
           mesh_.ring(edge.first, edge.second, mesh_.stars().with(edge.first, edge.second)).around)
        faces.push_back(face_of(edge.first, edge.second, i));
    for (const SimplexIndex t : crossings.tetrahedra) {
      if (!wide) break;
      const Nodes& node = mesh_.nodes(t);
      for (std::size_t p = 0; p < 4; ++p) {
        for (std::size_t q = 0; q < p; ++q) edges.push_back(edge_of(node[p], node[q]));
        const auto& [a, b, c] = face_of_tetrahedron[p];
        faces.push_back(face_of(node[a], node[b], node[c]));
      }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    std::vector<Exchange> exchanges;
    for (const Face& face : faces) exchanges_.add_split(face, exchanges);
    for (const Edge& edge : edges) exchanges_.add_removals(edge, exchanges);
    return exchanges;
  }

  template<class Target> int measure(const Target& target) {
    return is_there(target) ? -1 : crossings(target).measure();
  }

  /// f() while an exchange is made.
  template<class Function> int tried(const Exchange& exchange, const Function& f) {
    const std::vector<Nodes> before = exchanges_.nodes_of(exchange.old);
    const std::vector<SimplexIndex> made = mesh_.replace(exchange.old, exchange.fresh);
    const int result = f();
    mesh_.replace(made, before); // gives each its number back
    return result;
  }

  /// The least measure that one exchange leads to.
  template<class Target> int least_after_next(const Target& target) {
    if (is_there(target)) return -1;
    const Crossings now = crossings(target);
    int least = now.measure();
    for (const Exchange& exchange : exchanges_for(now, false)) {
      least = std::min(least, tried(exchange, [&] { return measure(target); }));
      if (least < 0) break;
    }
    return least;
  }

  /// Exchanges, the one that leaves least in the way first, and where none leaves less, the one after which
  /// the next does. None is made or taken back twice.
  template<class Target> bool bring(const Target& target) {
    if constexpr (std::is_same_v<Target, Face>)
      for (std::size_t k = 0; k < 3; ++k)
        if (!is_there(edge_of(target[k], target[(k + 1) % 3]))) return false;
    std::set<std::vector<Nodes>> known;
    for (int step = 0; step < most_steps; ++step) {
      if (is_there(target)) return true;
      const Crossings now = crossings(target);
      std::optional<Exchange> choice;
      int best = now.measure();
      for (const bool wide : {false, true}) {
        if (choice) break;
        if (wide) best = std::numeric_limits<int>::max();
        for (const Exchange& exchange : exchanges_for(now, wide)) {
          if (known.contains(key_of(exchange.fresh))) continue;
          const int then = tried(exchange, [&] { return wide ? least_after_next(target) : measure(target); });
          if (then < best) best = then, choice = exchange;
        }
      }
      if (!choice) return false;
      known.insert(key_of(exchanges_.nodes_of(choice->old)));
      known.insert(key_of(choice->fresh));
      mesh_.replace(choice->old, choice->fresh);
    }
    return is_there(target);
  }

  static constexpr int most_steps = 30;

  Exchanges exchanges_;
  FlipMesh& mesh_;
};

} // namespace

HeldFacets hold_facets(const Cloud<3>& cloud, Delaunay& mesh, Walls walls, int orders) {
  if (walls.lost.empty()) return {std::move(walls), true};
  refuse_crossings(cloud, walls.lost);
  const SurfaceParts surface(cloud, mesh.first);
  const Wanted wanted(cloud, surface, walls.lost);
  Stars stars(mesh);
  Delaunay best;
  std::size_t least = walls.lost.size() + 1;
  bool at_once = false;
  std::set<Wanted> tried; // orders that differ in what is there already lead to the same
  for (int order = 0; order < orders && least > 0; ++order) {
    const Wanted next = wanted.in_order(as<std::uint64_t>(order));
    if (!tried.insert(next.missing(stars)).second) continue;
    Delaunay flipped = mesh;
    Holder holder(cloud, surface, flipped);
    holder.hold(next);
    std::size_t left = 0; // facets that were there still are
    for (const CloudFacetIndex f : walls.lost)
      left += !has(holder.mesh().stars(), surface.at_first(cloud.facets[f]));
    holder.mesh().finish();
    if (left < least) least = left, best = std::move(flipped);
    at_once = order == 0 && left == 0;
  }
  mesh = std::move(best);
  return {find_walls(cloud, mesh), at_once};
}

} // namespace cnem::voronoi
