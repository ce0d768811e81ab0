#include "input/outline.hpp"

#include "input/curve_checks.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::input {
namespace {

/// A corner of the curve: the radius that rounds it, and the key that asked for it.
struct Corner {
  double fillet = 0.0;
  std::string name;
  std::string key;
};

/// Pieces from corner to corner; corners[i] is where piece i ends.
struct Draft {
  std::vector<CurvePiece> pieces;
  std::vector<Corner> corners;
  std::vector<std::string> keys; ///< of each piece
};

CurvePiece arc_from_path(const Setting& item, CurvePiece piece, double size, const std::string& key) {
  const auto centre = item.maybe<Vec2>("centre");
  const auto radius = item.maybe<double>("radius");
  piece.clockwise = item.get<bool>("clockwise");
  if (centre && radius)
    throw OutlineError(key + ".radius",
                       "an arc has either a centre or a radius, found both, expected one of them");
  if (!centre && !radius) {
    if (piece.clockwise)
      throw OutlineError(key + ".clockwise", "only an arc has a sense, expected centre or radius beside it");
    return piece;
  }
  if (centre) {
    const double r0 = (piece.from - *centre).norm(), r1 = (piece.to - *centre).norm();
    if (std::abs(r0 - r1) > 1e-6 * std::max(r0, r1) || r0 <= 1e-9 * size)
      throw OutlineError(
          key + ".centre",
          fmt::format("the ends of the arc, {} and {}, lie at {:g} m and {:g} m from its centre {}, "
                      "expected the same distance",
                      show(piece.from), show(piece.to), r0, r1, show(*centre)));
    piece.centre = *centre;
    piece.radius = 0.5 * (r0 + r1);
    return piece;
  }
  const Vec2 chord = piece.to - piece.from;
  const double half = 0.5 * chord.norm();
  if (half > *radius * (1.0 + 1e-9) || half <= 0.5e-9 * size)
    throw OutlineError(
        key + ".radius",
        fmt::format("no arc of radius {:g} m joins {} and {}, which are {:g} m apart, expected "
                    "at least half of that",
                    *radius, show(piece.from), show(piece.to), 2.0 * half));
  const double height = std::sqrt(std::max(0.0, (*radius - half) * (*radius + half)));
  const Vec2 to_centre = (piece.clockwise ? right_normal(chord) : left_normal(chord)).normalized();
  piece.centre = 0.5 * (piece.from + piece.to) + height * to_centre;
  piece.radius = std::max(*radius, half);
  return piece;
}

/// Pieces of a `path` from `start` on, each named `name` unless it says; ends at the start are that.
std::vector<CurvePiece> path_pieces(const Setting& table, const std::string& name) {
  const std::vector<Setting>& items = table.entries("path");
  const auto start = table.maybe<Vec2>("start");
  if (!start) throw OutlineError("start", "missing, expected the first corner such as \"0 0 mm\"");
  if (items.empty()) throw OutlineError("path", "is empty, expected pieces such as { to = \"20 0 mm\" }");
  double size = 0.0;
  for (const Setting& item : items) size = std::max(size, (item.get<Vec2>("to") - *start).norm());
  const double same_point = 1e-9 * size;
  std::vector<CurvePiece> pieces;
  Vec2 at = *start;
  for (const Setting& item : items) {
    const std::string key = "path" + item.name;
    CurvePiece piece{at, item.get<Vec2>("to"), {0, 0}, 0.0, false, name};
    if ((piece.to - *start).norm() <= same_point) piece.to = *start;
    if (const auto given = item.maybe<std::string>("name")) piece.name = *given;
    piece = arc_from_path(item, piece, size, key);
    if (!piece.is_arc() && (piece.to - piece.from).norm() <= same_point)
      throw OutlineError(
          key + ".to",
          fmt::format("the piece has no length, it begins and ends at {}, expected another point", show(at)));
    at = piece.to;
    pieces.push_back(piece);
  }
  return pieces;
}

Draft draft_of_path(const Setting& table, const std::string& curve_name) {
  Draft draft;
  draft.pieces = path_pieces(table, curve_name);
  const std::vector<Setting>& items = table.entries("path");
  for (std::size_t k = 0; k < items.size(); ++k) {
    const std::string key = "path" + items[k].name;
    draft.corners.push_back({items[k].maybe<double>("fillet").value_or(0.0),
                             items[k].maybe<std::string>("fillet_name").value_or(draft.pieces[k].name),
                             key + ".fillet"});
    if (items[k].find("fillet_name") && !items[k].find("fillet"))
      throw OutlineError(key + ".fillet_name", "there is no fillet to name, expected one beside it");
    draft.keys.push_back(key + ".to");
  }
  const Vec2 start = draft.pieces.front().from, at = draft.pieces.back().to;
  const auto close = table.maybe<std::string>("close");
  if (at != start) {
    draft.pieces.push_back({at, start, {0, 0}, 0.0, false, close.value_or(curve_name)});
    draft.corners.push_back({});
    draft.keys.push_back("close");
  } else if (close) {
    throw OutlineError(
        "close", "the path ends where it starts, so no piece is left that could be named, expected no name");
  }
  return draft;
}

Draft draft_of_rectangle(const Setting& table, const OutlineNames& names) {
  const Vec2 a = table.get<Vec2>("rectangle.from"), b = table.get<Vec2>("rectangle.to");
  const Vec2 low = a.cwiseMin(b), high = a.cwiseMax(b);
  if (!((high - low).minCoeff() > 1e-9 * (high - low).norm()))
    throw OutlineError(
        "rectangle.to",
        fmt::format("a rectangle from {} to {} has no area, expected opposite corners", show(a), show(b)));
  const double fillet = table.maybe<double>("rectangle.fillet").value_or(0.0);
  const Vec2 corner[] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  const char* side[] = {"bottom", "right", "top", "left"};
  Draft draft;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string standard = names.sides_of_rectangle ? side[k] : names.curve;
    const std::string name =
        table.maybe<std::string>(fmt::format("rectangle.names.{}", side[k])).value_or(standard);
    draft.pieces.push_back({corner[k], corner[(k + 1) % 4], {0, 0}, 0.0, false, name});
    draft.corners.push_back({fillet, name, "rectangle.fillet"});
    draft.keys.push_back("rectangle");
  }
  return draft;
}

