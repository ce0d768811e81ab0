#pragma once
// A part of box cells: plates, stepped and layered walls, and what a tool has taken of them. Its equation of
// motion is (1) of paper 004, M q̈ + C q̇ + K q = Q, with E(1 − D) and ρ(1 − D) of each cell (9).
#include "core/sparse_cholesky.hpp"
#include "machining/structure/cells.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace cnem::machining {

/// A box within a part, with a material of its own, or of which something is gone.
struct PartZone {
  Vec3 low, high;           ///< m
  std::size_t material = 0; ///< in PartShape::materials
  double taken = 0.0;       ///< D, in [0, 1]; 1: there are no cells
};

/// A box from the origin with zones; where these overlap the last one counts.
struct PartShape {
  Vec3 size;                           ///< m; of plates, z is the thickness
  std::array<int, 3> divisions;        ///< cells along each axis; zones that end between them divide more
  std::vector<ElasticSolid> materials; ///< the first one is that of the box
  std::vector<PartZone> zones;
  std::array<std::vector<double>, 3> more{}; ///< m, places along each axis where cells end, too
};

/// How many cells it has.
std::size_t cells_of(const PartShape& shape);

/// Places beside the ends of zones of which something is gone, within the box, by a quarter of the smallest
/// length between such ends: what bends at a step is as high as that, whatever the cells elsewhere; at least
/// a tenth of a cell. m
std::array<std::vector<double>, 3> beside_steps(const PartShape& shape);

/// A face of the box that is held: all unknowns of its nodes; of plates, if it turns, all but the slope
/// across it.
struct PartSupport {
  int axis = 0;
  bool far = false; ///< where the axis ends
  bool turns = false;
};

/// Places beside clamped faces by a quarter of the shorter side of the face: stresses at its edges have no
/// bound, and what bends there is as high as that. At least a tenth of a cell, none where cells are as thin.
/// m
std::array<std::vector<double>, 3> beside_clamps(const PartShape& shape,
                                                 std::span<const PartSupport> supports);

class Part {
public:
  /// Plates: u, v, w belong to the surface at half the height of the box, and cells that lie over each other
  /// are layers of one element; what is left beside that surface has an offset. Throws InputError where
  /// nothing is left.
  Part(PartShape shape, PartElement element, std::span<const PartSupport> supports);

  Eigen::Index unknowns() const { return unknowns_; }
  std::size_t cells() const { return cell_.size(); }
  std::size_t nodes() const { return position_.size(); }
  const PartShape& shape() const { return shape_; }
  PartElement element() const { return element_; }

  /// 1 − D of each cell, of the zones.
  const std::vector<double>& presence() const { return presence_; }
  /// Corners of a cell, m.
  Vec3 low(std::size_t cell) const { return cell_[cell].low; }
  Vec3 high(std::size_t cell) const { return cell_[cell].low + cell_[cell].size; }

  /// [unknowns × unknowns], both triangles, of the same pattern always. presence: [cell] 1 − D, > 0.
  SparseMatrix stiffness(std::span<const double> presence) const; ///< N/m
  SparseMatrix mass(std::span<const double> presence) const;      ///< kg
  /// Adds a cell `times` to both.
  void add_cell(std::size_t cell, double times, SparseMatrix& stiffness, SparseMatrix& mass) const;

  /// The displacement at points of the material, m from the corner of the box, is G q, [3 · points ×
  /// unknowns], and forces there are Gᵀ F (7). Throws InputError where a point is not within a cell.
  SparseMatrix displacement_at(std::span<const Vec3> points) const;
  /// The same where a point may lie beside the part: as the nearest one of it moves; beside the surface of a
  /// plate as its normal.
  SparseMatrix displacement_near(std::span<const Vec3> points) const;
  /// The same for the mean displacement of a face of the box: of a force that is spread evenly over what
  /// there is of it. [3 × unknowns]. Throws InputError where nothing is.
  SparseMatrix displacement_of(int axis, bool far) const;

  /// Places of the nodes, m, and their displacements, [node].
  const std::vector<Vec3>& positions() const { return position_; }
  std::vector<Vec3> displacements(const Eigen::VectorXd& q) const;
  /// Corner nodes of a cell in VTK's order: 8, of plates 4.
  std::vector<std::size_t> corners(std::size_t cell) const;

private:
  struct Cell {
    Vec3 low, size;
    std::size_t matrices = 0;       ///< in matrices_
    std::vector<std::int64_t> node; ///< in the order of ElementForm
  };
  void divide();
  void number(std::span<const PartSupport> supports);
  std::size_t matrices_of(const Vec3& size, double low, std::size_t material);
  void fill_pattern();
  double height(double z) const { return z - 0.5 * shape_.size.z(); }
  template<class Visit> void each_entry(const Cell& cell, Visit&& visit) const;
  SparseMatrix assemble(Eigen::MatrixXd CellMatrices::*which, std::span<const double> presence) const;
  void add_rows(const Cell& cell, const Vec3& point, double weight, Eigen::Index row,
                std::vector<Eigen::Triplet<double>>& entries) const;

  PartShape shape_;
  PartElement element_;
  std::array<std::vector<double>, 3> line_; ///< m, where cells end
  std::vector<Cell> cell_;
  std::vector<double> presence_;
  std::vector<CellMatrices> matrices_;
  std::map<std::array<std::int64_t, 5>, std::size_t> known_; ///< matrices of cells that are alike
  std::vector<Vec3> position_;
  std::vector<std::array<std::int64_t, 5>> unknown_; ///< [node][freedom]; −1: held
  Eigen::Index unknowns_ = 0;
  SparseMatrix pattern_; ///< zeros
};

} // namespace cnem::machining
