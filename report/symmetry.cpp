#include "report/symmetry.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::report {
namespace {

bool on_one_side(const Curve& outline, const SymmetryLine& line) {
  const double tolerance = 1e-9 * outline.length();
  for (const Vec2& corner : outline.polygon())
    if (line.normal.dot(corner - line.at) > tolerance) return false;
  return true;
}

void add(std::vector<SymmetryLine>& lines, const SymmetryLine& line, const Curve& outline) {
  const bool parallel = std::any_of(lines.begin(), lines.end(), [&](const SymmetryLine& known) {
    return std::abs(known.normal.dot(line.normal)) > 0.5;
  });
  if (!parallel && on_one_side(outline, line)) lines.push_back(line);
}

} // namespace

std::vector<SymmetryLine> symmetry_lines(const input::Case& input) {
  std::vector<SymmetryLine> lines;
  const Curve& outline = input.domain.outer;
  if (input.analysis.kinematics == input::Analysis::Kinematics::axisymmetric)
    add(lines, {Vec2(-input.origin.x(), 0.0), Vec2(-1, 0)}, outline);
  for (const input::BoundaryCondition& condition : input.boundary) {
    if (!condition.symmetry) continue;
    for (const CurvePiece& piece : outline.pieces) {
      if (piece.is_arc() ||
          std::find(condition.pieces.begin(), condition.pieces.end(), piece.name) == condition.pieces.end())
        continue;
      const Vec2 along = piece.to - piece.from;
      if (along.x() != 0.0 && along.y() != 0.0) continue;
      const double length = along.norm();
      add(lines, {piece.from, Vec2(along.y() / length, -along.x() / length)}, outline);
    }
  }
  return lines;
}

void keep_side(results::CellFields& fields, const SymmetryLine& line) {
  for (Vec2& x : fields.cells.vertex) x -= std::max(0.0, line.normal.dot(x - line.at)) * line.normal;
  for (std::size_t v = 0; v < fields.cells.vertex.size(); ++v)
    for (std::size_t k = 0; k < 2; ++k) fields.position[k][v] = fields.cells.vertex[v][as<Eigen::Index>(k)];
}

void add_image(results::CellFields& fields, const SymmetryLine& line, const std::vector<double>& sign) {
  CellGeometry<2>& cells = fields.cells;
  const std::size_t vertices = cells.vertex.size(), count = cells.begin.size() - 1;
  double size = 0.0;
  for (const Vec2& x : cells.vertex)
    if (x.allFinite()) size = std::max(size, (x - line.at).norm());
  std::vector<std::int32_t> image(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const Vec2 x = cells.vertex[v];
    if (std::abs(line.normal.dot(x - line.at)) <= 1e-7 * size) {
      image[v] = as<std::int32_t>(v);
      continue;
    }
    image[v] = as<std::int32_t>(cells.vertex.size());
    cells.vertex.push_back(mirrored(x, line.at, line.normal));
    cells.vertex_node.push_back(as<NodeIndex>(image[v]));
    cells.vertex_weight.push_back(1.0);
    cells.vertex_begin.push_back(as<std::int32_t>(cells.vertex_weight.size()));
    for (std::size_t k = 0; k < 2; ++k) fields.position[k].push_back(cells.vertex.back()[as<int>(k)]);
  }
  for (std::size_t c = 0; c < count; ++c) {
    for (auto k = index_of(cells.begin[c + 1]); k > index_of(cells.begin[c]); --k)
      cells.index.push_back(image[index_of(cells.index[k - 1])]);
    cells.begin.push_back(as<std::int32_t>(cells.index.size()));
  }
  for (std::size_t f = 0; f < fields.values.size(); ++f)
    for (std::size_t c = 0; c < count; ++c) fields.values[f].push_back(sign[f] * fields.values[f][c]);
}

double image_sign(const FieldInfo<2>& field, const SymmetryLine& line) {
  if (field.part.label.empty()) return 1.0;
  const std::string& component = field.part.component_names[field.part.component]; // "XY", "Y", "2"
  const char across = line.normal.x() != 0.0 ? 'X' : 'Y';
  return std::count(component.begin(), component.end(), across) % 2 == 0 ? 1.0 : -1.0;
}

} // namespace cnem::report
