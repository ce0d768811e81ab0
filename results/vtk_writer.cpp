#include "results/vtk_writer.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "results/output_folder.hpp"

#include <fmt/format.h>

#include <SMP/Common/vtkSMPToolsAPI.h> // vtkSMPTools.h of VTK 9.1 is no C++20
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cassert>
#include <deque>
#include <mutex>
#include <string>
#include <system_error>

namespace cnem::results {
namespace fs = std::filesystem;
namespace {

void add_time(vtkUnstructuredGrid& grid, double time) {
  vtkNew<vtkDoubleArray> value;
  value->SetName("TimeValue"); // the name ParaView looks for
  value->InsertNextValue(time);
  grid.GetFieldData()->AddArray(value);
}

void check_lengths(const std::vector<ScalarField>& scalars, const std::vector<VectorField>& vectors,
                   std::size_t expected) {
  const auto check = [&](const std::string& name, std::size_t length) {
    if (length != expected)
      throw InputError(fmt::format("output field \"{}\" has {} values, expected {}", name, length, expected));
  };
  for (const ScalarField& field : scalars) check(field.name, field.values.size());
  for (const VectorField& field : vectors)
    for (const std::span<const double>& component : field.component)
      if (!component.empty()) check(field.name, component.size());
}

template<int dim> std::size_t cell_count(const FieldFrame<dim>& frame) {
  return frame.cells->begin.empty() ? 0 : frame.cells->begin.size() - 1;
}

template<int dim> std::size_t bytes_of(const FieldFrame<dim>& frame) {
  const std::size_t nodes = frame.position[0].size(), cells = cell_count(frame);
  const CellGeometry<dim>& geometry = *frame.cells;
  return sizeof(double) * (nodes * (dim + frame.node_scalars.size() + 3 * frame.node_vectors.size()) +
                           cells * (frame.cell_scalars.size() + 4 * frame.cell_vectors.size()) +
                           dim * geometry.vertex.size() + 2 * geometry.vertex_weight.size());
}

void add_fields(vtkFieldData& to, vtkIdType count, const std::vector<ScalarField>& scalars,
                const std::vector<VectorField>& vectors) {
  for (const ScalarField& field : scalars) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(field.name.c_str());
    array->SetArray(const_cast<double*>(field.values.data()), count,
                    1); // 1: VTK reads it, and does not own it
    to.AddArray(array);
  }
  for (const VectorField& field : vectors) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(field.name.c_str());
    const int components = as<int>(field.component.size());
    array->SetNumberOfComponents(components);
    for (int k = 0; k < as<int>(field.component_names.size()); ++k)
      array->SetComponentName(k, field.component_names[index_of(k)].c_str());
    array->SetNumberOfTuples(count);
    array->Fill(0.0);
    for (int k = 0; k < components; ++k) {
      const std::span<const double> component = field.component[index_of(k)];
      if (component.empty()) continue;
      for (vtkIdType i = 0; i < count; ++i) array->SetTypedComponent(i, k, component[index_of(i)]);
    }
    to.AddArray(array);
  }
}

// The grid as the text of a .vtu file.
std::string text_of(vtkUnstructuredGrid& grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib(); // of VTK's the one that others read
  writer->SetCompressionLevel(1);    // half the time of the usual one, for as large files
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn(); // the file itself is written where a full disk is noticed
  if (writer->Write() == 0) throw IoError("VTK cannot write a grid of fields");
  return writer->GetOutputString();
}

template<int dim> void set_point(vtkPoints& points, vtkIdType at, const Vec3& origin, const Vec<dim>& x) {
  points.SetPoint(at, origin.x() + x.x(), origin.y() + x.y(), dim == 3 ? origin.z() + x[dim - 1] : 0.0);
}

template<int dim> std::string cells_text(const FieldFrame<dim>& frame) {
  const CellGeometry<dim>& cells = *frame.cells;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const std::vector<Vec<dim>> vertices = moved_vertices<dim>(cells, frame.position);
  points->SetNumberOfPoints(static_cast<vtkIdType>(vertices.size()));
  for (std::size_t v = 0; v < vertices.size(); ++v)
    set_point<dim>(*points, static_cast<vtkIdType>(v), frame.origin, vertices[v]);

  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  const auto count = static_cast<vtkIdType>(cell_count(frame));
  grid->AllocateEstimate(count, 7);
  std::vector<vtkIdType> polygon;
  for (std::size_t c = 0; c < index_of(count); ++c) {
    polygon.assign(cells.index.begin() + cells.begin[c], cells.index.begin() + cells.begin[c + 1]);
    grid->InsertNextCell(dim == 2 ? VTK_POLYGON : VTK_TETRA, static_cast<vtkIdType>(polygon.size()),
                         polygon.data());
  }
  add_fields(*grid->GetCellData(), count, frame.cell_scalars, frame.cell_vectors);
  if (cells.between_points)
    add_fields(*grid->GetPointData(), static_cast<vtkIdType>(vertices.size()), frame.node_scalars,
               frame.node_vectors);
  if (!frame.initial[0].empty()) {
    const std::vector<Vec<dim>> before = moved_vertices<dim>(cells, frame.initial);
    std::array<Field, dim> displacement;
    VectorField field{vertex_displacement, {{}, {}, {}}};
    for (std::size_t k = 0; k < dim; ++k) {
      for (std::size_t v = 0; v < before.size(); ++v)
        displacement[k].push_back(vertices[v][as<int>(k)] - before[v][as<int>(k)]);
      field.component[k] = displacement[k];
    }
    add_fields(*grid->GetPointData(), static_cast<vtkIdType>(before.size()), {}, {field});
  }
  add_time(*grid, frame.time);
  return text_of(*grid);
}

