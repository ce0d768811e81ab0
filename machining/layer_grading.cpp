#include "machining/layer_grading.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace cnem::machining {

namespace {

/// What changes over the height, in layers.
struct Courses {
  double entry, exit, lead, height;
  double apart(const Courses& other) const {
    return std::max({std::abs(entry - other.entry), std::abs(exit - other.exit), std::abs(lead - other.lead),
                     std::abs(height - other.height)});
  }
};

/// rad between the axis and the normal of a profile over the height. Of an edge of straight parts it turns
/// from the middle of each to that of the next, not by jumps.
class Lead {
public:
  explicit Lead(const Cutter& cutter) : cutter_(cutter) {
    if (!cutter.edge) return;
    const std::vector<Vec3>& points = cutter.edge->points();
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      middle_.push_back(0.5 * (points[k].z() + points[k + 1].z()));
      lead_.push_back(cutter.lead(middle_.back(), middle_.back()));
    }
  }
  double operator()(double z) const {
    if (middle_.empty()) return cutter_.lead(z, z);
    if (z <= middle_.front()) return lead_.front();
    if (z >= middle_.back()) return lead_.back();
    const std::size_t k = index_of(std::upper_bound(middle_.begin(), middle_.end(), z) - middle_.begin());
    return std::lerp(lead_[k - 1], lead_[k], (z - middle_[k - 1]) / (middle_[k] - middle_[k - 1]));
  }

private:
  const Cutter& cutter_;
  std::vector<double> middle_, lead_; ///< [straight part] m, rad
};

} // namespace

LayerGrading::LayerGrading(const MillingCut& cut, double depth, int steps) {
  assert(depth > 0.0 && steps > 0);
  constexpr double degree = std::numbers::pi / 180.0;
  const double step = std::clamp(full_turn / steps, 0.5 * degree, degree);
  constexpr double turn = 4.5 * degree, share = 0.05; // of a layer: its normals turn by; of the depth
  const Cutter& cutter = cut.cutter;
  const Lead lead(cutter);
  const auto courses = [&](double z) -> Courses {
    const double radius = cutter.radius_at(z), lag = cutter.lag(z);
    return {.entry = (lag + cut.engagement.entry(cutter, radius)) / step,
            .exit = (lag + cut.engagement.exit(cutter, radius)) / step,
            .lead = lead(z) / turn,
            .height = cutter.rounded() ? z / (share * depth) : 0.0};
  };
  constexpr int pieces = 64, halvings = 40;
  constexpr double finest = 0.1, most = 2e4; // layers in a piece; pieces
  double whole = 0.0;
  for (int k = 0; k < pieces; ++k)
    whole += courses(depth * (k + 1) / pieces).apart(courses(depth * k / pieces));
  const double enough = std::max(finest, whole / most);
  height_ = {0.0};
  changes_ = {0.0};
  const auto add = [&](const auto& self, double low, const Courses& at_low, double high,
                       const Courses& at_high, int level) -> void {
    const double apart = at_high.apart(at_low);
    if (apart > enough && level < halvings) {
      const double middle = 0.5 * (low + high);
      const Courses there = courses(middle);
      self(self, low, at_low, middle, there, level + 1);
      self(self, middle, there, high, at_high, level + 1);
      return;
    }
    height_.push_back(high);
    changes_.push_back(changes_.back() + apart);
  };
  for (int k = 0; k < pieces; ++k) {
    const double low = depth * k / pieces, high = depth * (k + 1) / pieces;
    add(add, low, courses(low), high, courses(high), 0);
  }
}

int LayerGrading::layers() const {
  constexpr double rounding = 1e-9, most = 1e9; // of a layer; layers
  return static_cast<int>(std::clamp(std::ceil(changes_.back() - rounding), 1.0, most));
}

std::vector<double> LayerGrading::ends(int count) const {
  assert(count >= 1);
  constexpr double rounding = 1e-9; // of the depth
  const double depth = height_.back();
  std::vector<double> ends{0.0};
  for (int k = 1; k < count && changes_.back() > 0.0; ++k) {
    const double at = changes_.back() * k / count;
    const std::size_t above =
        index_of(std::upper_bound(changes_.begin(), changes_.end(), at) - changes_.begin());
    const double x = (at - changes_[above - 1]) / (changes_[above] - changes_[above - 1]),
                 z = (1.0 - x) * height_[above - 1] + x * height_[above];
    if (z > ends.back() + rounding * depth && z < depth * (1.0 - rounding)) ends.push_back(z);
  }
  ends.push_back(depth);
  return ends;
}

double LayerGrading::thickest(int count) const {
  const std::vector<double> at = ends(count);
  double most = 0.0;
  for (std::size_t k = 1; k < at.size(); ++k) most = std::max(most, at[k] - at[k - 1]);
  return most;
}

} // namespace cnem::machining
