#pragma once
// Clouds of nodes from a described domain: what a case file says about geometry and spacing becomes a
// Cloud<2>. Every result is a function of its arguments alone, bit for bit, on any machine and any number of
// threads.
#include "core/error.hpp"
#include "core/geometry/cloud.hpp"
#include "core/geometry/curve.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cnem::clouds {

/// The wanted spacing is at fault, not the shape: out of range, or too many nodes.
struct SpacingError : GeometryError {
  using GeometryError::GeometryError;
};

/// An open polyline whose two faces may part. Each end lies inside the domain (a tip) or on the outline or a
/// hole (a mouth). Its faces become the boundary pieces NAME+ (material on the left of the path, seen along
/// it) and NAME-.
struct Crack {
  std::string name;
  std::vector<Vec2> path; ///< at least two points, m
};

/// What is meshed: inside `outer`, outside `holes`. Either sense of travel is accepted; the cloud's outer
/// loop runs counter-clockwise and its holes clockwise in any case.
struct DomainShape {
  Curve outer;
  std::vector<Curve> holes;
  std::vector<Crack> cracks;
};

/// A region with its own spacing, from which the spacing grows by `growth` per unit of distance.
template<int dim> struct RefinementIn {
  enum class Region {
    path, ///< `points`: one point, or the vertices of an open polyline
    box,  ///< `points`: two opposite corners of a box parallel to the axes
  };
  Region region = Region::path;
  std::vector<Vec<dim>> points; ///< m
  double spacing = 0.0;         ///< m, inside the region
  double growth = 0.3;          ///< in (0, 1]; neighbouring edges differ by about this fraction

  double distance(const Vec<dim>& x) const; ///< from x to the region, m; 0 inside a box
};
using Refinement = RefinementIn<2>;

/// Spacing on a surface in space that is mapped to the plane.
struct MappedSpacing {
  std::function<double(const Vec2&)> at; ///< at most the spacing away from refinements
  double finest = 0.0;                   ///< at most the least value
  double growth = 0.0;                   ///< at least the steepest growth, below 1
};

/// Wanted distance of neighbouring nodes, h(x) = min(spacing, min_r [spacing_r + growth_r distance_r(x)]), m.
template<int dim> struct SpacingFieldIn {
  double spacing = 0.0; ///< away from every refinement, m
  std::vector<RefinementIn<dim>> refinements;
  std::optional<MappedSpacing> mapped{}; ///< of the plane: takes the place of refinements

  double at(const Vec<dim>& x) const;
  /// True when no refinement is finer than `spacing`.
  bool uniform() const;
  double finest() const; ///< m, no larger than any value
  double growth() const; ///< of the steepest refinement that is finer than `spacing`; 0: uniform
  /// Throws SpacingError for spacings or growths out of range and regions without points.
  void check() const;
};
using SpacingField = SpacingFieldIn<2>;

enum class Pattern {
  hexagonal, ///< near-equilateral rows along x, fitted to the bounding box
  regular,   ///< square grid, fitted to the bounding box; needs a uniform spacing
  jittered,  ///< hexagonal, each interior node then moved at random
  list,      ///< the nodes are given
};

struct CloudOptions {
  Pattern pattern = Pattern::hexagonal;
  double jitter = 0.2;        ///< pattern jittered: largest displacement over h(x), in [0, 0.4]
  std::uint64_t seed = 1;     ///< pattern jittered
  std::vector<Vec2> nodes;    ///< pattern list: every node once, those on a crack too; m
  double nodes_limit = 5.0e6; ///< more nodes than this are refused
};

struct GeneratedCloud {
  Cloud<2> cloud;
  std::vector<std::string> warnings; ///< features that the spacing hardly resolves, one sentence each
};

/// Nodes and boundary for a domain.
///
/// Boundary: every corner is a node; between corners nodes share out ∫ ds/h(x) equally. On arcs nodes lie on
/// the arc and edges are chords of at most 20°, or, where such chords were shorter than 0.6 h, of 0.6 h
/// and at most 45°. Coinciding nodes of the two faces of a crack are declared in Cloud::twins; a tip is
/// single.
/// Interior, uniform spacing: the lattice, then smoothed near the boundary alone; a rectangle whose sides are
/// multiples of h gets the exact regular grid. Graded spacing: a front that grows from the boundary, then
/// smoothed everywhere (patterns hexagonal and jittered).
/// Pattern list: cloud node i is list node i, copies for crack faces follow behind; nodes within 1e-9 of
/// the domain's size from the outline or a crack are on it. Otherwise nodes come in space-filling order.
///
/// Throws GeometryError, with positions: curves that do not close or cross, cracks that leave the domain or
/// touch themselves, each other or the boundary other than by an end, more than `nodes_limit` nodes (a
/// SpacingError with the estimate), and for lists a corner without node, nodes outside (with index) and
/// duplicates. About 1 µs per node with a uniform spacing, 5 µs graded.
GeneratedCloud generate_cloud(const DomainShape& domain, const SpacingField& spacing,
                              const CloudOptions& options);

/// Number of nodes that generate_cloud would make, within about 10%, in milliseconds (below a second when
/// they are millions); counting stops a little above `limit`. For pattern list the number given.
double estimate_nodes(const DomainShape& domain, const SpacingField& spacing, const CloudOptions& options);

/// How well a cloud follows a spacing field.
struct CloudQuality {
  double nearest_min = 0.0; ///< shortest Delaunay edge over h at its middle
  double edge_max = 0.0;    ///< longest Delaunay edge over h at its middle
  double edge_mean = 0.0;   ///< mean Delaunay edge over h
  double hole_max = 0.0;    ///< largest circumradius of a Delaunay triangle over h there; 0.58 is ideal
  double grading_max = 0.0; ///< largest ratio of mean edge lengths of two Delaunay neighbours
  double angle_min = 0.0;   ///< smallest angle of a Delaunay triangle, rad
};

/// Quality over the constrained Delaunay triangles of the cloud. Throws as triangulate.
CloudQuality measure_quality(const Cloud<2>& cloud, const SpacingField& spacing);

} // namespace cnem::clouds
