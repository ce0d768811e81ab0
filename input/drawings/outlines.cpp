#include "input/drawings/outlines.hpp"

#include "input/curve_checks.hpp"
#include "input/drawings/loops.hpp"
#include "input/outline.hpp"
#include "input/schema/nearest.hpp"
#include "input/schema/settings.hpp"
#include "input/schema/units.hpp"
#include "input/schema/written_values.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace cnem::input {
namespace {

using Kind = Value::Kind;

/// The layer as the name of a piece: layers may be called anything.
std::string piece_name(std::string layer) {
  for (char& c : layer)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  if (layer.size() > longest_name) layer.resize(longest_name);
  return layer.empty() ? "_" : layer;
}

/// From the coordinates of a drawing to those of the case, in the unit that the case is given.
class Placement {
public:
  Placement(const Setting& table, const DrawingUnit& unit) : unit_(unit) {
    factor_ = unit.factor * table.get<double>("scale");
    const auto mirror = table.maybe<std::string>("mirror");
    flip_ = {mirror == "x" ? -1.0 : 1.0, mirror == "y" ? -1.0 : 1.0};
    turn_ = on_circle({0, 0}, 1.0, table.get<double>("rotate") * 180.0 / std::numbers::pi);
    shift_ = table.get<Vec2>("shift") / parse_unit(unit.written).to_si(1.0);
  }

  bool reverses() const { return flip_.x() * flip_.y() < 0.0; }
  std::string point(const Vec2& drawn) const {
    const Vec2 x = factor_ * drawn.cwiseProduct(flip_);
    const Vec2 turned(turn_.x() * x.x() - turn_.y() * x.y(), turn_.y() * x.x() + turn_.x() * x.y());
    const Vec2 placed = turned + shift_ + Vec2(0.0, 0.0); // no negative zeros
    return fmt::format("{} {} {}", format_number(placed.x()), format_number(placed.y()), unit_.written);
  }
  std::string length(double drawn) const {
    return fmt::format("{} {}", format_number(factor_ * drawn), unit_.written);
  }

private:
  DrawingUnit unit_;
  double factor_ = 1.0;
  Vec2 flip_{1, 1}, turn_{1, 0}, shift_{0, 0};
};

/// A corner that the case rounds.
struct Fillet {
  Vec2 at{0, 0}; ///< in the drawing
  double radius = 0.0;
};

/// What a table `drawing` asks for, read from its file.
struct Sheet {
  DrawnFile drawing;
  std::vector<Loop> loops;
  std::vector<Fillet> fillets; ///< radii in m
};

class Drawings {
public:
  Drawings(Value& document, std::filesystem::path folder, Diagnostics& diagnostics)
      : document_(document), folder_(std::move(folder)), diagnostics_(diagnostics) {}

  void take() {
    if (Member* domain = table_at(document_, "domain")) {
      whole_domain(domain->value);
      if (Member* outer = table_at(domain->value, "outer"))
        outline(outer->value, "domain.outer", "domain.outer", "outer");
      each_of(domain->value, "holes", "domain.holes");
    }
    each_of(document_, "tools", "tools");
    if (Member* tools = table_at(document_, "tools"))
      for (Member& tool : tools->value.members)
        if (Member* profile = table_at(tool.value, "profile"))
          outline(profile->value, "tools.*.profile", fmt::format("tools.{}.profile", tool.key), tool.key);
  }

private:
  static Member* table_at(Value& table, std::string_view key) {
    Member* member = table.find(key);
    return member && member->value.kind == Kind::table ? member : nullptr;
  }

  void each_of(Value& table, std::string_view key, const std::string& path) {
    if (Member* all = table_at(table, key))
      for (Member& one : all->value.members)
        if (one.value.kind == Kind::table)
          outline(one.value, path + ".*", fmt::format("{}.{}", path, one.key), one.key);
  }

