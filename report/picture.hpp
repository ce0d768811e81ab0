#pragma once
// Raster pictures of a run, drawn in memory: cells coloured by a field, tools, colour bar, scale bar.
#include "core/geometry/curve.hpp"
#include "core/operators/discretisation.hpp"
#include "report/colour_map.hpp"
#include "results/vtk_writer.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cnem::report {

struct PictureWindow {
  Vec2 low{0, 0}, high{0, 0}; ///< m
};

/// A rigid tool: a closed counter-clockwise curve in its initial place, moved by `displacement` (m).
struct PictureTool {
  const Curve* curve = nullptr;
  Vec2 displacement{0, 0};
  std::string name;
};

class CellRasters;

struct Picture {
  const CellGeometry<2>* cells = nullptr;
  std::array<std::span<const double>, 2> position; ///< [component][node] m, present positions
  std::span<const double> value;                   ///< [cell], SI
  std::string label;                               ///< "equivalent plastic strain"
  std::string unit;                                ///< unit shown, "" for none
  double unit_factor = 1.0;                        ///< value in SI = factor × value in `unit` (MPa: 1e6)
  ColourMap map = ColourMap::strain;
  std::optional<ColourRange> range; ///< SI; by default that of the values
  CellRasters* rasters = nullptr;   ///< shared by pictures of the same cells and positions; null: by none
  std::vector<PictureTool> tools;
  std::shared_ptr<const results::FieldFrame<2>>
      warm_tools;                      ///< drawn with their first scalar of cells; null: none
  std::optional<PictureWindow> window; ///< part shown; by default the whole body with a margin
  std::optional<bool> edges; ///< outlines of cells; by default where cells are large enough to be seen
  std::string title;         ///< upper left: the case
  double time = 0.0;         ///< s, shown upper right
  int width = 1400;          ///< px; the height follows from the window
};

/// Label, unit and colours of the picture of a field.
void show_field(Picture& picture, const Shown& field);
/// What its colours span unless a range is given: all values, and where zero is in the middle, the central
/// 99.9% of the magnitudes.
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

/// The picture as a PNG file in memory. Throws InputError when arrays do not fit each other.
std::string draw_png(const Picture& picture);

} // namespace cnem::report
