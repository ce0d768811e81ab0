#pragma once
// Stiffness and mass of one rectangular cell of a part: what finite elements of paper 004, (1), are made of.
#include "core/vec.hpp"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace cnem::machining {

/// Isotropic.
struct ElasticSolid {
  double young = 0.0;   ///< Pa
  double poisson = 0.0; ///< –, in (−1, ½)
  double density = 0.0; ///< kg/m³
};

/// How a part is divided. Hexahedra of 27 nodes (triquadratic, fully integrated) bend without locking;
/// those of 8 nodes (trilinear, fully integrated) lock, and are there to compare with. Plates of 8 nodes
/// are Mindlin's (serendipity, stiffness at 2 × 2 points, mass at 3 × 3, shear correction 5/6).
enum class PartElement { hexahedron_27, hexahedron_8, plate_8 };

/// What one kind of elements is made of.
struct ElementForm {
  int order = 0;                                ///< steps of the lattice of nodes in a cell
  int freedoms = 0;                             ///< at a node: u, v, w; of plates u, v, w, βx, βy
  std::vector<std::array<int, 3>> lattice_node; ///< places of its nodes on the lattice of the cell
};
const ElementForm& form_of(PartElement element);

/// Symmetric, [freedoms × nodes] both ways: node after node, as in ElementForm.
struct CellMatrices {
  Eigen::MatrixXd stiffness; ///< N/m
  Eigen::MatrixXd mass;      ///< kg
};

/// size: m. low: of plates, the height of the cell's lower side over the surface that u, v, w belong to: a
/// plate is as many cells over each other as it has layers.
CellMatrices cell_matrices(PartElement element, const Vec3& size, double low, const ElasticSolid& solid);

/// What the nodes' unknowns make of the displacement at a place in the cell, [3 × freedoms · nodes]. place:
/// of each axis in [0, 1]; height: of plates, m over the surface that u, v, w belong to. (7)
Eigen::MatrixXd cell_interpolation(PartElement element, const Vec3& place, double height);

} // namespace cnem::machining
