#include "results/vtk_reader.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "results/output_folder.hpp"

#include <charconv>
#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkExecutive.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

namespace cnem::results {

namespace fs = std::filesystem;

std::vector<FieldFiles> read_field_series(const fs::path& folder, const char* list) {
  const fs::path path = folder / list;
  const std::string text = read_file(path);
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(text.c_str()));
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection) throw IoError(fmt::format("{} is not a collection of VTK files", path.string()));
  const auto attribute = [&](int element, const char* name) -> std::string {
    const char* value = collection->GetNestedElement(element)->GetAttribute(name);
    if (!value) throw IoError(fmt::format("{}: a DataSet without \"{}\"", path.string(), name));
    return value;
  };
  std::vector<FieldFiles> series;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
    const std::string part = attribute(k, "part"), time = attribute(k, "timestep");
    if (part == "0") { // the cells, with which a time begins
      const char* end = time.data() + time.size();
      FieldFiles& frame = series.emplace_back();
      if (std::from_chars(time.data(), end, frame.time).ptr != end || time.empty())
        throw IoError(fmt::format("{}: found the time '{}', expected a number", path.string(), time));
      frame.cells = attribute(k, "file");
    } else if (series.empty()) {
      throw IoError(fmt::format("{}: found part {} first, expected the cells", path.string(), part));
    } else if (part == "1") {
      series.back().nodes = attribute(k, "file");
    } else {
      series.back().parts.push_back({attribute(k, "name"), attribute(k, "file")});
    }
  }
  return series;
}

namespace {

/// A file of fields that is looked into. What VTK finds wrong is not printed, but makes an IoError.
class GridFile {
public:
  explicit GridFile(const fs::path& file) : file_(file) {
    if (!fs::exists(file) || !reader->CanReadFile(file.c_str()))
      throw IoError(fmt::format("cannot read {}: it is no file of fields", file.string()));
    vtkNew<vtkCallbackCommand> note;
    note->SetClientData(&failed_);
    note->SetCallback(
        [](vtkObject*, unsigned long, void* failed, void*) { *static_cast<bool*>(failed) = true; });
    reader->SetReaderErrorObserver(note);
    reader->SetParserErrorObserver(note);
    reader->AddObserver(vtkCommand::ErrorEvent, note);
    reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, note);
    reader->SetFileName(file.c_str());
    reader->UpdateInformation();
    check();
  }
  GridFile(const GridFile&) = delete;
  GridFile& operator=(const GridFile&) = delete;

  void check() const {
    if (failed_ || reader->GetErrorCode() != 0)
      throw IoError(fmt::format("cannot read {}: it is damaged or cut short", file_.string()));
  }

private:
  bool failed_ = false; // before the reader, which tells it
  fs::path file_;

public:
  vtkNew<vtkXMLUnstructuredGridReader> reader;
};

/// The grid of a file; of the arrays of cells only `arrays`.
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const fs::path& file, const std::vector<FileArray>& arrays) {
  const GridFile grid_file(file);
  vtkXMLUnstructuredGridReader* const reader = grid_file.reader;
  vtkDataArraySelection& wanted = *reader->GetCellDataArraySelection();
  wanted.DisableAllArrays();
  for (const FileArray& array : arrays) {
    if (!wanted.ArrayExists(array.name.c_str()))
      throw IoError(fmt::format("{} has no field '{}'", file.string(), array.name));
    wanted.EnableArray(array.name.c_str());
  }
  reader->Update();
  grid_file.check();
  vtkSmartPointer<vtkUnstructuredGrid> grid = reader->GetOutput();
  if (grid->GetNumberOfCells() == 0) throw IoError(fmt::format("{} has no cells", file.string()));
  return grid;
}

} // namespace

