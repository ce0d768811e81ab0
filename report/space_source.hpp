#pragma once
// What the pictures of one time of a body in space are drawn from, as a run has it and as its files have it:
// the same bits.
#include "input/case.hpp"
#include "report/body_view.hpp"
#include "report/cell_raster.hpp"
#include "report/picture_album.hpp"
#include "results/snapshot.hpp"

#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace cnem::report {

/// A body and its tools at one time.
struct SpaceSource {
  double time = 0.0;                                  ///< s
  std::vector<std::array<NodeIndex, 4>> tetrahedra{}; ///< right-handed
  Fields<3> position{};                               ///< [component][node] m, from the origin of the case
  std::vector<std::string> names{};                   ///< of the fields
  std::vector<Field> values{};                        ///< [name][node]
  std::vector<Vec3> tools{};                          ///< [tool] m, how far each has moved
  std::vector<KeptSide> sides{};                      ///< as AlbumEntry has them
};
SpaceSource space_source(const input::Case& input, const results::Snapshot<3>& shot,
                         const std::vector<std::string>& names);
/// entry: of the same time. Throws IoError.
SpaceSource space_source(const input::Case& input, const std::filesystem::path& folder,
                         const results::FieldFiles& files, const std::vector<std::string>& names,
                         const AlbumEntry& entry);

/// What one picture shows, whatever the field: pictures of all fields share it and refer to it.
struct SpaceView {
  std::string section; ///< its name; "" of the surface
  Scene scene;
  SolidFaces solids;
  std::deque<Curve> outlines;     ///< of tools in the section
  std::vector<PictureTool> tools; ///< these
  std::vector<Field> values;      ///< [name][polygon]
  CellRasters rasters;
};

/// The surfaces of all tools of a case at t = 0 (input/tool_surface.hpp).
std::vector<TriangleSurface> tool_surfaces(const input::Case& input);

/// The surface, and the sections of the case that go through the body. tools: all of the case, at t = 0.
std::vector<std::shared_ptr<SpaceView>> space_views(const input::Case& input, const SpaceSource& source,
                                                    const std::vector<TriangleSurface>& tools);

/// The picture of one of the source's fields.
Picture picture_of(const input::Case& input, const SpaceSource& source, SpaceView& view, std::size_t field);

} // namespace cnem::report
