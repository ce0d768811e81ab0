#include "io/vtk_writer.hpp"

#include "core/error.hpp"
#include "io/output_folder.hpp"
#include "io/vtu_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>

namespace cnem::io {
namespace fs = std::filesystem;
namespace {

constexpr std::uint8_t vertex_cell = 1, polygon_cell = 7; // VTK_VERTEX, VTK_POLYGON

void check_length(const std::string& name, std::size_t length, std::size_t expected) {
  if (length != expected)
    throw InputError(fmt::format("output field \"{}\" has {} values, expected {}", name, length, expected));
}

// The two grids of a frame. What is not in the frame itself is kept here until it is compressed.
class Grids {
public:
  explicit Grids(const FieldFrame& frame) {
    const CellGeometry<2>& cells = *frame.cells;
    const std::size_t nodes = frame.position[0].size(),
                      polygons = cells.begin.empty() ? 0 : cells.begin.size() - 1;
    for (const Vec2& v : moved_vertices(cells, frame.position)) place(cell_points_, v);
    for (std::size_t i = 0; i < nodes; ++i) place(node_points_, {frame.position[0][i], frame.position[1][i]});
    for (std::size_t i = 0; i < nodes; ++i) node_index_.push_back(static_cast<std::int32_t>(i));
    for (std::size_t i = 0; i < nodes; ++i) node_end_.push_back(static_cast<std::int32_t>(i + 1));
    connectivity_.assign(cells.index.begin(), cells.index.end());
    if (polygons > 0) cell_end_.assign(cells.begin.begin() + 1, cells.begin.end());
    cell_type_.assign(polygons, polygon_cell);
    node_type_.assign(nodes, vertex_cell);

    polygons_ = {frame.time, cell_points_.size() / 3, polygons, points(cell_points_), {}, {}, {}, {}, {}};
    polygons_.connectivity = integers("connectivity", connectivity_);
    polygons_.offsets = integers("offsets", cell_end_);
    polygons_.types = types(cell_type_);
    polygons_.cell_data = data(frame.cell_scalars, frame.cell_vectors, polygons);
    vertices_ = {frame.time, nodes, nodes, points(node_points_), {}, {}, {}, {}, {}};
    vertices_.connectivity = integers("connectivity", node_index_);
    vertices_.offsets = integers("offsets", node_end_);
    vertices_.types = types(node_type_);
    vertices_.point_data = data(frame.node_scalars, frame.node_vectors, nodes);
    arrays_.compress();
  }

  std::string polygons() const { return vtu_text(polygons_, arrays_); }
  std::string vertices() const { return vtu_text(vertices_, arrays_); }

private:
  static void place(std::vector<double>& points, const Vec2& x) {
    points.insert(points.end(), {x.x(), x.y(), 0.0});
  }
  VtuEntry points(const std::vector<double>& x) {
    return {"Points", "Float64", 3, arrays_.add(std::span(x))};
  }
  VtuEntry integers(const char* name, const std::vector<std::int32_t>& list) {
    return {name, "Int32", 1, arrays_.add(std::span(list))};
  }
  VtuEntry types(const std::vector<std::uint8_t>& list) {
    return {"types", "UInt8", 1, arrays_.add(std::span(list))};
  }
  std::vector<VtuEntry> data(const std::vector<ScalarField>& scalars, const std::vector<VectorField>& vectors,
                             std::size_t count) {
    std::vector<VtuEntry> entries;
    for (const ScalarField& field : scalars) {
      check_length(field.name, field.values.size(), count);
      entries.push_back({field.name, "Float64", 1, arrays_.add(field.values)});
    }
    for (const VectorField& field : vectors) {
      std::vector<double>& values = vectors_.emplace_back(3 * count, 0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        if (field.component[k].empty()) continue;
        check_length(field.name, field.component[k].size(), count);
        for (std::size_t i = 0; i < count; ++i) values[3 * i + k] = field.component[k][i];
      }
      entries.push_back({field.name, "Float64", 3, arrays_.add(std::span<const double>(values))});
    }
    return entries;
  }

  VtuArrays arrays_;
  VtuGrid polygons_, vertices_;
  std::vector<double> cell_points_, node_points_;
  std::vector<std::int32_t> connectivity_, cell_end_, node_index_, node_end_;
  std::vector<std::uint8_t> cell_type_, node_type_;
  std::deque<std::vector<double>> vectors_;
};

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
  write_atomically(folder_ / files::fields, collection());
}

FieldWriter FieldWriter::resume(fs::path folder, double time) {
  const fs::path path = folder / files::fields;
  const std::string text = read_file(path);
  FieldWriter writer;
  writer.folder_ = std::move(folder);
  std::size_t at = 0;
  const auto attribute = [&](std::string_view name) {
    const std::string key = fmt::format(" {}=\"", name);
    const std::size_t begin = text.find(key, at), end = text.find('"', begin + key.size());
    if (begin == std::string::npos || end == std::string::npos || begin > text.find('\n', at))
      throw IoError(fmt::format("{}: a DataSet without \"{}\"", path.string(), name));
    return text.substr(begin + key.size(), end - begin - key.size());
  };
  const auto next = [&] { return at = text.find("<DataSet", at); };
  if (text.find("</Collection>") == std::string::npos)
    throw IoError(fmt::format("{} is not a collection of VTK files", path.string()));
  while (next() != std::string::npos) {
    Entry entry{0.0, attribute("file"), {}};
    const std::string stamp = attribute("timestep");
    const auto [end, error] = std::from_chars(stamp.data(), stamp.data() + stamp.size(), entry.time);
    if (error != std::errc() || end != stamp.data() + stamp.size())
      throw IoError(fmt::format("{}: \"{}\" is no time", path.string(), stamp));
    ++at;
    if (next() == std::string::npos) throw IoError(fmt::format("{}: cells without nodes", path.string()));
    entry.nodes = attribute("file");
    ++at;
    if (entry.time <= time)
      writer.entries_.push_back(std::move(entry));
    else
      for (const std::string& file : {entry.cells, entry.nodes}) fs::remove(writer.folder_ / file);
  }
  write_atomically(writer.folder_ / files::fields, writer.collection());
  return writer;
}

void FieldWriter::write(FileQueue& queue, const FieldFrame& frame) {
  const auto name = [&](const char* part) {
    return fmt::format("{}/{}_{:05}.vtu", files::fields_folder, part, entries_.size());
  };
  Entry entry{frame.time, name("cells"), name("nodes")};
  const Grids grids(frame);
  queue.put(folder_ / entry.cells, grids.polygons());
  queue.put(folder_ / entry.nodes, grids.vertices());
  entries_.push_back(std::move(entry));
  queue.put(folder_ / files::fields, collection());
}

std::string FieldWriter::collection() const {
  std::string xml = "<?xml version=\"1.0\"?>\n"
                    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
                    "  <Collection>\n";
  for (const Entry& entry : entries_)
    for (const auto& [part, name, file] :
         {std::tuple(0, "cells", &entry.cells), std::tuple(1, "nodes", &entry.nodes)})
      xml += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                         entry.time, part, name, *file);
  return xml + "  </Collection>\n</VTKFile>\n";
}

} // namespace cnem::io
