// Drawings in DXF, as Autodesk's reference of the format describes it: pairs of lines, a group code and a
// value.
#include "input/drawings/drawing.hpp"
#include "input/schema/finite_number.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace cnem::input {
namespace {

struct Group {
  int code = 0;
  std::string_view value;
  std::size_t line = 0; ///< of the value
};

/// An entity, a row of a table or a section: what stands from one group 0 to the next.
struct Entity {
  std::string_view type;
  std::size_t line = 0;
  std::vector<Group> groups;

  const Group* find(int code) const {
    const auto at =
        std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.code == code; });
    return at == groups.end() ? nullptr : &*at;
  }
  std::string text(int code, const char* otherwise) const {
    const Group* group = find(code);
    return std::string(group ? group->value : otherwise);
  }
};

/// Entities that hold words and dimensions, not outlines.
constexpr std::array annotations{"TEXT",    "MTEXT",      "DIMENSION", "LEADER", "MULTILEADER", "HATCH",
                                 "POINT",   "VIEWPORT",   "ATTDEF",    "ATTRIB", "TOLERANCE",   "IMAGE",
                                 "WIPEOUT", "ACAD_TABLE", "XLINE",     "RAY"};

class DxfReader {
public:
  DxfReader(std::string_view text, const std::string& file) : text_(text) { drawing_.file = file; }

  DrawnFile read() {
    if (text_.starts_with("AutoCAD Binary DXF"))
      fail(1, "found a binary DXF, expected the same drawing saved as text (ASCII DXF)");
    if (text_.starts_with("AC10")) fail(1, "found a DWG, expected the same drawing saved as DXF");
    std::vector<Entity> entities;
    for (Group group = next(); !(group.code == 0 && group.value == "EOF"); group = next()) {
      if (group.code == 0) {
        entities.push_back({group.value, group.line, {}});
        if (group.value == "ENDSEC") section_ = {};
        continue;
      }
      if (entities.empty()) {
        if (group.code == 999) continue; // a comment
        fail(group.line - 1, "found no DXF, expected 0 and SECTION at its beginning");
      }
      entities.back().groups.push_back(group);
      if (entities.back().type == "SECTION" && group.code == 2) section_ = group.value;
    }
    take(entities);
    if (!has_entities_) fail(line_, "found no section ENTITIES, expected one with the curves of a drawing");
    return std::move(drawing_);
  }

private:
  [[noreturn]] void fail(std::size_t line, const std::string& message) const {
    throw DrawingError(drawing_.file, line, message);
  }

  std::string_view next_line() {
    if (at_ >= text_.size())
      fail(line_, fmt::format("the file ends{}, expected 0 and EOF at its end: it was cut short",
                              section_.empty() ? "" : fmt::format(" in the section {}", section_)));
    const auto end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    return trimmed(line);
  }

  Group next() {
    const std::string_view code = next_line();
    const std::optional<double> number = finite_number(code);
    if (!number || *number != std::floor(*number) || std::abs(*number) > 2000.0)
      fail(line_, fmt::format("found '{}', expected a group code of DXF, a whole number", shortened(code)));
    const std::string_view value = next_line();
    return {static_cast<int>(*number), value, line_};
  }

  double number(const Group& group) const {
    const std::optional<double> value = finite_number(group.value);
    if (!value) fail(group.line, fmt::format("found '{}', expected a finite number", shortened(group.value)));
    return *value;
  }
  double number(const Entity& entity, int code, std::optional<double> otherwise = {}) const {
    const Group* group = entity.find(code);
    if (!group && !otherwise)
      fail(entity.line, fmt::format("the {} has no group {}, expected a number there", entity.type, code));
    return group ? number(*group) : *otherwise;
  }
  int flags(const Entity& entity) const {
    return static_cast<int>(std::clamp(number(entity, 70, 0.0), 0.0, 1e6));
  }
  Vec2 point(const Entity& entity, int code) const {
    return {number(entity, code), number(entity, code + 10)};
  }

  void take(const std::vector<Entity>& entities) {
    std::string_view section;
    for (std::size_t k = 0; k < entities.size(); ++k) {
      const Entity& entity = entities[k];
      if (entity.type == "SECTION") {
        const Group* name = entity.find(2);
        section = name ? name->value : std::string_view{};
        has_entities_ = has_entities_ || section == "ENTITIES";
        if (section == "HEADER") take_unit(entity);
      } else if (section == "TABLES" && entity.type == "LAYER") {
        const std::string layer = entity.text(2, "");
        drawing_.add_layer(layer);
        const bool off = number(entity, 62, 7.0) < 0.0, frozen = flags(entity) & 1,
                   plotted = number(entity, 290, 1.0) != 0.0 && layer != "Defpoints";
        if (off || frozen || !plotted) drawing_.hidden.push_back(layer);
      } else if (section == "ENTITIES" && number(entity, 67, 0.0) == 0.0) { // not on the sheet of paper
        if (entity.type == "POLYLINE")
          polyline(entity, vertices_after(entities, k));
        else
          take_entity(entity);
      }
    }
  }

  /// $INSUNITS: the variables of a header follow each other as groups of one "entity".
  void take_unit(const Entity& header) {
    static const std::array<const char*, 15> units{"",    "in",  "ft", "mi", "mm", "cm", "m", "km",
                                                   "uin", "mil", "",   "",   "nm", "um", "dm"};
    for (std::size_t k = 0; k + 1 < header.groups.size(); ++k) {
      if (header.groups[k].code != 9 || header.groups[k].value != "$INSUNITS") continue;
      const double code = number(header.groups[k + 1]);
      if (code >= 1.0 && code < double(units.size()) && *units[static_cast<std::size_t>(code)])
        drawing_.unit = drawing_unit(units[static_cast<std::size_t>(code)]);
    }
  }