Curve circle(const Setting& table, const std::string& curve_name) {
  const Vec2 centre = table.get<Vec2>("circle.centre");
  const double radius = table.get<double>("circle.radius");
  const Vec2 right = centre + Vec2(radius, 0.0);
  const std::string name = table.maybe<std::string>("circle.name").value_or(curve_name);
  return {{{right, right, centre, radius, false, name}}};
}

/// Replaces corners by tangent arcs.
Curve rounded(const Draft& draft) {
  const std::size_t n = draft.pieces.size();
  std::vector<double> cut(n, 0.0); // from the end of piece i and the start of the next, m
  for (std::size_t i = 0; i < n; ++i) {
    const Corner& corner = draft.corners[i];
    if (corner.fillet == 0.0) continue;
    const CurvePiece &before = draft.pieces[i], &after = draft.pieces[(i + 1) % n];
    if (before.is_arc() || after.is_arc())
      throw OutlineError(
          corner.key,
          "a fillet joins two straight pieces, found an arc, expected that arc to be written as a piece");
    const Vec2 d = before.tangent(1.0), e = after.tangent(0.0);
    const double turn = std::abs(std::atan2(cross(d, e), d.dot(e)));
    if (turn < 1e-6 || turn > std::numbers::pi - 1e-6)
      throw OutlineError(
          corner.key,
          fmt::format("there is no corner to round at {}, expected pieces at an angle", show(before.to)));
    cut[i] = corner.fillet * std::tan(0.5 * turn);
  }
  const auto check_fit = [&](std::size_t piece, std::size_t corner) {
    if (cut[corner] == 0.0) return;
    const double length = draft.pieces[piece].length();
    const double taken = cut[(piece + n - 1) % n] + cut[piece];
    if (taken > length * (1.0 + 1e-9))
      throw OutlineError(
          draft.corners[corner].key,
          fmt::format("a radius of {:g} m does not fit at {}: fillets take {:g} m of a piece of "
                      "{:g} m, expected a smaller radius",
                      draft.corners[corner].fillet, show(draft.pieces[corner].to), taken, length));
  };
  Curve curve;
  for (std::size_t i = 0; i < n; ++i) {
    check_fit(i, i);
    check_fit((i + 1) % n, i);
  }
  for (std::size_t i = 0; i < n; ++i) {
    CurvePiece piece = draft.pieces[i];
    const double length = piece.length(), before = cut[(i + n - 1) % n], after = cut[i];
    const Vec2 d = piece.tangent(0.0), corner = piece.to;
    if (before > 0.0) piece.from += before * d;
    if (after > 0.0) piece.to -= after * d;
    if (before + after < length * (1.0 - 1e-9)) curve.pieces.push_back(piece);
    if (after == 0.0) continue;
    const Vec2 e = draft.pieces[(i + 1) % n].tangent(0.0);
    const bool left = cross(d, e) > 0.0;
    const double radius = draft.corners[i].fillet;
    const Vec2 centre = piece.to + radius * (left ? left_normal(d) : right_normal(d));
    curve.pieces.push_back({piece.to, corner + after * e, centre, radius, !left, draft.corners[i].name});
  }
  // Where fillets take a whole piece, the arcs on either side must join exactly.
  for (std::size_t i = 0; i < curve.pieces.size(); ++i)
    curve.pieces[(i + 1) % curve.pieces.size()].from = curve.pieces[i].to;
  return curve;
}

