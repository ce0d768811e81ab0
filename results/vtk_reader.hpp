#pragma once
// Fields that a run has written (results/vtk_writer.hpp), read back.
#include "core/operators/discretisation.hpp"
#include "results/output_folder.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace cnem::results {

/// A further file of one time.
struct PartFile {
  std::string name; ///< of the tool whose outline it is; "surface", "polyhedra"
  std::string file; ///< path relative to the folder of results
};

/// Files of one time in fields.pvd.
struct FieldFiles {
  double time = 0.0;           ///< s
  std::string cells, nodes;    ///< paths relative to the folder of results
  std::vector<PartFile> parts; ///< in the plane their outlines, in space the parts that the case asks for
};

/// An array of a file, and the component of it that is meant.
struct FileArray {
  std::string name; ///< "stress [Pa]"
  std::size_t component = 0;
};

/// What fields.pvd, or another list, lists, in its order. Throws IoError when it cannot be read or is not
/// such a list.
std::vector<FieldFiles> read_field_series(const std::filesystem::path& folder,
                                          const char* list = files::fields);

/// What tools have, and vertices of cells where the frame has initial positions.
inline constexpr const char* vertex_displacement = "displacement [m]";

/// The cells of one time in the plane, with values of scalar fields.
struct CellFields {
  CellGeometry<2> cells;     ///< each vertex is a node of its own, with weight 1
  Fields<2> position;        ///< [component][vertex] m
  Fields<2> displacement;    ///< [component][vertex] m; empty where the file does not tell it
  std::vector<Field> values; ///< [name][cell]
};

/// Reads these arrays of cells; places in the file are counted from `origin` here. Throws IoError when the
/// file cannot be read, has no polygons or lacks a field.
CellFields read_cell_fields(const std::filesystem::path& file, const std::vector<FileArray>& arrays,
                            const Vec2& origin);

/// Whether a file of fields has an array for cells. Throws IoError where it is none.
bool has_cell_field(const std::filesystem::path& file, const FileArray& array);

/// The nodes of one time in space with the tetrahedra between them.
struct NodeFields {
  std::vector<std::array<NodeIndex, 4>> tetrahedra;
  Fields<3> position;        ///< [component][node] m
  std::vector<Field> values; ///< [name][node]
};

/// Reads these arrays of nodes; places in the files are counted from `origin` here. Throws IoError when the
/// files cannot be read, have no tetrahedra or lack a field.
NodeFields read_node_fields(const std::filesystem::path& cells, const std::filesystem::path& nodes,
                            const std::vector<FileArray>& arrays, const Vec3& origin);

/// Whether a file of fields has an array for nodes. Throws IoError where it is none.
bool has_node_field(const std::filesystem::path& file, const FileArray& array);

/// How far a tool has moved, m, by its file. Throws IoError.
Vec2 read_tool_displacement(const std::filesystem::path& file);

} // namespace cnem::results
