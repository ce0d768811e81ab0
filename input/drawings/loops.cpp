#include "input/drawings/loops.hpp"

#include "input/curve_checks.hpp"
#include "input/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace cnem::input {
namespace {

constexpr std::size_t most_told = 3; ///< of mistakes of one kind

/// The pieces of a message, of which the first few are told.
std::string told(const std::vector<std::string>& mistakes) {
  const std::vector<std::string> first(mistakes.begin(),
                                       mistakes.begin() + long(std::min(mistakes.size(), most_told)));
  const std::size_t more = mistakes.size() - first.size();
  return fmt::format("{}{}", fmt::join(first, "; "), more ? fmt::format("; and {} more", more) : "");
}

/// Points that ends of curves share.
class Corners {
public:
  explicit Corners(double tolerance) : tolerance_(tolerance) {}

  std::size_t at(const Vec2& x) {
    const long i = cell(x.x()), j = cell(x.y());
    for (long di = -1; di <= 1; ++di)
      for (long dj = -1; dj <= 1; ++dj)
        if (const auto found = cells_.find({i + di, j + dj}); found != cells_.end())
          for (const std::size_t k : found->second)
            if ((points_[k] - x).norm() <= tolerance_) return k;
    cells_[{i, j}].push_back(points_.size());
    points_.push_back(x);
    return points_.size() - 1;
  }
  const Vec2& operator[](std::size_t k) const { return points_[k]; }
  std::size_t size() const { return points_.size(); }

private:
  long cell(double x) const { return static_cast<long>(std::floor(std::clamp(x / tolerance_, -1e18, 1e18))); }

  double tolerance_;
  std::vector<Vec2> points_;
  std::map<std::pair<long, long>, std::vector<std::size_t>> cells_;
};

class Chains {
public:
  Chains(const DrawnFile& drawing, std::vector<DrawnCurve> curves, double tolerance)
      : drawing_(drawing), curves_(std::move(curves)), tolerance_(tolerance), corners_(tolerance),
        ends_(curves_.size()) {}

  std::vector<Loop> loops() {
    find_corners();
    refuse_twice();
    refuse_branches();
    refuse_loose_ends();
    std::vector<Loop> result;
    std::vector<bool> used(curves_.size(), false);
    for (std::size_t k = 0; k < curves_.size(); ++k)
      if (!used[k]) result.push_back(follow(k, used));
    return result;
  }

private:
  [[noreturn]] void fail(const std::string& message) const {
    throw DrawingError(fmt::format("{}: {}", drawing_.file, message));
  }
  std::string show(const Vec2& x) const { return place_in(drawing_, x); }
  std::string named(std::size_t k) const {
    return fmt::format("layer {}, line {}", toml_quoted(shortened(curves_[k].piece.name)), curves_[k].line);
  }

  /// Corners of lines come first: those of arcs follow from angles.
  void find_corners() {
    std::vector<std::string> short_ones;
    for (const bool calculated : {false, true})
      for (std::size_t k = 0; k < curves_.size(); ++k) {
        CurvePiece& piece = curves_[k].piece;
        if (curves_[k].ends_calculated != calculated) continue;
        const bool whole = piece.is_arc() && std::abs(piece.sweep()) > std::numbers::pi;
        ends_[k] = {corners_.at(piece.from), corners_.at(piece.to)};
        if (ends_[k][0] == ends_[k][1] && !whole)
          short_ones.push_back(fmt::format("{} ({})", show(piece.from), named(k)));
        put_through(piece, corners_[ends_[k][0]], corners_[ends_[k][1]]);
      }
    if (!short_ones.empty())
      fail(fmt::format("found curves that are no longer than the tolerance at {}, expected none",
                       told(short_ones)));
    at_.resize(corners_.size());
    for (std::size_t k = 0; k < curves_.size(); ++k)
      if (ends_[k][0] != ends_[k][1])
        for (const std::size_t corner : ends_[k]) at_[corner].push_back(k);
  }

  /// The arc keeps its angle where its ends move.
  static void put_through(CurvePiece& piece, const Vec2& from, const Vec2& to) {
    const double bulge = std::tan(0.25 * piece.sweep());
    piece.from = from;
    piece.to = to;
    if (!piece.is_arc() || from == to) return;
    const double r0 = (from - piece.centre).norm(), r1 = (to - piece.centre).norm();
    if (std::max(std::abs(r0 - piece.radius), std::abs(r1 - piece.radius)) <= 1e-9 * piece.radius) return;
    const Vec2 chord = to - from;
    piece.centre = 0.5 * (from + to) + (1.0 - bulge * bulge) / (4.0 * bulge) * left_normal(chord);
    piece.radius = (from - piece.centre).norm();
  }

  void refuse_twice() const {
    std::map<std::array<std::size_t, 2>, std::vector<std::size_t>> between;
    std::vector<std::string> twice;
    for (std::size_t k = 0; k < curves_.size(); ++k) {
      std::array<std::size_t, 2> ends = ends_[k];
      std::sort(ends.begin(), ends.end());
      for (const std::size_t other : between[ends]) {
        const Vec2 middle = curves_[k].piece.point(0.5);
        if ((middle - curves_[other].piece.point(0.5)).norm() > tolerance_) continue;
        twice.push_back(fmt::format("from {} to {} ({} and line {})", show(curves_[k].piece.from),
                                    show(curves_[k].piece.to), named(other), curves_[k].line));
        break;
      }
      between[ends].push_back(k);
    }
    if (!twice.empty()) fail(fmt::format("found curves drawn twice {}, expected each once", told(twice)));
  }

