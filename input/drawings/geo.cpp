// Drawings in the language of gmsh's .geo files, as far as outlines need it.
#include "input/drawings/drawing.hpp"
#include "input/drawings/geo_scanner.hpp"
#include "input/schema/document.hpp"
#include "input/schema/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace cnem::input {
namespace {

using Tag = long;

constexpr double largest_tag = 1e9;

bool is_tag(double number) { return number == std::round(number) && std::abs(number) <= largest_tag; }
/// Of a number in a list; nothing has the tag of one that is none.
Tag tag_of(double number) {
  return is_tag(number) ? static_cast<Tag>(number) : std::numeric_limits<Tag>::min();
}

struct GeoCurve {
  CurvePiece piece;
  std::size_t line = 0;
};

/// Commands that say how a mesh is made of what is drawn.
bool is_of_the_mesh(const std::string& word) {
  return word == "Mesh" || word.starts_with("Mesh.") || word == "Transfinite" || word == "Recombine" ||
         word == "MeshSize" || word == "Characteristic" || word == "SetFactory" || word == "Coherence" ||
         word.starts_with("General.") || word.starts_with("Geometry.");
}

class GeoReader : GeoScanner {
public:
  GeoReader(std::string_view text, const std::string& file) : GeoScanner(text, file) {
    drawing_.file = file;
    variables_["Pi"] = std::numbers::pi;
  }

  DrawnFile read() {
    while (now_.kind != GeoToken::Kind::end) statement();
    hand_over();
    return std::move(drawing_);
  }

private:
  void statement() {
    const GeoToken first = now_;
    if (first.kind != GeoToken::Kind::word)
      fail(now_.line, fmt::format("found {}, expected a command of gmsh", shown()));
    advance();
    if (is_of_the_mesh(first.text)) return skip();
    if (now_.is("=")) {
      advance();
      variables_[first.text] = finite();
      return expect(";");
    }
    if (first.text == "Point" && now_.is("(")) return point(first.line);
    if (first.text == "Line" && take("Loop")) return loop();
    if (first.text == "Curve" && take("Loop")) return loop();
    if (first.text == "Plane" && take("Surface")) return surface();
    if (first.text == "Physical") return physical(first.line);
    if (first.text == "Line" || first.text == "Circle") return curve(first);
    fail(first.line,
         fmt::format(
             "found the command '{}', expected one of those that are read: Point, Line, Circle, Curve Loop, "
             "Plane Surface, Physical Curve, and variables with numbers{}",
             shortened(first.text),
             did_you_mean(first.text, {"Point", "Line", "Circle", "Curve", "Plane", "Physical"})));
  }

  void skip() { // to the end of the command, whatever is in it
    while (now_.kind != GeoToken::Kind::end && !now_.is(";")) advance();
    expect(";");
  }

  Tag tag() {
    const std::size_t line = now_.line;
    const double value = finite();
    if (!is_tag(value)) fail(line, fmt::format("found {:g}, expected a whole number", value));
    return tag_of(value);
  }

  Tag head() { // (3) =
    expect("(");
    const Tag number = tag();
    expect(")");
    expect("=");
    return number;
  }

  std::vector<double> numbers() { // {1, 2:4, x};
    std::vector<double> list;
    expect("{");
    if (!now_.is("}")) do {
        const std::size_t line = now_.line;
        list.push_back(finite());
        if (take(":")) add_range(list, finite(), line);
      } while (take(","));
    expect("}");
    expect(";");
    return list;
  }

  /// Goes on in whole steps from the end of a list.
  void add_range(std::vector<double>& list, double to, std::size_t line) {
    constexpr double most = 1e6; // of all ranges of a file
    const double from = list.back(), length = std::abs(to - from);
    if (!(std::max(std::abs(from), std::abs(to)) <= largest_tag))
      fail(line, fmt::format("found a range from {:g} to {:g}, expected numbers of at most {:g}", from, to,
                             largest_tag));
    if ((in_ranges_ += length) > most)
      fail(line, "found more than a million numbers in ranges, expected less");
    for (double n = 1.0; n <= length; ++n) list.push_back(to > from ? from + n : from - n);
  }

  void point(std::size_t line) {
    const Tag number = head();
    const std::vector<double> x = numbers();
    if (x.size() < 3)
      fail(line, fmt::format("found {} coordinates of a point, expected x, y and z", x.size()));
    points_[number] = {x[0], x[1]};
  }

  const Vec2& point_of(double number, std::size_t line) const {
    const auto at = points_.find(tag_of(number));
    if (at == points_.end())
      fail(line, fmt::format("found no point {:g}, expected one defined before", number));
    return at->second;
  }

  void curve(const GeoToken& kind) {
    const Tag number = head();
    const std::vector<double> ends = numbers();
    CurvePiece piece;
    if (kind.text == "Line") {
      if (ends.size() != 2)
        fail(kind.line, fmt::format("found a line with {} points, expected 2", ends.size()));
      piece.from = point_of(ends[0], kind.line);
      piece.to = point_of(ends[1], kind.line);
    } else {
      if (ends.size() != 3)
        fail(kind.line,
             fmt::format("found a circle with {} points, expected start, centre and end", ends.size()));
      piece.from = point_of(ends[0], kind.line);
      piece.centre = point_of(ends[1], kind.line);
      piece.to = point_of(ends[2], kind.line);
      piece.radius = radius_of(piece, kind.line);
      piece.clockwise = cross(piece.from - piece.centre, piece.to - piece.centre) < 0.0; // the shorter arc
    }
    curves_[number] = {piece, kind.line};
  }