  /// Takes the table `drawing` out and reads what it asks for; nothing, and a mistake told, where it cannot.
  /// f(sheet, placement, where) puts outlines in its place.
  template<class F>
  void with_drawing(Value& table, const std::string& pattern, const std::string& path,
                    const std::string& name, std::initializer_list<const char*> other_forms, const F& f) {
    const Member* found = table.find("drawing");
    if (!found) return;
    const Member drawing = *found;
    std::erase_if(table.members, [](const Member& member) { return member.key == "drawing"; });
    const std::string key = path + ".drawing";
    for (const char* rival : other_forms)
      if (const Member* other = table.find(rival)) {
        diagnostics_.add(Mistake::conflict, other->where, fmt::format("{}.{}", path, rival),
                         fmt::format("found beside {}, expected one of them", key));
        return;
      }
    if (drawing.value.kind != Kind::table) {
      diagnostics_.add(
          Mistake::type, drawing.value.where, key,
          fmt::format("found {}, expected a table such as {{ file = \"part.dxf\" }}", drawing.value.show()));
      return;
    }
    const Setting setting = apply_schema(drawing.value, pattern + ".drawing", key, diagnostics_, &document_);
    if (!diagnostics_.empty()) return;
    try {
      Sheet sheet = read(setting, name);
      f(sheet, Placement(setting, *sheet.drawing.unit), drawing.where);
    } catch (const DrawingError& error) {
      diagnostics_.add(Mistake::geometry, drawing.where, key, error.what());
    }
  }

  void outline(Value& table, const std::string& pattern, const std::string& path, const std::string& name) {
    with_drawing(table, pattern, path, name, {"start", "path", "close", "rectangle", "circle"},
                 [&](const Sheet& sheet, const Placement& placement, const Location& where) {
                   if (sheet.loops.size() != 1) fail_of_several(sheet);
                   put_outline(table, sheet, sheet.loops.front(), placement, where);
                 });
  }

  [[noreturn]] static void fail_of_several(const Sheet& sheet) {
    std::vector<std::string> begins;
    for (const Loop& loop : sheet.loops)
      if (begins.size() < 5)
        begins.push_back(fmt::format("one at {} on layer {}",
                                     place_in(sheet.drawing, loop.curve.pieces.front().from),
                                     toml_quoted(shortened(loop.curve.pieces.front().name))));
    throw DrawingError(
        fmt::format("{}: found {} closed outlines: {}; expected one: `layers` says which layers belong "
                    "to it",
                    sheet.drawing.file, sheet.loops.size(), fmt::join(begins, ", ")));
  }

  void whole_domain(Value& domain) {
    with_drawing(domain, "domain", "domain", "", {"outer", "block"},
                 [&](const Sheet& sheet, const Placement& placement, const Location& where) {
                   const std::size_t outer = outer_loop(sheet);
                   Value table = table_value(where);
                   put_outline(table, sheet, sheet.loops[outer], placement, where);
                   put(domain, "outer", std::move(table));
                   put_holes(domain, sheet, outer, placement, where);
                 });
  }

  /// The loop that all others lie in. Throws DrawingError where there is none.
  static std::size_t outer_loop(const Sheet& sheet) {
    std::vector<Curve> curves;
    for (const Loop& loop : sheet.loops) curves.push_back(split_long_arcs(loop.curve));
    const auto size = [](const Curve& curve) { return std::abs(curve.area()); };
    const auto outer = static_cast<std::size_t>(
        std::max_element(curves.begin(), curves.end(),
                         [&](const Curve& a, const Curve& b) { return size(a) < size(b); }) -
        curves.begin());
    for (std::size_t k = 0; k < curves.size(); ++k) {
      if (k == outer) continue;
      const Vec2 x = curves[k].pieces.front().from;
      if (!inside(curves[outer], x)) fail_of_several(sheet);
      for (std::size_t j = 0; j < curves.size(); ++j)
        if (j != k && j != outer && inside(curves[j], x))
          throw DrawingError(
              fmt::format("{}: the outline that begins at {} lies in a hole, expected holes alone within "
                          "the outer one",
                          sheet.drawing.file, place_in(sheet.drawing, x)));
    }
    return outer;
  }

  void put_holes(Value& domain, const Sheet& sheet, std::size_t outer, const Placement& placement,
                 const Location& where) {
    std::map<std::string, int> count, next;
    for (std::size_t k = 0; k < sheet.loops.size(); ++k)
      if (k != outer) ++count[hole_name(sheet.loops[k])];
    if (count.empty()) return;
    if (!domain.find("holes")) put(domain, "holes", table_value(where));
    Value& holes = domain.find("holes")->value;
    for (std::size_t k = 0; k < sheet.loops.size(); ++k) {
      if (k == outer) continue;
      std::string name = hole_name(sheet.loops[k]);
      if (count[name] > 1) {
        const std::string number = fmt::format("_{}", ++next[name]);
        name.resize(std::min(name.size(), longest_name - number.size()));
        name += number;
      }
      if (const Member* other = holes.find(name)) {
        diagnostics_.add(Mistake::conflict, other->where, "domain.holes." + name,
                         "found beside a hole of that name in domain.drawing, expected another name");
        return;
      }
      Value table = table_value(where);
      put_outline(table, sheet, sheet.loops[k], placement, where);
      put(holes, name, std::move(table));
    }
  }

