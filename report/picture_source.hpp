#pragma once
// What the pictures of one time are drawn from, as a run has it and as its files have it: the same bits.
#include "input/case.hpp"
#include "report/cell_raster.hpp"
#include "report/picture.hpp"
#include "results/snapshot.hpp"
#include "results/vtk_reader.hpp"

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cnem::report {

/// One time, with its image where the case asks for it. Pictures of it refer to it.
struct PictureSource {
  double time = 0.0;                             ///< s
  std::vector<std::string> names;                ///< of the fields
  results::CellFields fields;                    ///< of the body, values in the order of the names
  std::optional<results::CellFields> warm_tools; ///< temperatures of tools that conduct
  std::vector<PictureTool> tools;                ///< those of the case in their order, then images
  std::deque<Curve> images;                      ///< of tools
  std::vector<SymmetryLine> symmetry;
  CellRasters rasters;

  std::size_t bytes() const;
};

/// Where pictures draw the nodes of a state, [component][node] m.
template<int dim> Fields<dim> drawn_positions(const results::Snapshot<dim>& shot);
/// Says that displacements are drawn larger or smaller; empty when they are not.
std::string note_of_scale(double displacement_scale);

/// `input` must outlive what is returned. position: of nodes, m, as they are to be drawn.
std::shared_ptr<PictureSource> picture_source(const input::Case& input, const results::Snapshot<2>& shot,
                                              const Fields<2>& position,
                                              const std::vector<std::string>& names);
/// The same from a time of fields.pvd in `folder`. Throws IoError.
std::shared_ptr<PictureSource> picture_source(const input::Case& input, const std::filesystem::path& folder,
                                              const results::FieldFiles& files,
                                              const std::vector<std::string>& names);

/// The picture of a field of the source, with nothing said of its range and window.
Picture picture_of(const input::Case& input, PictureSource& source, std::size_t field);

/// What a picture's own values span, as the case would have them coloured.
ColourRange own_span(const input::Case& input, const std::string& field, const Picture& picture);

} // namespace cnem::report
