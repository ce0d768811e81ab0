#include "input/drawings/drawing.hpp"

#include "core/error.hpp"
#include "input/schema/document.hpp"
#include "input/schema/nearest.hpp"
#include "input/schema/units.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <vector>

namespace cnem::input {
namespace {

namespace fs = std::filesystem;

/// Names of files beside one that is not there.
std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code status;
  for (fs::directory_iterator at(folder, status), end; !status && at != end; at.increment(status))
    if (names.size() < 1000) names.push_back(at->path().filename().string());
  return names;
}

std::string bytes_of(const std::string& path) {
  constexpr std::size_t largest = std::size_t{1} << 28;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw IoError(fmt::format("{}: cannot be read, expected a drawing", path));
  std::error_code status;
  if (fs::file_size(path, status) > largest)
    throw DrawingError(fmt::format("{}: found more than {} bytes, expected a drawing", path, largest));
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

} // namespace

DrawingError::DrawingError(const std::string& file, std::size_t line, const std::string& message)
    : std::runtime_error(fmt::format("{}:{}: {}", file, line, message)) {}

void DrawnFile::add_layer(const std::string& name) {
  if (std::find(layers.begin(), layers.end(), name) == layers.end()) layers.push_back(name);
}

void DrawnFile::add(DrawnCurve curve) {
  constexpr double largest = 1e15; // far from where squares and quotients are no numbers
  const CurvePiece& piece = curve.piece;
  for (const Vec2& x : {piece.from, piece.to, piece.centre, Vec2(piece.radius, 0.0)})
    if (!((x.array().abs() <= largest).all()))
      throw DrawingError(file, curve.line,
                         fmt::format("found a curve from ({:g}, {:g}) to ({:g}, {:g}), expected coordinates "
                                     "and radii of at most {:g}",
                                     piece.from.x(), piece.from.y(), piece.to.x(), piece.to.y(), largest));
  curves.push_back(std::move(curve));
}

DrawingUnit drawing_unit(const std::string& name) {
  static const std::map<std::string, double> in_millimetres{
      {"in", 25.4}, {"ft", 304.8}, {"mi", 1609344.0}, {"mil", 0.0254}, {"uin", 25.4e-6}};
  if (const auto known = in_millimetres.find(name); known != in_millimetres.end())
    return {name, "mm", known->second, known->second * 1e-3};
  try {
    if (const Unit unit = parse_unit(name); unit.dimension == dimension::length)
      return {name, name, 1.0, unit.to_si(1.0)};
  } catch (const UnitError&) {} // said below
  throw DrawingError(fmt::format("found {}, expected a unit of length such as \"mm\" or \"in\"",
                                 toml_quoted(shortened(name))));
}

Vec2 on_circle(const Vec2& centre, double radius, double degrees) {
  const double turn = std::fmod(std::fmod(degrees, 360.0) + 360.0, 360.0);
  const double angle = turn * std::numbers::pi / 180.0;
  const bool axis = std::fmod(turn, 90.0) == 0.0;
  const double c = axis ? std::round(std::cos(angle)) : std::cos(angle);
  const double s = axis ? std::round(std::sin(angle)) : std::sin(angle);
  return centre + radius * Vec2(c, s);
}

DrawnFile read_drawing(const std::string& path) {
  const fs::path file = path;
  std::error_code status;
  if (!fs::is_regular_file(file, status))
    throw DrawingError(
        fmt::format("found no file {}, expected a drawing{}", path,
                    did_you_mean(file.filename().string(),
                                 files_in(file.parent_path().empty() ? "." : file.parent_path()))));
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto reader = ending == ".dxf"   ? read_dxf
                      : ending == ".geo" ? read_geo
                      : ending == ".msh" ? read_msh
                                         : nullptr;
  if (!reader)
    throw DrawingError(
        fmt::format("found the file {}, expected a drawing whose name ends in .dxf, .geo or .msh", path));
  return reader(bytes_of(path), path);
}

} // namespace cnem::input
