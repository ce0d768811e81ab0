#include "evaluate/chip.hpp"

#include "core/index.hpp"
#include "core/parameter.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::evaluate {
namespace {

constexpr double out_of_shear = 0.25; ///< of the feed: so far beyond the shear zone thickness is measured
constexpr double at_end = 0.5;        ///< of the thickness: so far from its end it is not
constexpr double longest_chip = 10.0; ///< feeds: what was made before is not looked at
constexpr double shortest_chip = 0.5; ///< of the feed: a chip of which less can be measured is none yet
constexpr double stands_out = 0.10;   ///< of the thickness: what is smaller is roughness, no tooth

/// A polyline by its length.
struct ChipSide {
  std::vector<Vec2> point;
  std::vector<double> at; ///< m

  explicit ChipSide(std::vector<Vec2> points) : point(std::move(points)) {
    at.reserve(point.size());
    for (std::size_t k = 0; k < point.size(); ++k)
      at.push_back(k == 0 ? 0.0 : at.back() + (point[k] - point[k - 1]).norm());
  }

  /// The point at a length, m; the last one beyond the end.
  Vec2 place(double length) const {
    const auto after = std::upper_bound(at.begin(), at.end(), length) - at.begin();
    if (after == std::ssize(at)) return point.back();
    const auto k = index_of(std::max<std::ptrdiff_t>(after, 1));
    const double s = std::max(0.0, (length - at[k - 1]) / (at[k] - at[k - 1]));
    return (1.0 - s) * point[k - 1] + s * point[k];
  }
};

/// The nearest point of the segments of a walk within [from, to] of its length.
struct Foot {
  double at = 0.0, distance = infinite; ///< m
};
Foot foot_of(const Vec2& x, const ChipSide& walk, double from, double to) {
  Foot best;
  const auto first = std::lower_bound(walk.at.begin(), walk.at.end(), from) - walk.at.begin();
  for (auto k = index_of(std::max<std::ptrdiff_t>(first, 1)); k < walk.at.size() && walk.at[k - 1] <= to;
       ++k) {
    const Vec2 side = walk.point[k] - walk.point[k - 1];
    const double length2 = side.squaredNorm();
    const double s = length2 > 0.0 ? std::clamp((x - walk.point[k - 1]).dot(side) / length2, 0.0, 1.0) : 0.0;
    const double distance = (x - walk.point[k - 1] - s * side).norm();
    if (distance < best.distance) best = {walk.at[k - 1] + s * std::sqrt(length2), distance};
  }
  return best;
}

/// Pairs of points across the chip, from its foot to its end: index on the rake side from the tip, and of the
/// outline on the free side.
struct Rung {
  std::size_t rake, free;
};

/// Both sides are gone along so that rungs stay as short as they can: a strip has them across, however it
/// curls and whatever it touches.
std::vector<Rung> ladder(const std::vector<Vec2>& point, std::size_t foot) {
  std::vector<Rung> rungs{{0, foot}};
  while (rungs.back().rake + 1 < rungs.back().free) {
    const auto [i, j] = rungs.back();
    const bool along_rake =
        (point[i + 1] - point[j]).squaredNorm() <= (point[i] - point[j - 1]).squaredNorm();
    rungs.push_back(along_rake ? Rung{i + 1, j} : Rung{i, j - 1});
  }
  return rungs;
}

/// Where the free surface is nearest to the tip: gone along from the far side of the workpiece, until it has
/// become further again by half a feed, on the chip. points.size() when that does not come: no chip yet.
std::size_t foot_of_chip(const std::vector<Vec2>& point, double feed) {
  std::size_t begin = 0; // the lower corner ahead
  for (std::size_t k = 0; k < point.size(); ++k)
    if (point[k].x() - point[k].y() > point[begin].x() - point[begin].y()) begin = k;
  std::size_t nearest = begin;
  for (std::size_t k = begin; k > 0; --k) {
    const double distance = point[k].norm(), least = point[nearest].norm();
    if (distance < least) nearest = k;
    if (point[nearest].y() > 0.0 && distance > least + 0.5 * feed) return nearest;
  }
  return point.size();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Slope of the direction of a walk over its length within a stretch, 1/m, by least squares: its curvature.
double curvature(const ChipSide& walk, const Stretch& part) {
  double angle = 0.0, weight = 0.0, s = 0.0, a = 0.0, ss = 0.0, sa = 0.0;
  Vec2 before(0, 0);
  for (std::size_t k = 1; k < walk.at.size(); ++k) {
    const double middle = 0.5 * (walk.at[k - 1] + walk.at[k]) - part.from,
                 length = walk.at[k] - walk.at[k - 1];
    if (middle < 0.0 || middle > part.length() || !(length > 0.0)) continue;
    const Vec2 along = (walk.point[k] - walk.point[k - 1]) / length;
    if (weight > 0.0) angle += std::atan2(cross(before, along), before.dot(along));
    before = along;
    weight += length;
    s += length * middle;
    a += length * angle;
    ss += length * middle * middle;
    sa += length * middle * angle;
  }
  const double spread = ss * weight - s * s;
  return spread > 0.0 ? (sa * weight - s * a) / spread : unknown;
}

double signed_area(std::span<const Vec2> polygon) {
  double twice = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    twice += cross(polygon[k], polygon[(k + 1) % polygon.size()]);
  return 0.5 * twice;
}

/// [node] the facet that begins there.
IndexedVector<NodeIndex, CloudFacetIndex>
leaving_facets(const IndexedVector<CloudFacetIndex, Facet<2>>& facets, std::size_t nodes) {
  IndexedVector<NodeIndex, CloudFacetIndex> leaving(nodes, CloudFacetIndex::none);
  for (const CloudFacetIndex f : facets.indices()) leaving[facets[f].node[0]] = f;
  return leaving;
}

CutOutline loop_from(NodeIndex start, const IndexedVector<CloudFacetIndex, Facet<2>>& facets,
                     const IndexedVector<NodeIndex, CloudFacetIndex>& leaving,
                     std::span<const Vec2> position) {
  CutOutline outline;
  NodeIndex i = start;
  do {
    outline.node.push_back(i);
    outline.point.push_back(position[index_of(i)]);
    i = facets[leaving[i]].node[1];
  } while (i != start);
  return outline;
}

/// The other way round, from the same node on.
void reverse(CutOutline& outline) {
  std::reverse(outline.node.begin() + 1, outline.node.end());
  std::reverse(outline.point.begin() + 1, outline.point.end());
}

} // namespace

CutOutline cut_outline(const IndexedVector<CloudFacetIndex, Facet<2>>& facets,
                       std::span<const Vec2> position) {
  const auto leaving = leaving_facets(facets, position.size());
  NodeIndex nearest = NodeIndex::none;
  for (const Facet<2>& facet : facets) {
    const NodeIndex i = facet.node[0];
    if (!exists(nearest) || position[index_of(i)].squaredNorm() < position[index_of(nearest)].squaredNorm())
      nearest = i;
  }
  if (!exists(nearest)) return {};
  CutOutline outline = loop_from(nearest, facets, leaving, position);
  if (signed_area(outline.point) > 0.0) reverse(outline); // but where the frame is a mirrored one
  return outline;
}

std::vector<CutOutline> outlines_of_bodies(const IndexedVector<CloudFacetIndex, Facet<2>>& facets,
                                           std::span<const Vec2> position) {
  const auto leaving = leaving_facets(facets, position.size());
  std::vector<CutOutline> loops;
  std::vector<double> area;
  IndexedVector<NodeIndex, char> seen(position.size(), 0);
  for (const Facet<2>& facet : facets) {
    if (seen[facet.node[0]]) continue;
    loops.push_back(loop_from(facet.node[0], facets, leaving, position));
    area.push_back(signed_area(loops.back().point));
    for (const NodeIndex i : loops.back().node) seen[i] = 1;
  }
  // Holes go round the other way than the loop with the largest area, which is that of a body.
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto largest = std::max_element(area.begin(), area.end(), larger);
  std::vector<CutOutline> bodies;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    if (area[k] * *largest <= 0.0) continue;
    if (area[k] > 0.0) reverse(loops[k]);
    bodies.push_back(std::move(loops[k]));
  }
  return bodies;
}

