// Boundaries of meshes in gmsh's MSH files, versions 2.2 and 4.1 in text.
#include "input/drawings/drawing.hpp"
#include "input/schema/finite_number.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace cnem::input {
namespace {

using Tag = long;
using TagPair = std::pair<Tag, Tag>; ///< of nodes, or of a dimension and a tag

/// Corners of the elements that are read, by gmsh's numbers of types.
constexpr std::array<std::pair<Tag, int>, 4> corners_of_type{{{1, 2}, {2, 3}, {3, 4}, {15, 1}}};

class MshReader {
public:
  MshReader(std::string_view text, const std::string& file) : text_(text) {
    drawing_.file = file;
    drawing_.of_a_mesh = true;
  }

  DrawnFile read() {
    bool elements = false;
    for (std::string_view section = word(); !section.empty(); section = word()) {
      if (!section.starts_with('$'))
        fail(fmt::format("found '{}', expected a section of gmsh such as $MeshFormat", shortened(section)));
      section_ = section;
      if (section == "$MeshFormat")
        format();
      else if (version_ == 0)
        fail(fmt::format("found {}, expected $MeshFormat at the beginning", shortened(section)));
      else if (section == "$PhysicalNames")
        names();
      else if (section == "$Entities" && version_ == 4)
        entities();
      else if (section == "$Nodes")
        version_ == 4 ? nodes_in_blocks() : nodes();
      else if (section == "$Elements")
        elements = true, version_ == 4 ? elements_in_blocks() : this->elements();
      else
        skip();
      const std::string end = "$End" + std::string(section.substr(1));
      if (const std::string_view found = needed(); found != end)
        fail(fmt::format("found '{}', expected {}", shortened(found), end));
    }
    if (!elements) fail("found no section $Elements, expected one with the lines or triangles of a mesh");
    hand_over();
    return std::move(drawing_);
  }

private:
  [[noreturn]] void fail(const std::string& message) const {
    throw DrawingError(drawing_.file, line_, message);
  }

