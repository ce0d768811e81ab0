#include "io/vtk_writer.hpp"

#include "core/error.hpp"
#include "io/output_folder.hpp"

#include <fmt/format.h>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <tuple>

namespace cnem::io {
namespace fs = std::filesystem;
namespace {

void add_time(vtkUnstructuredGrid& grid, double time) {
  vtkNew<vtkDoubleArray> value;
  value->SetName("TimeValue"); // the name ParaView looks for
  value->InsertNextValue(time);
  grid.GetFieldData()->AddArray(value);
}

void check_length(const std::string& name, std::size_t length, vtkIdType expected) {
  if (length != static_cast<std::size_t>(expected))
    throw InputError(fmt::format("output field \"{}\" has {} values, expected {}", name, length, expected));
}

void add_fields(vtkFieldData& to, vtkIdType count, const std::vector<ScalarField>& scalars,
                const std::vector<VectorField>& vectors) {
  for (const ScalarField& field : scalars) {
    check_length(field.name, field.values.size(), count);
    vtkNew<vtkDoubleArray> array;
    array->SetName(field.name.c_str());
    array->SetNumberOfTuples(count);
    std::copy(field.values.begin(), field.values.end(), array->GetPointer(0));
    to.AddArray(array);
  }
  for (const VectorField& field : vectors) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(field.name.c_str());
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(count);
    array->Fill(0.0);
    for (int k = 0; k < 3; ++k) {
      const std::span<const double> component = field.component[static_cast<std::size_t>(k)];
      if (component.empty()) continue;
      check_length(field.name, component.size(), count);
      for (vtkIdType i = 0; i < count; ++i)
        array->SetTypedComponent(i, k, component[static_cast<std::size_t>(i)]);
    }
    to.AddArray(array);
  }
}

void write_grid(const fs::path& path, vtkUnstructuredGrid& grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4(); // much faster than zlib, for files a fifth larger
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn(); // the file itself is written where a full disk is noticed
  if (writer->Write() == 0) throw IoError(fmt::format("cannot write {}: VTK failed", path.string()));
  write_atomically(path, writer->GetOutputString());
}

void write_cells(const fs::path& path, const FieldFrame& frame) {
  const CellGeometry<2>& cells = *frame.cells;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const std::vector<Vec2> vertices = moved_vertices(cells, frame.position);
  points->SetNumberOfPoints(static_cast<vtkIdType>(vertices.size()));
  for (std::size_t v = 0; v < vertices.size(); ++v)
    points->SetPoint(static_cast<vtkIdType>(v), vertices[v].x(), vertices[v].y(), 0.0);

  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  const auto count = cells.begin.empty() ? 0 : static_cast<vtkIdType>(cells.begin.size()) - 1;
  grid->AllocateEstimate(count, 7);
  std::vector<vtkIdType> polygon;
  for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c) {
    polygon.assign(cells.index.begin() + cells.begin[c], cells.index.begin() + cells.begin[c + 1]);
    grid->InsertNextCell(VTK_POLYGON, static_cast<vtkIdType>(polygon.size()), polygon.data());
  }
  add_fields(*grid->GetCellData(), count, frame.cell_scalars, frame.cell_vectors);
  add_time(*grid, frame.time);
  write_grid(path, *grid);
}

void write_nodes(const fs::path& path, const FieldFrame& frame) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto count = static_cast<vtkIdType>(frame.position[0].size());
  points->SetNumberOfPoints(count);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->AllocateEstimate(count, 1);
  for (vtkIdType i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    points->SetPoint(i, frame.position[0][at], frame.position[1][at], 0.0);
    grid->InsertNextCell(VTK_VERTEX, 1, &i);
  }
  add_fields(*grid->GetPointData(), count, frame.node_scalars, frame.node_vectors);
  add_time(*grid, frame.time);
  write_grid(path, *grid);
}

} // namespace

std::vector<Vec2> moved_vertices(const CellGeometry<2>& cells,
                                 const std::array<std::span<const double>, 2>& position) {
  std::vector<Vec2> moved(cells.vertex.size(), Vec2::Zero());
  for (std::size_t v = 0; v < moved.size(); ++v)
    for (auto k = static_cast<std::size_t>(cells.vertex_begin[v]);
         k < static_cast<std::size_t>(cells.vertex_begin[v + 1]); ++k) {
      const auto node = static_cast<std::size_t>(cells.vertex_node[k]);
      moved[v] += cells.vertex_weight[k] * Vec2(position[0][node], position[1][node]);
    }
  return moved;
}

FieldWriter::FieldWriter(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_ / files::fields_folder, error);
  if (error)
    throw IoError(
        fmt::format("cannot create {}: {}", (folder_ / files::fields_folder).string(), error.message()));
  write_collection();
}

FieldWriter FieldWriter::resume(fs::path folder, double time) {
  const fs::path path = folder / files::fields;
  const std::string text = read_file(path);
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(text.c_str()));
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection) throw IoError(fmt::format("{} is not a collection of VTK files", path.string()));
  FieldWriter writer;
  writer.folder_ = std::move(folder);
  const auto attribute = [&](int element, const char* name) -> std::string {
    const char* value = collection->GetNestedElement(element)->GetAttribute(name);
    if (!value) throw IoError(fmt::format("{}: a DataSet without \"{}\"", path.string(), name));
    return value;
  };
  for (int k = 0; k + 1 < collection->GetNumberOfNestedElements(); k += 2) {
    Entry entry{std::stod(attribute(k, "timestep")), attribute(k, "file"), attribute(k + 1, "file")};
    if (entry.time <= time)
      writer.entries_.push_back(std::move(entry));
    else
      for (const std::string& file : {entry.cells, entry.nodes}) fs::remove(writer.folder_ / file);
  }
  writer.write_collection();
  return writer;
}

void FieldWriter::write(const FieldFrame& frame) {
  const auto name = [&](const char* part) {
    return fmt::format("{}/{}_{:05}.vtu", files::fields_folder, part, entries_.size());
  };
  Entry entry{frame.time, name("cells"), name("nodes")};
  write_cells(folder_ / entry.cells, frame);
  write_nodes(folder_ / entry.nodes, frame);
  entries_.push_back(std::move(entry));
  write_collection();
}

void FieldWriter::write_collection() const {
  std::string xml = "<?xml version=\"1.0\"?>\n"
                    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
                    "  <Collection>\n";
  for (const Entry& entry : entries_)
    for (const auto& [part, name, file] :
         {std::tuple(0, "cells", &entry.cells), std::tuple(1, "nodes", &entry.nodes)})
      xml += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                         entry.time, part, name, *file);
  xml += "  </Collection>\n</VTKFile>\n";
  write_atomically(folder_ / files::fields, xml);
}

} // namespace cnem::io
