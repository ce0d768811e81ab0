#pragma once
// Constrained natural neighbours in space: Sibson and Laplace functions at any point.
#include "voronoi/functions.hpp"
#include "voronoi/space/circumspheres.hpp"
#include "voronoi/space/local_index.hpp"
#include "voronoi/space/tetrahedra.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cnem::voronoi {

/// What functions ask of a tetrahedron, side by side in a cache line, and of its corners.
struct FunctionMesh {
  struct alignas(64) Record {
    std::array<double, 3> centre; ///< m, of its circumsphere
    double limit;                 ///< m², as in Circumspheres
    std::array<NodeIndex, 4> node;
    std::array<SimplexIndex, 4> neighbour;
  };
  IndexedVector<SimplexIndex, Record> record;
  /// [tetrahedron][k] what is nearest to corner k of it, m³: between the corner, the middles of its edges and
  /// the circumcentres of faces and tetrahedron; signed. Of Sibson's functions alone.
  IndexedVector<SimplexIndex, std::array<double, 4>> share;

  FunctionMesh(const Cloud<3>& cloud, const Tetrahedra& mesh, const Circumspheres& spheres,
               Functions functions = Functions::sibson);
};

/// How often other functions had to be taken than those asked for.
struct Fallbacks {
  std::int64_t to_laplace = 0, to_linear = 0;
};

/// Evaluates shape functions on one mesh of tetrahedra. Holds references and scratch memory, so use one a
/// thread; nothing is allocated in an evaluation once the scratch has grown to the largest stencil.
///
/// The cavity of x are the tetrahedra whose circumspheres hold x, connected, and not across walls. With x
/// joined to the faces of the cavity, a neighbour loses its shares in the cavity less those in the new
/// tetrahedra (Sibson 1981), and has a facet with x that their dual facets make up (Laplace: Belikov et al.
/// 1997). Both reproduce linear fields for any cavity. Σ φ_i x_i = x is checked at each point, as is φ >= 0:
/// where rounding in flat tetrahedra or a cavity that x does not see all of break it Laplace's functions are
/// taken for Sibson's, and linear ones for Laplace's.
///
/// Properties: φ >= 0 (but of linear functions outside of the body), Σφ = 1, Σφ x_i = x, φ_i(x_j) = δ_ij,
/// linear on boundary facets, zero across walls.
class NaturalNeighbours3 {
public:
  NaturalNeighbours3(const Cloud<3>& cloud, const Tetrahedra& mesh, const FunctionMesh& functions);

  /// Functions at x in the domain. `hint`: a tetrahedron near x, from which no wall hides it; points outside
  /// get the linear functions of the last tetrahedron on the way.
  void evaluate(Functions functions, const Vec3& x, SimplexIndex hint);

  /// The same where one of some tetrahedra is likely to have x in its sphere: saves locating it.
  void evaluate(Functions functions, const Vec3& x, std::span<const SimplexIndex> near);

  // Results of the last evaluation.
  std::span<const NodeIndex> nodes() const { return node_; }
  std::span<const double> values() const { return value_; } ///< φ

  const Fallbacks& fallbacks() const { return fallbacks_; } ///< of all evaluations

private:
  enum class Outcome : std::uint8_t { surrounded, found, lost };

  /// A node of the cavity; position relative to x.
  struct Neighbour {
    NodeIndex node;
    double x, y, z, squared;
  };
  /// A face of the cavity, its normal out of it.
  struct Face {
    std::array<std::int32_t, 3> corner; ///< of the list of neighbours
    SimplexIndex beyond;                ///< none: a wall
  };

  bool in_sphere(SimplexIndex tetrahedron, const Vec3& x) const;
  void evaluate_from(Functions functions, const Vec3& x, SimplexIndex start,
                     std::span<const SimplexIndex> near);
  Outcome collect(const Vec3& x, SimplexIndex start);
  void grow(const Vec3& x);
  void take(SimplexIndex tetrahedron);
  std::int32_t place(NodeIndex node, const Vec3& x);
  bool on_wall(const Face& face);
  std::pair<double, double> volume_with(const Face& face) const;
  Outcome leave_hidden(const Vec3& x, SimplexIndex start);
  void weigh_laplace();
  void weigh_sibson();
  double missed_place(double& sum, Vec3& missed) const;
  bool finish();
  void linear(const Vec3& x, std::span<const SimplexIndex> near);

  const Cloud<3>& cloud_;
  const Tetrahedra& mesh_;
  const FunctionMesh& functions_;
  LocalIndex in_cavity_, place_of_;
  std::vector<SimplexIndex> cavity_;
  std::size_t grown_ = 0; ///< tetrahedra of the cavity whose neighbours have been looked at
  std::vector<std::array<std::int32_t, 4>> corner_; ///< [of those] in the list of neighbours
  std::vector<Neighbour> neighbour_;
  std::vector<Face> face_;
  std::vector<double> weight_; ///< [neighbour]
  std::vector<NodeIndex> node_;
  std::vector<double> value_;
  Fallbacks fallbacks_;
};

} // namespace cnem::voronoi