void rotate(Curve& curve, double angle, const Vec2& centre) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](const Vec2& x) -> Vec2 {
    const Vec2 d = x - centre;
    return centre + Vec2(c * d.x() - s * d.y(), s * d.x() + c * d.y());
  };
  for (CurvePiece& piece : curve.pieces) {
    piece.from = turned(piece.from);
    piece.to = turned(piece.to);
    if (piece.is_arc()) piece.centre = turned(piece.centre);
  }
}

} // namespace

std::string fault_of_piece_name(const std::string& name) {
  if (valid_name(name) && name != "all") return "";
  return fmt::format(
      "found a piece named {}, expected a name of at most {} letters, digits, '_' and '-', and "
      "not \"all\", which stands for every piece",
      toml_quoted(shortened(name)), longest_name);
}

Curve split_long_arcs(const Curve& curve) {
  Curve result;
  for (const CurvePiece& piece : curve.pieces) {
    if (std::abs(piece.sweep()) <= std::numbers::pi * (1.0 + 1e-9)) {
      result.pieces.push_back(piece);
      continue;
    }
    CurvePiece first = piece, second = piece;
    first.to = second.from = piece.point(0.5);
    result.pieces.push_back(first);
    result.pieces.push_back(second);
  }
  return result;
}

Curve make_outline(const Setting& table, const OutlineNames& names) {
  const bool has_path = table.find("path") || table.find("start");
  const bool has_rectangle = table.find("rectangle"), has_circle = table.find("circle");
  if (int(has_path) + int(has_rectangle) + int(has_circle) != 1)
    throw OutlineError("", "expected either start and path, or rectangle, or circle, or drawing");
  if (!has_path && table.find("close"))
    throw OutlineError("close", "only a path has a closing piece, expected start and path beside it");

  Curve curve =
      has_circle ? circle(table, names.curve)
                 : rounded(has_path ? draft_of_path(table, names.curve) : draft_of_rectangle(table, names));
  curve = split_long_arcs(curve);
  const std::string form = has_path ? "path" : has_circle ? "circle" : "rectangle";
  if (const auto point = self_crossing(curve))
    throw OutlineError(
        form,
        fmt::format("the outline crosses or touches itself at {}, expected a simple curve", show(*point)));
  for (const CurvePiece& piece : curve.pieces)
    if (const std::string fault = fault_of_piece_name(piece.name); !fault.empty())
      throw OutlineError(form, fault);
  const double size = extent(curve);
  if (!(std::abs(curve.area()) > 1e-9 * size * size))
    throw OutlineError(form, "the outline encloses no area, expected at least three corners or an arc");
  if (table.find("rotate"))
    rotate(curve, table.get<double>("rotate.angle"), table.get<Vec2>("rotate.centre"));
  return curve.area() < 0.0 ? curve.reversed() : curve;
}

std::vector<CurvePiece> pieces_of_path(const Setting& table) { return path_pieces(table, ""); }

} // namespace cnem::input