  static bool is_circle(const Loop& loop) {
    const CurvePiece& first = loop.curve.pieces.front();
    return first.is_arc() && first.from == first.to;
  }
  static std::string hole_name(const Loop& loop) { return piece_name(loop.curve.pieces.front().name); }

  static void put_outline(Value& table, const Sheet& sheet, const Loop& loop, const Placement& placement,
                          const Location& key) {
    const Location where{fmt::format("{}, from {}:{}", key.text(), sheet.drawing.file, loop.line), 0, 0};
    const CurvePiece& first = loop.curve.pieces.front();
    if (is_circle(loop)) {
      Value circle = table_value(where);
      put(circle, "centre", text_value(placement.point(first.centre), where));
      put(circle, "radius", text_value(placement.length(first.radius), where));
      put(circle, "name", text_value(piece_name(first.name), where));
      return put(table, "circle", std::move(circle));
    }
    put(table, "start", text_value(placement.point(first.from), where));
    Value path;
    path.kind = Kind::array;
    path.where = where;
    for (const CurvePiece& piece : loop.curve.pieces) {
      Value item = table_value(where);
      put(item, "to", text_value(placement.point(piece.to), where));
      if (piece.is_arc()) {
        put(item, "centre", text_value(placement.point(piece.centre), where));
        Value clockwise;
        clockwise.kind = Kind::boolean;
        clockwise.boolean = piece.clockwise != placement.reverses();
        clockwise.where = where;
        put(item, "clockwise", std::move(clockwise));
      }
      put(item, "name", text_value(piece_name(piece.name), where));
      for (const Fillet& fillet : sheet.fillets)
        if (fillet.at == piece.to)
          put(item, "fillet", text_value(format_number(fillet.radius) + " m", where));
      path.elements.push_back(std::move(item));
    }
    put(table, "path", std::move(path));
  }

  Sheet read(const Setting& table, const std::string& name) {
    const std::string path = (folder_ / table.get<std::string>("file")).lexically_normal().string();
    if (!read_.contains(path)) read_.emplace(path, read_drawing(path));
    Sheet sheet;
    sheet.drawing = read_.at(path);
    DrawnFile& drawing = sheet.drawing;
    if (const auto unit = table.maybe<std::string>("unit")) drawing.unit = drawing_unit(*unit);
    if (!drawing.unit)
      throw DrawingError(
          fmt::format("{}: found no unit of its lengths, expected it from the case: unit = \"mm\"", path));
    const std::vector<std::string> layers = chosen_layers(table, name, drawing);
    std::vector<DrawnCurve> curves;
    for (const DrawnCurve& curve : drawing.curves)
      if (std::find(layers.begin(), layers.end(), curve.piece.name) != layers.end()) curves.push_back(curve);
    refuse_unread(drawing, layers);
    for (const std::string& layer : layers)
      if (table.find("layers") && std::none_of(curves.begin(), curves.end(), [&](const DrawnCurve& curve) {
            return curve.piece.name == layer;
          }))
        throw DrawingError(fmt::format("{}: the layer {} has no curves, expected an outline on it", path,
                                       toml_quoted(shortened(layer))));
    if (curves.empty()) throw DrawingError(fmt::format("{}: found no curves, expected an outline", path));
    Curve all;
    for (const DrawnCurve& curve : curves) all.pieces.push_back(curve.piece);
    const double size = extent(all), metres = drawing.unit->metres;
    if (!(size > 0.0))
      throw DrawingError(path, curves.front().line,
                         fmt::format("found curves without length, all at {}, expected an outline",
                                     place_in(drawing, curves.front().piece.from)));
    const auto tolerance = table.maybe<double>("tolerance");
    sheet.loops =
        closed_loops(drawing, curves, tolerance ? std::max(*tolerance / metres, 1e-9 * size) : 1e-5 * size);
    for (const Setting& item : table.entries("names"))
      rename(sheet, item.get<Vec2>("at") / metres, item.get<std::string>("name"), size);
    for (const Setting& item : table.entries("fillets"))
      add_fillet(sheet, item.get<Vec2>("at") / metres, item.get<double>("radius"), size);
    return sheet;
  }