template<int dim> std::string nodes_text(const FieldFrame<dim>& frame) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto count = static_cast<vtkIdType>(frame.position[0].size());
  points->SetNumberOfPoints(count);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->AllocateEstimate(count, 1);
  for (vtkIdType i = 0; i < count; ++i) {
    const auto at = index_of(i);
    Vec<dim> x;
    for (int k = 0; k < dim; ++k) x[k] = frame.position[index_of(k)][at];
    set_point<dim>(*points, i, frame.origin, x);
    grid->InsertNextCell(VTK_VERTEX, 1, &i);
  }
  add_fields(*grid->GetPointData(), count, frame.node_scalars, frame.node_vectors);
  add_time(*grid, frame.time);
  return text_of(*grid);
}

/// Values of some nodes, with their names.
struct Chosen {
  std::deque<Field> values;
  std::vector<ScalarField> scalars;
  std::vector<VectorField> vectors;
};
Chosen chosen(const FieldFrame<3>& frame, const std::vector<std::size_t>& nodes) {
  Chosen of;
  const auto pick = [&](std::span<const double> all) -> std::span<const double> {
    if (all.empty()) return {};
    Field& values = of.values.emplace_back();
    for (const std::size_t i : nodes) values.push_back(all[i]);
    return values;
  };
  for (const ScalarField& field : frame.node_scalars) of.scalars.push_back({field.name, pick(field.values)});
  for (const VectorField& field : frame.node_vectors) {
    VectorField& to = of.vectors.emplace_back(VectorField{field.name, {}, field.component_names});
    for (const auto& component : field.component) to.component.push_back(pick(component));
  }
  return of;
}

std::string surface_text(const FieldFrame<3>& frame) {
  std::vector<std::size_t> nodes;
  for (const auto& facet : frame.surface)
    for (const NodeIndex i : facet) nodes.push_back(index_of(i));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    set_point<3>(*points, static_cast<vtkIdType>(k), frame.origin,
                 {frame.position[0][nodes[k]], frame.position[1][nodes[k]], frame.position[2][nodes[k]]});
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->AllocateEstimate(static_cast<vtkIdType>(frame.surface.size()), 3);
  for (const auto& facet : frame.surface) {
    std::array<vtkIdType, 3> corner{};
    for (std::size_t a = 0; a < 3; ++a)
      corner[a] = std::lower_bound(nodes.begin(), nodes.end(), index_of(facet[a])) - nodes.begin();
    grid->InsertNextCell(VTK_TRIANGLE, 3, corner.data());
  }
  const Chosen fields = chosen(frame, nodes);
  add_fields(*grid->GetPointData(), static_cast<vtkIdType>(nodes.size()), fields.scalars, fields.vectors);
  add_time(*grid, frame.time);
  return text_of(*grid);
}

std::string polyhedra_text(const FieldFrame<3>& frame) {
  const Polyhedra& cells = *frame.polyhedra;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(cells.point.size()));
  for (std::size_t k = 0; k < cells.point.size(); ++k)
    set_point<3>(*points, static_cast<vtkIdType>(k), frame.origin, cells.point[k]);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  std::vector<vtkIdType> faces, corner;
  for (const std::vector<std::int32_t>& cell : cells.cell) {
    faces.clear();
    corner.clear();
    for (const std::int32_t f : cell) {
      const auto face = cells.face(index_of(f < 0 ? -1 - f : f));
      faces.push_back(static_cast<vtkIdType>(face.size()));
      if (f < 0)
        faces.insert(faces.end(), face.rbegin(), face.rend());
      else
        faces.insert(faces.end(), face.begin(), face.end());
      corner.insert(corner.end(), face.begin(), face.end());
    }
    std::sort(corner.begin(), corner.end());
    corner.erase(std::unique(corner.begin(), corner.end()), corner.end());
    grid->InsertNextCell(VTK_POLYHEDRON, static_cast<vtkIdType>(corner.size()), corner.data(),
                         static_cast<vtkIdType>(cell.size()), faces.data());
  }
  add_fields(*grid->GetCellData(), static_cast<vtkIdType>(cells.cell.size()), frame.node_scalars,
             frame.node_vectors);
  add_time(*grid, frame.time);
  return text_of(*grid);
}