Teeth measure_teeth(const ThicknessProfile& profile) {
  const std::vector<double>&at = profile.at, &h = profile.thickness;
  Teeth teeth;
  if (at.size() < 2 || !(at.back() > at.front())) return teeth;
  double area = 0.0;
  for (std::size_t k = 1; k < at.size(); ++k) area += 0.5 * (h[k - 1] + h[k]) * (at[k] - at[k - 1]);
  teeth.mean = area / (at.back() - at.front());
  const auto [low, high] = std::minmax_element(h.begin(), h.end());
  teeth.valley = *low;
  teeth.peak = *high;

  // Turning points that stand out from those beside them, in turn a valley and a peak.
  const double least = stands_out * teeth.mean;
  std::vector<std::size_t> peaks, valleys;
  std::size_t top = 0, bottom = 0;
  bool rising = false, known = false; // towards the next turning point
  for (std::size_t k = 0; k < h.size(); ++k) {
    if (h[k] > h[top]) top = k;
    if (h[k] < h[bottom]) bottom = k;
    if ((rising || !known) && h[k] < h[top] - least) {
      if (known) peaks.push_back(top);
      rising = false, known = true, bottom = k;
    } else if ((!rising || !known) && h[k] > h[bottom] + least) {
      if (known) valleys.push_back(bottom);
      rising = known = true, top = k;
    }
  }
  for (const std::size_t k : peaks) teeth.at.push_back(at[k]);
  if (peaks.size() < 3) return teeth;
  teeth.spacing = (at[peaks.back()] - at[peaks.front()]) / static_cast<double>(peaks.size() - 1);
  const auto mean = [&](const std::vector<std::size_t>& list) {
    double sum = 0.0;
    for (const std::size_t k : list) sum += h[k];
    return sum / static_cast<double>(list.size());
  };
  teeth.peak = mean(peaks);
  teeth.valley = mean(valleys);
  return teeth;
}

