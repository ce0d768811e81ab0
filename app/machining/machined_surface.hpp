#pragma once
// What a milling cut leaves on the machined side.
#include "input/case_machining.hpp"
#include "machining/milling_process.hpp"
#include "report/surface_map.hpp"
#include "results/status.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cnem::app {

class MachinedSurface {
public:
  /// Between where the first turns have been and where the last one is. Throws DivergenceError where nothing
  /// is left of a workpiece that a straight cut goes along.
  MachinedSurface(const machining::MillingProcess& process, const input::MachiningCase& milling);

  /// Metrics of the surface, and of those thirds of the height that the last pass reaches in which there is
  /// some of it: means of Ra and Rz (ISO 4287), the largest of the others. Returns a sentence.
  std::string tell(results::RunStatus& status) const;
  /// A row a place along the path where any layer has a machined side, a column a layer; nan where it has
  /// none.
  std::string csv() const;
  /// The same as a grid in space, where the surface is, for VTK, whose reader does not take nan: left_m is 0
  /// where `machined` is 0, 1 elsewhere.
  std::string vtk() const;
  /// Over the way and the height; none of fewer than two places or layers.
  std::optional<report::SurfaceMap> map() const;

private:
  struct Texture {
    double Ra = 0.0, Rz = 0.0, peak_to_valley = 0.0, location_error = 0.0;
  };
  /// Looks at the places along the path, m, and marks those where the layer has a machined side.
  void add_layer(std::size_t layer, const std::vector<double>& places, std::vector<bool>& found);
  /// height: m, evenly along the path.
  static Texture texture_of(const std::vector<double>& height);

  const machining::MillingProcess& process_;
  bool up_;
  std::size_t asked_ = 0;                 ///< places along the path, with and without a machined side
  std::vector<double> place_;             ///< m along the path: x of a straight cut, way along the last pass
  std::vector<std::size_t> layer_;        ///< those that have a machined side
  std::vector<std::vector<double>> left_; ///< [layer_][place] m; no number where it has no machined side
  std::vector<std::optional<Texture>> texture_; ///< [layer_] none of a machined side that is hardly there
};

} // namespace cnem::app
