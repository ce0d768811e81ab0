#include "results/vtk_reader.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "results/output_folder.hpp"

#include <charconv>
#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
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
  for (int k = 0; k + 1 < collection->GetNumberOfNestedElements(); k += 2) {
    const std::string time = attribute(k, "timestep");
    FieldFiles frame{0.0, attribute(k, "file"), attribute(k + 1, "file")};
    const char* end = time.data() + time.size();
    if (std::from_chars(time.data(), end, frame.time).ptr != end || time.empty())
      throw IoError(fmt::format("{}: found the time '{}', expected a number", path.string(), time));
    series.push_back(std::move(frame));
  }
  return series;
}

CellFields read_cell_fields(const fs::path& file, const std::vector<std::string>& names, const Vec2& origin) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!fs::exists(file) || !reader->CanReadFile(file.c_str()))
    throw IoError(fmt::format("cannot read {}: it is no file of fields", file.string()));
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  if (grid.GetNumberOfCells() == 0) throw IoError(fmt::format("{} has no cells", file.string()));

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
  for (const std::string& name : names) {
    vtkDataArray* array = grid.GetCellData()->GetArray(name.c_str());
    if (!array) throw IoError(fmt::format("{} has no field '{}'", file.string(), name));
    Field& values = frame.values.emplace_back();
    for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) values.push_back(array->GetTuple1(c));
  }
  return frame;
}

} // namespace cnem::results
