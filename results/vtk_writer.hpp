#pragma once
// Fields for ParaView and VTK: fields.pvd, a time series whose every time has two parts: the cells of the
// stress points as polygons with cell data, and the nodes as points with point data.
#include "core/discretisation.hpp"
#include "results/file_queue.hpp"

#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace cnem::results {

/// One value per cell or node. `name` carries the unit: "temperature [K]".
struct ScalarField {
  std::string name;
  std::span<const double> values;
};

/// Up to three components per cell or node; an empty span is a component that is zero.
struct VectorField {
  std::string name;
  std::array<std::span<const double>, 3> component;
};

/// Everything written for one time. Whoever makes one keeps what its spans and pointers refer to alive and
/// unchanged as long as the frame.
struct FieldFrame {
  double time = 0.0; ///< s
  const CellGeometry<2>* cells = nullptr;
  std::array<std::span<const double>, 2> position; ///< [component][node] m, present positions
  Vec2 origin{0, 0};                               ///< m, from which positions are counted
  std::vector<ScalarField> cell_scalars;
  std::vector<VectorField> cell_vectors;
  std::vector<ScalarField> node_scalars;
  std::vector<VectorField> node_vectors;
};

/// Present positions of the vertices of the cells, x_v = Σ weight x_node, m.
std::vector<Vec2> moved_vertices(const CellGeometry<2>& cells,
                                 const std::array<std::span<const double>, 2>& position);

/// Writes fields/cells_*.vtu, fields/nodes_*.vtu and, after each frame, fields.pvd (replaced atomically, so
/// that a killed run leaves a valid series).
class FieldWriter {
public:
  /// A new series in `folder`.
  explicit FieldWriter(std::filesystem::path folder);

  /// Goes on with the series in `folder` after a restart: frames later than `time` (s) are dropped from the
  /// series and their files removed. Throws IoError when fields.pvd cannot be read.
  static FieldWriter resume(std::filesystem::path folder, double time);

  /// Hands the files of the frame to `queue`, which makes them later. Throws InputError when a field has the
  /// wrong length, IoError.
  void write(FileQueue& queue, std::shared_ptr<const FieldFrame> frame);

  int frames() const { return static_cast<int>(entries_.size()); }

private:
  struct Entry {
    double time;
    std::string cells, nodes; ///< paths relative to the folder
  };
  FieldWriter() = default;
  std::string collection() const;

  std::filesystem::path folder_;
  std::vector<Entry> entries_;
};

} // namespace cnem::results