  static std::vector<std::string> chosen_layers(const Setting& table, const std::string& name,
                                                const DrawnFile& drawing) {
    const auto has = [](const std::vector<std::string>& list, const std::string& layer) {
      return std::find(list.begin(), list.end(), layer) != list.end();
    };
    if (const auto asked = table.maybe<std::vector<std::string>>("layers")) {
      for (const std::string& layer : *asked)
        if (!has(drawing.layers, layer))
          throw DrawingError(fmt::format("{}: found no layer {}, expected one of the layers {}{}",
                                         drawing.file, toml_quoted(shortened(layer)),
                                         fmt::join(drawing.layers, ", "),
                                         did_you_mean(layer, drawing.layers)));
      return *asked;
    }
    if (has(drawing.layers, name)) return {name};
    std::vector<std::string> shown;
    for (const std::string& layer : drawing.layers)
      if (!has(drawing.hidden, layer)) shown.push_back(layer);
    return shown;
  }

  static void refuse_unread(const DrawnFile& drawing, const std::vector<std::string>& layers) {
    for (const UnreadEntity& entity : drawing.unread)
      if (std::find(layers.begin(), layers.end(), entity.layer) != layers.end())
        throw DrawingError(
            drawing.file, entity.line,
            fmt::format("the layer {} has {}", toml_quoted(shortened(entity.layer)), entity.what));
  }

  static constexpr double near_enough = 0.05; ///< of the size of the drawing

  static void rename(Sheet& sheet, const Vec2& at, const std::string& name, double size) {
    if (!valid_name(name))
      throw DrawingError(fmt::format("found the name {}, expected at most {} letters, digits, '_' and '-'",
                                     toml_quoted(shortened(name)), longest_name));
    CurvePiece* nearest = nullptr;
    double least = std::numeric_limits<double>::max();
    for (Loop& loop : sheet.loops)
      for (CurvePiece& piece : loop.curve.pieces)
        if (const double d = distance(split_long_arcs({{piece}}), at); d < least) least = d, nearest = &piece;
    if (least > near_enough * size)
      throw DrawingError(
          fmt::format("{}: found no curve near {}, where one is named {}: the nearest is {:.4g} {} away; "
                      "expected a place as it reads in the drawing",
                      sheet.drawing.file, place_in(sheet.drawing, at), toml_quoted(shortened(name)), least,
                      sheet.drawing.unit->name));
    nearest->name = name;
  }

  static void add_fillet(Sheet& sheet, const Vec2& at, double radius, double size) {
    Vec2 nearest = Vec2::Constant(std::numeric_limits<double>::max());
    bool circle = false;
    for (const Loop& loop : sheet.loops)
      for (const CurvePiece& piece : loop.curve.pieces)
        if ((piece.to - at).norm() < (nearest - at).norm()) {
          nearest = piece.to;
          circle = is_circle(loop);
        }
    if ((nearest - at).norm() > near_enough * size)
      throw DrawingError(
          fmt::format("{}: found no corner near {}, where a fillet is asked for: the nearest is at {}; "
                      "expected a place as it reads in the drawing",
                      sheet.drawing.file, place_in(sheet.drawing, at), place_in(sheet.drawing, nearest)));
    if (circle)
      throw DrawingError(fmt::format("{}: found a whole circle at {}, where a fillet is asked for, expected "
                                     "a corner between two curves",
                                     sheet.drawing.file, place_in(sheet.drawing, nearest)));
    for (const Fillet& other : sheet.fillets)
      if (other.at == nearest)
        throw DrawingError(fmt::format("{}: found two fillets of the corner at {}, expected one",
                                       sheet.drawing.file, place_in(sheet.drawing, nearest)));
    sheet.fillets.push_back({nearest, radius});
  }

  Value& document_;
  std::filesystem::path folder_;
  Diagnostics& diagnostics_;
  std::map<std::string, DrawnFile> read_;
};

} // namespace

void take_from_drawings(Value& document, const std::filesystem::path& folder, Diagnostics& diagnostics) {
  Drawings(document, folder, diagnostics).take();
}

} // namespace cnem::input
