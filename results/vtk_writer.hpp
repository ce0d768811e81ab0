#pragma once
// Fields for ParaView and VTK: fields.pvd, a time series whose every time has two parts: the cells of the
// stress points, polygons or tetrahedra, with cell data, and the nodes as points with point data; in the
// plane the outline of each tool is a further one.
#include "core/operators/discretisation.hpp"
#include "results/file_queue.hpp"
#include "results/output_folder.hpp"
#include "results/polyhedra.hpp"
#include "results/vtk_reader.hpp"

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cnem::results {

/// One value per cell or node. `name` carries the unit: "temperature [K]".
struct ScalarField {
  std::string name;
  std::span<const double> values;
};

/// A vector or tensor per cell or node; an empty span is a component that is zero.
struct VectorField {
  std::string name;
  std::vector<std::span<const double>> component;
  std::vector<std::string> component_names{}; ///< none: VTK's own
};

/// A tool at one time.
struct ToolOutline {
  std::string name;
  std::vector<Vec2> corners;   ///< m, of a closed polygon in its initial place
  Vec2 displacement, velocity; ///< m, m/s
};

/// Everything written for one time. Whoever makes one keeps what its spans and pointers refer to alive and
/// unchanged as long as the frame.
template<int dim> struct FieldFrame {
  double time = 0.0; ///< s
  const CellGeometry<dim>* cells = nullptr;
  std::array<std::span<const double>, dim> position;  ///< [component][node] m, present positions
  std::array<std::span<const double>, dim> initial{}; ///< m; where given, vertices tell their displacement
  Vec3 origin{0, 0, 0};                               ///< m, from which positions are counted
  std::vector<ScalarField> cell_scalars;
  std::vector<VectorField> cell_vectors;
  std::vector<ScalarField> node_scalars;
  std::vector<VectorField> node_vectors;
  std::vector<ToolOutline> tools{};
  std::vector<std::array<NodeIndex, 3>> surface{}; ///< in space, outwards; empty: no file
  std::optional<Polyhedra> polyhedra{};            ///< in space, the cells of the nodes
};

/// Present positions of the vertices of the cells, x_v = Σ weight x_node, m.
template<int dim>
std::vector<Vec<dim>> moved_vertices(const CellGeometry<dim>& cells,
                                     const std::array<std::span<const double>, dim>& position) {
  std::vector<Vec<dim>> moved(cells.vertex.size(), Vec<dim>::Zero());
  for (std::size_t v = 0; v < moved.size(); ++v)
    for (auto k = index_of(cells.vertex_begin[v]); k < index_of(cells.vertex_begin[v + 1]); ++k) {
      const auto node = index_of(cells.vertex_node[k]);
      for (int c = 0; c < dim; ++c) moved[v][c] += cells.vertex_weight[k] * position[index_of(c)][node];
    }
  return moved;
}

/// What a series is called: its list, and how names of its files begin in the folder of fields.
struct Series {
  const char* list = files::fields;
  const char* prefix = "";
};

/// Writes fields/cells_*.vtu, fields/nodes_*.vtu, fields/outline_TOOL_*.vtu (or surface_*.vtu,
/// polyhedra_*.vtu) and, after each frame, fields.pvd
/// (replaced atomically, so that a killed run leaves a valid series).
class FieldWriter {
public:
  /// A new series in `folder`.
  explicit FieldWriter(std::filesystem::path folder, Series series = {});

  /// Goes on with the series in `folder` after a restart: frames later than `time` (s) are dropped from the
  /// series and their files removed. Throws IoError when fields.pvd cannot be read.
  static FieldWriter resume(std::filesystem::path folder, double time, Series series = {});

  /// Hands the files of the frame to `queue`, which makes them later. Throws InputError when a field has the
  /// wrong length, IoError.
  template<int dim> void write(FileQueue& queue, std::shared_ptr<const FieldFrame<dim>> frame);

  int frames() const { return static_cast<int>(entries_.size()); }
  /// Whether the last frame is of `time` (s).
  bool has(double time) const { return !entries_.empty() && entries_.back().time == time; }

private:
  FieldWriter() = default;
  std::string collection() const;

  std::filesystem::path folder_;
  Series series_;
  std::vector<FieldFiles> entries_;
};

} // namespace cnem::results
