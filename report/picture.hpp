#pragma once
// Raster pictures of a run, drawn in memory: cells coloured by a field, tools, colour bar, scale bar.
#include "core/geometry/curve.hpp"
#include "core/operators/discretisation.hpp"
#include "report/palette_png.hpp"
#include "results/shown_units.hpp"
#include "results/vtk_reader.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cnem::report {

struct PictureWindow {
  Vec2 low{0, 0}, high{0, 0}; ///< m

  bool operator==(const PictureWindow&) const = default;
};
/// The least window that holds both.
PictureWindow joined(const PictureWindow& one, const PictureWindow& other);

/// Where a body goes on as its image: the line through `at`, along x or y.
struct SymmetryLine {
  Vec2 at{0, 0};     ///< m
  Vec2 normal{1, 0}; ///< of length 1, out of the body
};

/// A rigid tool: a closed counter-clockwise curve in its initial place, moved by `displacement` (m).
struct PictureTool {
  const Curve* curve = nullptr;
  Vec2 displacement{0, 0};
  std::string name;
  std::vector<SymmetryLine> kept{}; ///< drawn on that side of these lines which normals come from
};

/// What is on the side of a plane that its normal comes from is drawn.
struct KeptSide {
  Vec3 at{0, 0, 0}, normal{1, 0, 0}; ///< m; –, out of the body
};

/// Faces in space that no field colours: tools.
struct SolidFaces {
  std::vector<std::array<Vec3, 3>> corner; ///< m: to the right, upwards, towards the eye
  std::vector<float> darkness;             ///< [face] 0 to 1
};

class CellRasters;

struct Picture {
  const CellGeometry<2>* cells = nullptr;
  std::array<std::span<const double>, 2> position; ///< [component][node] m, present positions
  std::span<const double> value;                   ///< [cell], SI
  std::span<const float> darkness;                 ///< [cell] of surfaces under light, 0 to 1; empty: flat
  std::span<const double> depth;      ///< [vertex] m, towards the eye; empty: cells do not hide others
  const SolidFaces* solids = nullptr; ///< among cells with a depth; null: none
  std::string label;                  ///< "equivalent plastic strain"
  results::DisplayUnit unit;          ///< of the values shown
  ColourMap map = ColourMap::strain;
  std::optional<ColourRange> range; ///< SI; by default that of the values
  std::optional<double> percentile; ///< % of the values in the range, to be stated
  CellRasters* rasters = nullptr;   ///< shared by pictures of the same cells and positions; null: by none
  std::vector<PictureTool> tools;
  const results::CellFields* warm_tools = nullptr; ///< drawn with their first values; null: none
  std::vector<SymmetryLine> symmetry;              ///< drawn dash-dotted
  std::optional<PictureWindow> window;             ///< part shown; by default the whole body with a margin
  std::optional<bool> edges; ///< outlines of cells; by default where cells are large enough to be seen
  std::string title;         ///< upper left: the case
  double time = 0.0;         ///< s, shown upper right
  int width = 1400;          ///< px; the height follows from the window
};

/// Label, unit and colours of the picture of a field, in the unit chosen for its kind.
void show_field(Picture& picture, const Shown& field, const results::ShownUnits& units);
/// What its colours span unless a range is given.
ColourRange usual_range(ColourMap map, std::span<const double> values);

/// Where things are in the finished picture, px from the upper left corner.
struct PictureLayout {
  int width = 0, height = 0;
  double plot_left = 0, plot_top = 0, plot_width = 0, plot_height = 0;
  double scale = 1.0; ///< px per m
  Vec2 origin{0, 0};  ///< m, at the lower left corner of the plot

  bool operator==(const PictureLayout&) const = default;
  Vec2 pixel(const Vec2& x) const {
    return {plot_left + (x.x() - origin.x()) * scale, plot_top + plot_height - (x.y() - origin.y()) * scale};
  }
};
PictureLayout layout_picture(const Picture& picture);
/// What a picture without a window shows: the body with a narrow margin, a wider one where a tool stands.
PictureWindow whole_window(const Picture& picture);

/// The picture in the colours of its palette. Throws InputError when arrays do not fit each other.
PaletteImage draw(const Picture& picture);
/// The same as a PNG file in memory.
std::string draw_png(const Picture& picture);

} // namespace cnem::report
