#pragma once
// Cells painted pixel by pixel. Private to pictures.
#include "core/discretisation.hpp"
#include "io/colour_map.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cnem::io {

/// What part of a drawing is painted: 0x00RRGGBB, rows one `stride` after the other.
struct PixelArea {
  std::uint32_t* first = nullptr;
  int width = 0, height = 0;
  std::size_t stride = 0; ///< pixels
};

struct CellPaint {
  std::span<const double> value; ///< [cell], SI
  ColourMap map = ColourMap::strain;
  ColourRange range;     ///< SI
  double rim = 0.0;      ///< px: width of the dark line around the body
  double edge = 0.0;     ///< px: width of the lines between cells; 0: none
  double strength = 0.0; ///< how much darker than the cells these lines are, 0 to 1
};

/// Paints the cells over what is in the area. `pixel` [vertex] px from its upper left corner; cells with a
/// vertex that is not finite are left out. Nine samples a pixel, averaged: neighbours meet without seams.
void paint_cells(const PixelArea& area, const CellGeometry<2>& cells, const std::vector<Vec2>& pixel,
                 const CellPaint& paint);

} // namespace cnem::io
