#pragma once
// Where the points of a deformed workpiece are: the extended mapping Φ⁺ of paper 004, 3.2.2, (2)-(4), (7),
// (8).
#include "core/vec.hpp"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace cnem::machining {

/// A box of hexahedra in the material configuration with one more of them on each side, and displacements of
/// its nodes, trilinear between. Those of the box follow the workpiece, those outside are fixed: beyond them
/// nothing moves.
class HexahedralMap {
public:
  /// low, high: m, of the box, of cells[axis] hexahedra along each axis. border: m, how wide the ones around
  /// it are.
  HexahedralMap(const Vec3& low, const Vec3& high, const std::array<int, 3>& cells, const Vec3& border);

  /// Nodes of the box, m, in the order of displacements.
  const std::vector<Vec3>& places() const { return place_; }
  Eigen::Index unknowns() const { return 3 * static_cast<Eigen::Index>(place_.size()); }
  /// m, the diagonal of the box.
  double size() const;

  /// q_Hexa, m, [3 · places].
  void displace(const Eigen::VectorXd& q);
  const Eigen::VectorXd& displacements() const { return q_; }
  /// m, the largest of a node.
  double largest() const;
  /// Whether points of a segment can be images of the box: false where it lies beyond one of its sides by
  /// more than anything moves. m
  bool may_meet(const Vec3& from, const Vec3& to) const;

  /// Displacement of a material point, m.
  Vec3 displacement(const Vec3& material) const;
  /// The material point whose image is at a place, m, by Newton to 1e-13 of the size (8). Throws
  /// DivergenceError, with the hexahedron, where there is none. steps: those it took are added.
  Vec3 material(const Vec3& current, int* steps = nullptr) const;
  /// Adds what a force at a material point, N, does on displacements (7), to forces on nodes, N [3 · places].
  void press(const Vec3& material, const Vec3& force, Eigen::VectorXd& load) const;

  /// The hexahedron in which Φ⁺ is not certainly one-to-one: where the determinant of its gradient, a
  /// polynomial, has a Bernstein coefficient that is not positive. None: it is one-to-one everywhere, since
  /// it is the identity all round.
  std::optional<std::array<int, 3>> folded() const;
  /// "hexahedron (1, 2, 1), from (0, 0, 0) to (6, 2, 1) mm": its number among those of the box, from 1; 0 and
  /// beyond are those around it.
  std::string name(const std::array<int, 3>& cell) const;

private:
  struct At { // in a hexahedron
    std::array<int, 3> cell{};
    Vec3 place; ///< in [0, 1]
  };
  std::optional<At> find(const Vec3& material) const; ///< none beyond all
  Eigen::Index node(int i, int j, int k) const;       ///< in q_, of lattice (i, j, k); −1: fixed
  Vec3 node_displacement(int i, int j, int k) const;
  Vec3 cell_size(const std::array<int, 3>& cell) const;
  /// Displacement, and its gradient over material coordinates, [i][k] = ∂u_i/∂X_k.
  Vec3 interpolate(const At& at, Mat<3>* gradient) const;

  std::array<std::vector<double>, 3> line_; ///< m
  std::vector<Vec3> place_;
  Eigen::VectorXd q_;
};

} // namespace cnem::machining
