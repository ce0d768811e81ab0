#pragma once
// What cells cover of a picture, whatever field it shows: pictures of several fields at one time share it.
#include "report/picture.hpp"

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace cnem::report {

/// Each list is [y · layout.width + x] of the picture.
struct CellRaster {
  std::vector<std::int32_t> cell; ///< the cell at a pixel, after them the face of a solid; −1: none
  std::vector<std::uint8_t>
      lines;                     ///< how much lines between cells cover of it, of 255; empty: there are none
  std::vector<std::uint8_t> rim; ///< the same of the rim of the body
};

/// vertices [vertex of the cells] m, at present; `line` px wide between cells, 0: none. Cells without area on
/// the picture, beyond it, or with vertices that are not finite are left out. Throws IoError.
CellRaster rasterise(const PictureLayout& layout, const CellGeometry<2>& cells,
                     const std::vector<Vec2>& vertices, double line);

/// The same where cells and solids hide each other. depth: [vertex] m, towards the eye. The rim goes round
/// what stands before something else, too.
CellRaster rasterise(const PictureLayout& layout, const CellGeometry<2>& cells,
                     const std::vector<Vec2>& vertices, std::span<const double> depth,
                     const SolidFaces* solids);

/// The rasters of the same cells with the same vertices, each made when it is asked for first; by any thread.
class CellRasters {
public:
  std::shared_ptr<const CellRaster> of(const PictureLayout& layout, const Picture& picture,
                                       const std::vector<Vec2>& vertices, double line);

private:
  struct Made {
    PictureLayout layout;
    double line;
    std::shared_ptr<const CellRaster> raster;
  };
  std::mutex mutex_;
  std::vector<Made> made_;
};

} // namespace cnem::report