  void refuse_branches() const {
    std::vector<std::string> branches;
    for (std::size_t corner = 0; corner < corners_.size(); ++corner) {
      if (at_[corner].size() < 3) continue;
      std::vector<std::string> names;
      for (const std::size_t k : at_[corner]) names.push_back(named(k));
      branches.push_back(
          fmt::format("{} meet at {} ({})", names.size(), show(corners_[corner]), told(names)));
    }
    if (!branches.empty())
      fail(fmt::format(
          "found curves that branch: {}, expected two at each corner of an outline; `layers` says which "
          "belong to it",
          told(branches)));
  }

  void refuse_loose_ends() const {
    std::vector<std::size_t> loose;
    for (std::size_t corner = 0; corner < corners_.size(); ++corner)
      if (at_[corner].size() == 1) loose.push_back(corner);
    if (loose.empty()) return;
    std::vector<std::string> gaps;
    while (loose.size() > 1 && gaps.size() < most_told) { // the closest two belong together
      std::size_t a = 0, b = 1;
      double least = std::numeric_limits<double>::max();
      for (std::size_t i = 0; i < std::min<std::size_t>(loose.size(), 1000); ++i)
        for (std::size_t j = i + 1; j < loose.size(); ++j)
          if (const double gap = (corners_[loose[i]] - corners_[loose[j]]).norm(); gap < least)
            least = gap, a = i, b = j;
      gaps.push_back(fmt::format("between {} ({}) and {} ({}), {:.4g} {} apart", show(corners_[loose[a]]),
                                 named(at_[loose[a]].front()), show(corners_[loose[b]]),
                                 named(at_[loose[b]].front()), least, drawing_.unit->name));
      loose.erase(loose.begin() + long(b));
      loose.erase(loose.begin() + long(a));
    }
    fail(fmt::format(
        "the outline is open {}{}, expected ends that meet within {:.3g} {}: close it in the drawing, or by "
        "a wider `tolerance`",
        told(gaps), loose.empty() ? "" : fmt::format("; {} more ends are loose", loose.size()), tolerance_,
        drawing_.unit->name));
  }

  Loop follow(std::size_t first, std::vector<bool>& used) const {
    Loop loop;
    loop.line = curves_[first].line;
    std::size_t k = first, corner = ends_[first][0];
    do {
      used[k] = true;
      CurvePiece piece = curves_[k].piece;
      if (ends_[k][0] != corner) {
        std::swap(piece.from, piece.to);
        piece.clockwise = piece.is_arc() && !piece.clockwise;
      }
      loop.curve.pieces.push_back(std::move(piece));
      corner = ends_[k][0] == corner ? ends_[k][1] : ends_[k][0];
      const std::vector<std::size_t>& both = at_[corner];
      if (!both.empty()) k = both[0] == k ? both[1] : both[0];
    } while (k != first && !used[k]);
    return loop;
  }

  const DrawnFile& drawing_;
  std::vector<DrawnCurve> curves_;
  double tolerance_;
  Corners corners_;
  std::vector<std::array<std::size_t, 2>> ends_;
  std::vector<std::vector<std::size_t>> at_; ///< curves at each corner
};

void refuse_crossings(const DrawnFile& drawing, const std::vector<Loop>& loops) {
  std::vector<Curve> curves;
  for (const Loop& loop : loops) curves.push_back(split_long_arcs(loop.curve));
  const auto fail = [&](const std::string& what, const Vec2& x) {
    throw DrawingError(
        fmt::format("{}: {} at {}, expected outlines that do not", drawing.file, what, place_in(drawing, x)));
  };
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (const auto point = input::self_crossing(curves[i]))
      fail(fmt::format("the outline that begins in line {} crosses or touches itself", loops[i].line),
           *point);
    for (std::size_t j = 0; j < i; ++j)
      if (const auto point = common_point(curves[j], curves[i]))
        fail(fmt::format("the outlines that begin in lines {} and {} meet", loops[j].line, loops[i].line),
             *point);
  }
}

} // namespace

std::string place_in(const DrawnFile& drawing, const Vec2& x) {
  return fmt::format("({:.7g}, {:.7g}) {}", x.x(), x.y(), drawing.unit->name);
}

void merge_straight_pieces(Curve& curve) {
  std::vector<CurvePiece> merged;
  const auto goes_on = [](const CurvePiece& a, const CurvePiece& b) {
    return !a.is_arc() && !b.is_arc() && a.name == b.name && (a.tangent(1.0) - b.tangent(0.0)).norm() < 1e-6;
  };
  for (const CurvePiece& piece : curve.pieces)
    if (!merged.empty() && goes_on(merged.back(), piece))
      merged.back().to = piece.to;
    else
      merged.push_back(piece);
  if (merged.size() > 1 && goes_on(merged.back(), merged.front())) {
    merged.front().from = merged.back().from;
    merged.pop_back();
  }
  curve.pieces = std::move(merged);
}

std::vector<Loop> closed_loops(const DrawnFile& drawing, const std::vector<DrawnCurve>& curves,
                               double tolerance) {
  std::vector<Loop> loops = Chains(drawing, curves, tolerance).loops();
  if (drawing.of_a_mesh)
    for (Loop& loop : loops) merge_straight_pieces(loop.curve);
  refuse_crossings(drawing, loops);
  return loops;
}

} // namespace cnem::input