  /// The next word, or text in quotes; empty at the end of the file.
  std::string_view word() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])))
      line_ += text_[at_++] == '\n';
    std::size_t end = at_;
    if (at_ < text_.size() && text_[at_] == '"')
      end = std::min(text_.find('"', at_ + 1), text_.size() - 1) + 1;
    else
      while (end < text_.size() && !std::isspace(static_cast<unsigned char>(text_[end]))) ++end;
    const std::string_view found = text_.substr(at_, end - at_);
    at_ = end;
    return found;
  }
  std::string_view needed() {
    const std::string_view found = word();
    if (found.empty())
      fail(fmt::format("the file ends in the section {}, expected $End{}: it was cut short", section_,
                       section_.substr(1)));
    return found;
  }
  double number() {
    const std::string_view found = needed();
    const auto value = finite_number(found);
    if (!value)
      fail(fmt::format("found '{}' in the section {}, expected a finite number", shortened(found), section_));
    return *value;
  }
  Tag whole() {
    const double value = number();
    if (value != std::floor(value) || std::abs(value) > 1e15)
      fail(fmt::format("found {:g} in the section {}, expected a whole number", value, section_));
    return static_cast<Tag>(value);
  }
  void pass(Tag count) {
    while (count-- > 0) needed();
  }

  void skip() {
    const std::string end = "$End" + std::string(section_.substr(1));
    std::size_t before = at_, line = line_;
    while (needed() != end) before = at_, line = line_;
    at_ = before;
    line_ = line;
  }

  void format() {
    const double version = number();
    if (version != 2.2 && version != 4.1)
      fail(fmt::format("found the version {:g} of the format MSH, expected 2.2 or 4.1", version));
    if (whole() != 0) fail("found a binary mesh, expected text: Mesh.Binary = 0");
    pass(1);
    version_ = version == 2.2 ? 2 : 4;
  }

  void names() {
    for (Tag n = whole(); n > 0; --n) {
      const Tag dimension = whole(), tag = whole();
      std::string_view name = needed();
      if (name.starts_with('"')) name = name.substr(1, name.size() - 2);
      names_[{dimension, tag}] = name;
      if (dimension == 1) drawing_.add_layer(std::string(name));
    }
  }

  /// Of each curve the first physical group, which 4.1 gives here and 2.2 with each element.
  void entities() {
    const std::array<Tag, 4> count{whole(), whole(), whole(), whole()};
    for (Tag dimension = 0; dimension < 4; ++dimension)
      for (Tag n = 0; n < count[static_cast<std::size_t>(dimension)]; ++n) {
        const Tag tag = whole();
        pass(dimension == 0 ? 3 : 6);
        const Tag groups = whole();
        for (Tag k = 0; k < groups; ++k)
          if (const Tag group = whole(); k == 0) group_[{dimension, tag}] = group;
        if (dimension > 0) pass(whole());
      }
  }

  void node(Tag tag) {
    const double x = number(), y = number();
    pass(1);
    nodes_[tag] = {x, y};
  }
  void nodes() {
    for (Tag n = whole(); n > 0; --n) node(whole());
  }
  void nodes_in_blocks() {
    const Tag blocks = whole();
    pass(3);
    for (Tag block = 0; block < blocks; ++block) {
      const Tag dimension = whole();
      pass(1);
      if (whole() != 0)
        fail(
            fmt::format("found nodes with parameters on entities of dimension {}, expected none", dimension));
      std::vector<Tag> tags;
      for (Tag n = whole(); n > 0; --n) tags.push_back(whole());
      for (const Tag tag : tags) node(tag);
    }
  }

  void elements() {
    for (Tag n = whole(); n > 0; --n) {
      pass(1);
      const Tag type = whole(), tags = whole();
      const Tag group = tags > 0 ? whole() : 0;
      pass(tags - 1);
      element(type, group);
    }
  }
  void elements_in_blocks() {
    const Tag blocks = whole();
    pass(3);
    for (Tag block = 0; block < blocks; ++block) {
      const Tag dimension = whole(), entity = whole(), type = whole();
      const auto group = group_.find({dimension, entity});
      for (Tag n = whole(); n > 0; --n) {
        pass(1);
        element(type, group == group_.end() ? 0 : group->second);
      }
    }
  }

  void element(Tag type, Tag group) {
    const auto known = std::find_if(corners_of_type.begin(), corners_of_type.end(),
                                    [&](const auto& one) { return one.first == type; });
    if (known == corners_of_type.end())
      fail(
          fmt::format("found an element of type {}, expected lines, triangles and quadrangles of first order "
                      "(1, 2, 3) in the plane",
                      type));
    std::array<Tag, 4> corner{};
    for (int k = 0; k < known->second; ++k) {
      Tag& tag = corner[static_cast<std::size_t>(k)] = whole();
      if (!nodes_.contains(tag))
        fail(fmt::format("found an element with the node {}, expected one of $Nodes", tag));
    }
    if (type == 1) lines_.push_back({corner[0], corner[1], group, line_});
    if (type == 2 || type == 3)
      for (int k = 0; k < known->second; ++k) {
        const Tag a = corner[static_cast<std::size_t>(k)],
                  b = corner[static_cast<std::size_t>((k + 1) % known->second)];
        Side& side = sides_[{std::min(a, b), std::max(a, b)}];
        side = {a, b, group, line_, side.count + 1};
      }
  }

  void hand_over() {
    for (const Line& line : lines_) add(line.from, line.to, 1, line.group, line.line);
    if (lines_.empty())
      for (const auto& [ends, side] : sides_)
        if (side.count == 1) add(side.from, side.to, 2, side.group, side.line);
  }

  void add(Tag from, Tag to, Tag dimension, Tag group, std::size_t line) {
    const auto name = names_.find({dimension, group});
    CurvePiece piece{nodes_[from], nodes_[to], {0, 0}, 0.0, false, {}};
    piece.name = name != names_.end() ? name->second : group > 0 ? fmt::format("{}", group) : "boundary";
    drawing_.add_layer(piece.name);
    drawing_.add({std::move(piece), line, false});
  }

  struct Line {
    Tag from, to, group;
    std::size_t line;
  };
  struct Side {
    Tag from = 0, to = 0, group = 0;
    std::size_t line = 0;
    int count = 0;
  };

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
  std::string_view section_ = "$MeshFormat";
  int version_ = 0;
  std::map<TagPair, std::string> names_;
  std::map<TagPair, Tag> group_;
  std::map<Tag, Vec2> nodes_;
  std::vector<Line> lines_;
  std::map<TagPair, Side> sides_; ///< of triangles and quadrangles
  DrawnFile drawing_;
};

} // namespace

DrawnFile read_msh(std::string_view text, const std::string& file) { return MshReader(text, file).read(); }

} // namespace cnem::input