Chip measure_chip(const CutOutline& outline, double feed, double rake) {
  Chip chip;
  const std::vector<Vec2>& point = outline.point;
  const std::size_t foot = foot_of_chip(point, feed);
  if (foot == point.size()) {
    chip.note = "no chip is found: there is none yet, or none any more";
    return chip;
  }
  chip.shear_plane = point[foot].norm();
  chip.shear_plane_angle = std::atan2(point[foot].y(), point[foot].x());
  const std::vector<Rung> rungs = ladder(point, foot);
  std::vector<double> across;
  for (const Rung& rung : rungs) across.push_back((point[rung.rake] - point[rung.free]).norm());
  const double usual = median(across);
  std::size_t last = rungs.size() - 1; // where it begins to be drawn together at its end
  while (last > 0 && across[last] < 0.8 * usual) --last;
  const auto at = [&](std::size_t k) { return point.begin() + static_cast<std::ptrdiff_t>(k); };
  chip.rake_side.assign(at(0), at(rungs[last].rake + 1));
  chip.free_side.assign(at(rungs[last].free), at(foot + 1));
  std::reverse(chip.free_side.begin(), chip.free_side.end());
  const ChipSide walk(chip.rake_side);
  chip.length = walk.at.back();

  // On the free side, from the shear plane to the end.
  ThicknessProfile whole;
  std::size_t rung = 0;
  for (std::size_t j = foot; j >= rungs[last].free; --j) {
    while (rungs[rung].free > j) ++rung;
    const double place = walk.at[std::min(rungs[rung].rake, walk.at.size() - 1)];
    const Foot nearest = foot_of(point[j], walk, place - 2.0 * usual, place + 2.0 * usual);
    whole.at.push_back(nearest.at);
    whole.thickness.push_back(nearest.distance);
  }
  // The free side of the chip begins where the perpendicular from the shear plane's end meets the rake face.
  chip.begin = chip.shear_plane * std::max(0.0, std::sin(chip.shear_plane_angle - rake));
  chip.measured.from = chip.begin + out_of_shear * feed;
  chip.measured.to = std::min(chip.length - at_end * usual, chip.measured.from + longest_chip * feed);
  if (chip.measured.length() < shortest_chip * feed) {
    chip.note = fmt::format("the chip is too short to be measured: {:.2g} feeds long", chip.length / feed);
    return chip;
  }
  for (std::size_t k = 0; k < whole.at.size(); ++k)
    if (whole.at[k] >= chip.measured.from && whole.at[k] <= chip.measured.to) {
      chip.profile.at.push_back(whole.at[k]);
      chip.profile.thickness.push_back(whole.thickness[k]);
    }
  Teeth teeth = measure_teeth(chip.profile);
  chip.thickness = teeth.mean;
  chip.peak = teeth.peak;
  chip.valley = teeth.valley;
  chip.teeth = std::move(teeth.at);
  chip.tooth_spacing = teeth.spacing;
  return chip;
}

double curl_radius(const Chip& chip, const Stretch& part) {
  constexpr double straight = 0.05; // rad
  const double bend = chip.rake_side.empty() ? unknown : curvature(ChipSide(chip.rake_side), part);
  return std::abs(bend) * part.length() > straight ? -1.0 / bend : unknown;
}

Section section_across(const Chip& chip, double at) {
  const ChipSide free(chip.free_side);
  const Vec2 rake = ChipSide(chip.rake_side).place(at);
  return {rake, free.place(foot_of(rake, free, 0.0, infinite).at)};
}

std::vector<Vec2> fresh_chip(const Chip& chip, double feed) {
  std::vector<Vec2> polygon;
  if (chip.rake_side.empty()) return polygon;
  const ChipSide rake(chip.rake_side), free(chip.free_side);
  for (std::size_t k = 0; k < rake.at.size(); ++k)
    if (rake.at[k] >= 0.5 * chip.begin && rake.at[k] <= chip.begin + 0.5 * feed)
      polygon.push_back(rake.point[k]);
  for (std::size_t k = free.at.size(); k-- > 0;)
    if (free.at[k] <= 0.5 * feed) polygon.push_back(free.point[k]);
  return polygon.size() < 3 ? std::vector<Vec2>{} : polygon;
}

double shear_angle(double feed, double thickness, double rake) {
  const double ratio = feed / thickness;
  return std::atan2(ratio * std::cos(rake), 1.0 - ratio * std::sin(rake));
}

} // namespace cnem::evaluate