std::string outline_text(const ToolOutline& tool, const Vec3& origin, double time) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<vtkIdType> polygon;
  for (const Vec2& corner : tool.corners) {
    const Vec2 x = corner + tool.displacement;
    polygon.push_back(points->InsertNextPoint(origin.x() + x.x(), origin.y() + x.y(), 0.0));
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->InsertNextCell(VTK_POLYGON, as<vtkIdType>(polygon.size()), polygon.data());
  std::array<Field, 4> motion;
  for (std::size_t k = 0; k < 2; ++k) {
    motion[k].assign(polygon.size(), tool.displacement[as<int>(k)]);
    motion[2 + k].assign(polygon.size(), tool.velocity[as<int>(k)]);
  }
  add_fields(
      *grid->GetPointData(), as<vtkIdType>(polygon.size()), {},
      {{vertex_displacement, {motion[0], motion[1], {}}}, {"velocity [m/s]", {motion[2], motion[3], {}}}});
  add_time(*grid, time);
  return text_of(*grid);
}

// Makers run side by side; what VTK sets up once per process does not.
void set_up_vtk() {
  static std::once_flag once;
  std::call_once(once, [] {
    vtk::detail::smp::vtkSMPToolsAPI::GetInstance().SetBackend(
        "Sequential"); // no threads of its own beside those of a run
    vtkNew<vtkUnstructuredGrid> grid;
    text_of(*grid);
  });
}

} // namespace

FieldWriter::FieldWriter(fs::path folder, Series series) : folder_(std::move(folder)), series_(series) {
  std::error_code error;
  fs::create_directories(folder_ / files::fields_folder, error);
  if (error)
    throw IoError(
        fmt::format("cannot create {}: {}", (folder_ / files::fields_folder).string(), error.message()));
  write_atomically(folder_ / series_.list, collection());
}

FieldWriter FieldWriter::resume(fs::path folder, double time, Series series) {
  FieldWriter writer;
  writer.series_ = series;
  for (FieldFiles& frame : read_field_series(folder, series.list)) {
    if (frame.time <= time)
      writer.entries_.push_back(std::move(frame));
    else {
      for (const std::string& file : {frame.cells, frame.nodes}) fs::remove(folder / file);
      for (const PartFile& part : frame.parts) fs::remove(folder / part.file);
    }
  }
  writer.folder_ = std::move(folder);
  write_atomically(writer.folder_ / series.list, writer.collection());
  return writer;
}

template<int dim> void FieldWriter::write(FileQueue& queue, std::shared_ptr<const FieldFrame<dim>> frame) {
  assert(!frame->cells->between_points || frame->cell_scalars.empty());
  check_lengths(frame->cell_scalars, frame->cell_vectors, cell_count(*frame));
  check_lengths(frame->node_scalars, frame->node_vectors, frame->position[0].size());
  set_up_vtk();
  const auto name = [&](const std::string& part) {
    return fmt::format("{}/{}{}_{:05}.vtu", files::fields_folder, series_.prefix, part, entries_.size());
  };
  FieldFiles entry{frame->time, name("cells"), name("nodes"), {}};
  const std::size_t bytes = bytes_of(*frame) / 2; // kept by both
  queue.put(
      folder_ / entry.cells, [frame] { return cells_text(*frame); }, bytes);
  queue.put(
      folder_ / entry.nodes, [frame] { return nodes_text(*frame); }, bytes);
  if constexpr (dim == 2)
    for (const ToolOutline& tool : frame->tools) {
      entry.parts.push_back({tool.name, name("outline_" + tool.name)});
      queue.put(
          folder_ / entry.parts.back().file,
          [tool, origin = frame->origin, time = frame->time] { return outline_text(tool, origin, time); },
          sizeof(Vec2) * tool.corners.size());
    }
  if constexpr (dim == 3) {
    const auto add = [&](const char* part, std::string (*text)(const FieldFrame<3>&), std::size_t size) {
      entry.parts.push_back({part, name(part)});
      queue.put(
          folder_ / entry.parts.back().file, [frame, text] { return text(*frame); }, size);
    };
    if (!frame->surface.empty()) add("surface", surface_text, bytes);
    if (frame->polyhedra)
      add("polyhedra", polyhedra_text,
          bytes + sizeof(std::int32_t) * 4 * frame->polyhedra->face_point.size());
  }
  entries_.push_back(std::move(entry));
  queue.put(folder_ / series_.list, collection());
}

template void FieldWriter::write(FileQueue& queue, std::shared_ptr<const FieldFrame<2>> frame);
template void FieldWriter::write(FileQueue& queue, std::shared_ptr<const FieldFrame<3>> frame);

std::string FieldWriter::collection() const {
  std::string xml = "<?xml version=\"1.0\"?>\n"
                    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
                    "  <Collection>\n";
  for (const FieldFiles& entry : entries_) {
    std::vector<PartFile> parts{{"cells", entry.cells}, {"nodes", entry.nodes}};
    parts.insert(parts.end(), entry.parts.begin(), entry.parts.end());
    for (std::size_t part = 0; part < parts.size(); ++part)
      xml += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                         entry.time, part, parts[part].name, parts[part].file);
  }
  return xml + "  </Collection>\n</VTKFile>\n";
}

} // namespace cnem::results