  static std::vector<const Entity*> vertices_after(const std::vector<Entity>& entities, std::size_t k) {
    std::vector<const Entity*> vertices;
    for (++k; k < entities.size() && entities[k].type == "VERTEX"; ++k) vertices.push_back(&entities[k]);
    return vertices;
  }

  void take_entity(const Entity& entity) {
    if (entity.type == "VERTEX" || entity.type == "SEQEND" || entity.type == "ENDSEC") return;
    if (std::find(annotations.begin(), annotations.end(), entity.type) != annotations.end()) return;
    if (!enter(entity)) return;
    if (entity.type == "LINE") {
      mirrored_ = false; // the ends of lines are in the coordinates of the world
      add(entity.line, {point(entity, 10), point(entity, 11), {0, 0}, 0.0, false, {}});
    } else if (entity.type == "CIRCLE" || entity.type == "ARC") {
      const Vec2 centre = point(entity, 10);
      const double radius = number(entity, 40);
      if (!(radius > 0.0))
        fail(entity.find(40)->line, fmt::format("found a radius of {:g}, expected more than 0", radius));
      const bool whole = entity.type == "CIRCLE";
      const Vec2 from = on_circle(centre, radius, whole ? 0.0 : number(entity, 50));
      const Vec2 to = whole ? from : on_circle(centre, radius, number(entity, 51));
      add(entity.line, {from, to, centre, radius, false, {}}, true);
    } else if (entity.type == "LWPOLYLINE")
      lightweight_polyline(entity);
    else
      refuse(
          entity,
          entity.type == "INSERT"
              ? fmt::format("the block {} (INSERT), which is not read, expected it exploded",
                            toml_quoted(shortened(entity.text(2, ""))))
              : fmt::format("a curve of the kind {}, which is not read, expected lines and arcs in its place",
                            shortened(entity.type)));
  }

  /// Layer and plane of an entity; false where it does not lie in the plane of the drawing.
  bool enter(const Entity& entity) {
    layer_ = entity.text(8, "0");
    drawing_.add_layer(layer_);
    const double z = number(entity, 230, 1.0);
    mirrored_ = z < 0.0;
    if (std::abs(std::abs(z) - 1.0) < 1e-9) return true;
    refuse(entity,
           fmt::format("a curve of the kind {} in a plane of its own, expected all in that of x and y",
                       entity.type));
    return false;
  }

  void refuse(const Entity& entity, std::string what) {
    drawing_.unread.push_back({std::move(what), layer_, entity.line});
  }

  void lightweight_polyline(const Entity& entity) {
    corners_.clear();
    for (const Group& group : entity.groups) {
      if (group.code == 10) corners_.push_back({{number(group), 0.0}, 0.0, group.line});
      if (corners_.empty()) continue;
      if (group.code == 20) corners_.back().at.y() = number(group);
      if (group.code == 42) corners_.back().bulge = number(group);
    }
    join(flags(entity) & 1);
  }

  void polyline(const Entity& entity, const std::vector<const Entity*>& vertices) {
    if (!enter(entity)) return;
    constexpr int closed = 1, meshes = 16 | 64, frame_of_spline = 16;
    if (flags(entity) & meshes)
      return refuse(entity, "a POLYLINE that is a mesh in space, expected a plane one");
    corners_.clear();
    for (const Entity* vertex : vertices)
      if (!(flags(*vertex) & frame_of_spline))
        corners_.push_back({point(*vertex, 10), number(*vertex, 42, 0.0), vertex->line});
    join(flags(entity) & closed);
  }

  void join(bool closed) {
    const std::size_t n = corners_.size();
    for (std::size_t k = 0; k + (closed ? 0 : 1) < n; ++k) {
      const Vec2 from = corners_[k].at, to = corners_[(k + 1) % n].at, chord = to - from;
      if (closed && k + 1 == n && chord.norm() == 0.0) break; // the first corner is written again at the end
      CurvePiece piece{from, to, {0, 0}, 0.0, false, {}};
      constexpr double straight = 1e-9;       // rounding of the program that wrote it
      const double bulge = corners_[k].bulge; // the tangent of a quarter of the angle
      if (std::abs(bulge) > 1.0 / straight)
        fail(corners_[k].line, fmt::format("found a bulge of {:g} at a corner, expected that of an arc, "
                                           "such as 1 of half a turn",
                                           bulge));
      if (std::abs(bulge) >= straight) {
        piece.centre = 0.5 * (from + to) + (1.0 - bulge * bulge) / (4.0 * bulge) * left_normal(chord);
        piece.radius = 0.25 * chord.norm() * (1.0 + bulge * bulge) / std::abs(bulge);
        piece.clockwise = bulge < 0.0;
      }
      add(corners_[k].line, piece);
    }
  }

  void add(std::size_t line, CurvePiece piece, bool ends_calculated = false) {
    piece.name = layer_;
    if (mirrored_) {
      for (Vec2* x : {&piece.from, &piece.to, &piece.centre}) x->x() = -x->x();
      piece.clockwise = piece.is_arc() && !piece.clockwise;
    }
    drawing_.add({std::move(piece), line, ends_calculated});
  }

  struct Corner {
    Vec2 at;
    double bulge;
    std::size_t line;
  };

  std::string_view text_;
  std::size_t at_ = 0, line_ = 0;
  std::string_view section_; ///< for messages
  bool has_entities_ = false;
  std::string layer_;     ///< of the present entity
  bool mirrored_ = false; ///< it looks down at the plane: its x runs the other way
  std::vector<Corner> corners_;
  DrawnFile drawing_;
};

} // namespace

DrawnFile read_dxf(std::string_view text, const std::string& file) { return DxfReader(text, file).read(); }

} // namespace cnem::input
