#pragma once
// The surface that a tool has left behind, and what lies below it, in the frame of the tool (chip.hpp).
#include "core/fields/aligned.hpp"
#include "evaluate/chip.hpp"

#include <span>
#include <string>
#include <vector>

namespace cnem::evaluate {

/// Normal stresses along the cut, normal to the surface and out of the plane; what T says of each, in Pa.
template<class T> struct NormalStresses { T along, away, across; };

/// What is averaged below the surface; each list is [node].
struct DepthFields {
  using Stresses = NormalStresses<std::span<const double>>;
  std::span<const double> volume;         ///< m², shares of the area: weights of the means
  Stresses loaded, residual;              ///< as it is; unloaded and cooled
  std::span<const double> plastic_strain; ///< –
  std::span<const double> temperature;    ///< K
  std::span<const double> yield_ratio;    ///< –, equivalent residual stress over what it would flow at
};

struct LayerMean {
  double mean = 0.0, spread = 0.0; ///< standard deviation
};

/// Means over a layer of the measured length.
struct DepthLayer {
  double depth = 0.0; ///< m, below the mean height of the surface
  NormalStresses<LayerMean> loaded, residual;
  double plastic_strain = 0.0, temperature = 0.0;
  double nodes = 0.0;
};

/// What docs/cutting.md defines. What was not found is not-a-number, and `note` says why.
struct MachinedSurface {
  std::string note;
  Stretch measured;           ///< m, x: behind the tool
  double height = unknown;    ///< m, mean, above the tip
  double roughness = unknown; ///< m, Σ|y|/n of its n nodes from the mean height (paper 003, (27))
  double Rz = unknown;        ///< m, highest over lowest point, mean over five equal lengths (ISO 4287)
  double layer = unknown;     ///< m, thickness of layers: mean distance of nodes near the surface
  std::vector<DepthLayer> layers;
  double yield_ratio = unknown; ///< –, the largest in the layers
};

/// The surface that a tool has left, m, from the tip backwards: stretches of one body each.
using SurfaceProfile = std::vector<std::vector<Vec2>>;

/// position: [node] m, in the frame of the tool. Of several bodies, those count as workpiece that reach
/// deeper than the tip by a twentieth of the feed, as a rule of thumb: chips do not. Of one its nodes; where
/// there are more, as fibres that have come off their matrix, what is seen of them from above, at places a
/// fiftieth of the feed apart, none over gaps that are deeper than half of it.
SurfaceProfile machined_profile(const IndexedVector<CloudFacetIndex, Facet<2>>& facets,
                                std::span<const Vec2> position, double feed);

/// profile: machined_profile(). position: [node] m, in the frame of the tool. travelled, m: by the tool along
/// the cut; what lies further behind it, as the ledge that an earlier cut has left, it has not made. clear,
/// m: so near to the tool, and to where the cut began, nothing is measured.
MachinedSurface measure_surface(const SurfaceProfile& profile, std::span<const Vec2> position,
                                const DepthFields& fields, double feed, double travelled, double clear);

} // namespace cnem::evaluate