  double radius_of(const CurvePiece& arc, std::size_t line) const {
    constexpr double as_written = 1e-3; // coordinates have a few digits
    const double first = (arc.from - arc.centre).norm(), last = (arc.to - arc.centre).norm();
    if (!(std::abs(first - last) <= as_written * std::max(first, last)))
      fail(line, fmt::format("found a circle whose start is {:.6g} from its centre and whose end {:.6g}, "
                             "expected the same distance",
                             first, last));
    return 0.5 * (first + last);
  }

  void loop() {
    const Tag number = head();
    loops_[number] = numbers();
  }

  void surface() {
    const std::size_t line = now_.line;
    head();
    for (const double loop : numbers()) {
      const auto found = loops_.find(tag_of(std::abs(loop)));
      if (found == loops_.end())
        fail(line, fmt::format("found no loop {:g}, expected one defined before", loop));
      for (const double curve : found->second) {
        if (!curves_.contains(tag_of(std::abs(curve))))
          fail(line, fmt::format("found no curve {:g} in loop {:g}, expected one defined before",
                                 std::abs(curve), loop));
        ++sides_[tag_of(std::abs(curve))];
      }
    }
  }

  void physical(std::size_t line) {
    const bool of_curves = now_.is("Curve") || now_.is("Line");
    if (!of_curves) return skip();
    advance();
    expect("(");
    std::string name = now_.kind == GeoToken::Kind::text ? now_.text : "";
    if (name.empty())
      name = fmt::format("{}", tag());
    else {
      advance();
      if (take(",")) tag();
    }
    expect(")");
    expect("=");
    drawing_.add_layer(name);
    for (const double curve : numbers()) {
      const auto found = curves_.find(tag_of(std::abs(curve)));
      if (found == curves_.end())
        fail(line, fmt::format("found no curve {:g}, expected one defined before", std::abs(curve)));
      found->second.piece.name = name;
    }
  }

  /// Curves between two surfaces are no boundary; where there are surfaces, nor are those on none.
  void hand_over() {
    for (auto& [number, curve] : curves_) {
      if (!sides_.empty() && (!sides_.contains(number) || sides_.at(number) != 1)) continue;
      if (curve.piece.name.empty()) drawing_.add_layer(curve.piece.name = fmt::format("curve_{}", number));
      drawing_.add({curve.piece, curve.line, false});
    }
  }

  double finite() {
    const std::size_t line = now_.line;
    const double value = sum();
    if (!std::isfinite(value))
      fail(line, fmt::format("found a number that comes to {}, expected a finite one", value));
    return value;
  }

  double sum() {
    const Depth depth(*this);
    double value = product();
    for (;;)
      if (take("+"))
        value += product();
      else if (take("-"))
        value -= product();
      else
        return value;
  }

  double product() {
    double value = power();
    for (;;)
      if (take("*"))
        value *= power();
      else if (take("/"))
        value /= power();
      else
        return value;
  }

  double power() {
    const Depth depth(*this);
    if (take("-")) return -power();
    if (take("+")) return power();
    const double base = atom();
    return take("^") ? std::pow(base, power()) : base;
  }

  double atom() {
    const GeoToken token = now_;
    if (token.kind == GeoToken::Kind::number) return advance(), token.number;
    if (take("(")) {
      const double value = sum();
      expect(")");
      return value;
    }
    if (token.kind != GeoToken::Kind::word)
      fail(token.line, fmt::format("found {}, expected a number", shown()));
    advance();
    if (now_.is("(")) return function(token);
    const auto known = variables_.find(token.text);
    if (known != variables_.end()) return known->second;
    std::vector<std::string> names;
    for (const auto& [name, value] : variables_) names.push_back(name);
    fail(token.line, fmt::format("found no variable '{}', expected one defined before{}",
                                 shortened(token.text), did_you_mean(token.text, names)));
  }

  double function(const GeoToken& name) {
    static const std::map<std::string, double (*)(double), std::less<>> functions{
        {"Sin", std::sin},   {"Cos", std::cos},   {"Tan", std::tan},   {"Asin", std::asin},
        {"Acos", std::acos}, {"Atan", std::atan}, {"Sqrt", std::sqrt}, {"Fabs", std::fabs},
        {"Exp", std::exp},   {"Log", std::log}};
    const auto known = functions.find(name.text);
    if (known == functions.end())
      fail(name.line,
           fmt::format("found the function '{}', expected Sin, Cos, Tan, Sqrt or another of one number",
                       shortened(name.text)));
    expect("(");
    const double value = sum();
    expect(")");
    return known->second(value);
  }

  /// Parentheses in parentheses end somewhere.
  struct Depth {
    explicit Depth(GeoReader& reader_) : reader(reader_) {
      if (++reader.depth_ > 200)
        reader.fail(reader.now_.line,
                    "found more than 100 parentheses or signs in each other, expected less");
    }
    ~Depth() { --reader.depth_; }
    GeoReader& reader;
  };

  int depth_ = 0;
  double in_ranges_ = 0.0; ///< numbers that ranges have made
  std::map<std::string, double> variables_;
  std::map<Tag, Vec2> points_;
  std::map<Tag, GeoCurve> curves_;
  std::map<Tag, std::vector<double>> loops_;
  std::map<Tag, int> sides_; ///< how many surfaces a curve bounds
  DrawnFile drawing_;
};

} // namespace

DrawnFile read_geo(std::string_view text, const std::string& file) { return GeoReader(text, file).read(); }

} // namespace cnem::input