CellFields read_cell_fields(const fs::path& file, const std::vector<FileArray>& arrays, const Vec2& origin) {
  const auto read = read_grid(file, arrays);
  vtkUnstructuredGrid& grid = *read;

  CellFields frame;
  CellGeometry<2>& cells = frame.cells;
  cells.vertex_begin.push_back(0);
  for (vtkIdType v = 0; v < grid.GetNumberOfPoints(); ++v) {
    std::array<double, 3> x{};
    grid.GetPoint(v, x.data());
    cells.vertex.push_back(Vec2(x[0], x[1]) - origin);
    for (std::size_t k = 0; k < 2; ++k) frame.position[k].push_back(cells.vertex.back()[as<int>(k)]);
    cells.vertex_node.push_back(as<NodeIndex>(v));
    cells.vertex_weight.push_back(1.0);
    cells.vertex_begin.push_back(as<std::int32_t>(v + 1));
  }
  if (vtkDataArray* array = grid.GetPointData()->GetArray(vertex_displacement))
    for (int k = 0; k < 2; ++k)
      for (vtkIdType v = 0; v < grid.GetNumberOfPoints(); ++v)
        frame.displacement[index_of(k)].push_back(array->GetComponent(v, k));
  cells.begin.push_back(0);
  vtkNew<vtkIdList> polygon;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    grid.GetCellPoints(c, polygon);
    for (vtkIdType k = 0; k < polygon->GetNumberOfIds(); ++k)
      cells.index.push_back(as<std::int32_t>(polygon->GetId(k)));
    cells.begin.push_back(as<std::int32_t>(cells.index.size()));
  }
  for (const FileArray& wanted : arrays) {
    vtkDataArray* array = grid.GetCellData()->GetArray(wanted.name.c_str());
    const int component = as<int>(wanted.component);
    if (!array || component >= array->GetNumberOfComponents())
      throw IoError(fmt::format("{} has not all of the field '{}'", file.string(), wanted.name));
    Field& values = frame.values.emplace_back();
    for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c)
      values.push_back(array->GetComponent(c, component));
  }
  return frame;
}

bool has_cell_field(const fs::path& file, const FileArray& array) {
  return GridFile(file).reader->GetCellDataArraySelection()->ArrayExists(array.name.c_str()) != 0;
}

NodeFields read_node_fields(const fs::path& cells, const fs::path& nodes,
                            const std::vector<FileArray>& arrays, const Vec3& origin) {
  NodeFields fields;
  const auto grid = read_grid(cells, {}), points = read_grid(nodes, {});
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    grid->GetCellPoints(c, corners);
    if (corners->GetNumberOfIds() != 4)
      throw IoError(fmt::format("{} has a cell of {} points, expected tetrahedra", cells.string(),
                                corners->GetNumberOfIds()));
    std::array<NodeIndex, 4> corner;
    for (int k = 0; k < 4; ++k) {
      if (corners->GetId(k) >= points->GetNumberOfPoints())
        throw IoError(fmt::format("{} has more points than {}", cells.string(), nodes.string()));
      corner[index_of(k)] = as<NodeIndex>(corners->GetId(k));
    }
    fields.tetrahedra.push_back(corner);
  }
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    std::array<double, 3> x{};
    points->GetPoint(i, x.data());
    for (std::size_t k = 0; k < 3; ++k) fields.position[k].push_back(x[k] - origin[as<int>(k)]);
  }
  for (const FileArray& wanted : arrays) {
    vtkDataArray* array = points->GetPointData()->GetArray(wanted.name.c_str());
    const int component = as<int>(wanted.component);
    if (!array || component >= array->GetNumberOfComponents())
      throw IoError(fmt::format("{} has not all of the field '{}'", nodes.string(), wanted.name));
    Field& values = fields.values.emplace_back();
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
      values.push_back(array->GetComponent(i, component));
  }
  return fields;
}

bool has_node_field(const fs::path& file, const FileArray& array) {
  return GridFile(file).reader->GetPointDataArraySelection()->ArrayExists(array.name.c_str()) != 0;
}

Vec2 read_tool_displacement(const fs::path& file) {
  const auto grid = read_grid(file, {});
  vtkDataArray* array = grid->GetPointData()->GetArray(vertex_displacement);
  if (!array || array->GetNumberOfTuples() == 0 || array->GetNumberOfComponents() != 3)
    throw IoError(fmt::format("{} has no field '{}'", file.string(), vertex_displacement));
  return {array->GetComponent(0, 0), array->GetComponent(0, 1)};
}

} // namespace cnem::results
