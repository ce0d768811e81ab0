// Drawings in the language of gmsh's .geo files, as far as outlines need it.
#include "input/drawings/drawing.hpp"
#include "input/drawings/numbers.hpp"
#include "input/schema/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <utility>

namespace cnem::input {
namespace {

/// Words, numbers, texts in quotes and single signs, with the line each stands in.
struct Token {
  enum class Kind { word, number, text, sign, end } kind = Kind::end;
  std::string text;
  double number = 0.0;
  std::size_t line = 1;

  bool is(std::string_view what) const { return (kind == Kind::word || kind == Kind::sign) && text == what; }
};

using Tag = long;

/// Of a number in a list; no curve has the tag of one that is none.
Tag tag_of(double number) { return static_cast<Tag>(std::clamp(number, -1e15, 1e15)); }

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

class GeoReader {
public:
  GeoReader(std::string_view text, const std::string& file) : rest_(text) {
    drawing_.file = file;
    variables_["Pi"] = std::numbers::pi;
    advance();
  }

  DrawnFile read() {
    while (now_.kind != Token::Kind::end) statement();
    hand_over();
    return std::move(drawing_);
  }

private:
  [[noreturn]] void fail(std::size_t line, const std::string& message) const {
    throw DrawingError(drawing_.file, line, message);
  }
  std::string shown() const {
    return now_.kind == Token::Kind::end ? "the end of the file" : fmt::format("'{}'", shortened(now_.text));
  }

  void advance() {
    skip_blanks();
    now_ = {Token::Kind::end, "", 0.0, line_};
    if (rest_.empty()) return;
    const auto is_word = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
    };
    std::size_t length = 1;
    const char first = rest_.front();
    if (first == '"') {
      const auto close = rest_.find('"', 1);
      if (close == std::string_view::npos)
        fail(line_, "found a text that does not end, expected \" after it");
      now_.kind = Token::Kind::text;
      now_.text = rest_.substr(1, close - 1);
      length = close + 1;
    } else if (std::isdigit(static_cast<unsigned char>(first)) || first == '.') {
      while (length < rest_.size() &&
             (is_word(rest_[length]) ||
              ((rest_[length] == '-' || rest_[length] == '+') && std::tolower(rest_[length - 1]) == 'e')))
        ++length;
      now_.kind = Token::Kind::number;
      now_.text = rest_.substr(0, length);
      const auto number = number_in(now_.text);
      if (!number) fail(line_, fmt::format("found {}, expected a finite number", shown()));
      now_.number = *number;
    } else {
      now_.kind = is_word(first) ? Token::Kind::word : Token::Kind::sign;
      while (now_.kind == Token::Kind::word && length < rest_.size() && is_word(rest_[length])) ++length;
      now_.text = rest_.substr(0, length);
    }
    rest_.remove_prefix(length);
  }

  void skip_blanks() {
    while (!rest_.empty()) {
      const std::string_view end = rest_.starts_with("//") ? "\n" : rest_.starts_with("/*") ? "*/" : "";
      std::size_t length = 1;
      if (!end.empty()) {
        const auto close = rest_.find(end, 2);
        if (close == std::string_view::npos && end == "*/")
          fail(line_, "found a comment that does not end, expected */ after it");
        length = close == std::string_view::npos ? rest_.size() : close + end.size();
      } else if (!std::isspace(static_cast<unsigned char>(rest_.front())))
        return;
      line_ += static_cast<std::size_t>(std::count(rest_.begin(), rest_.begin() + long(length), '\n'));
      rest_.remove_prefix(length);
    }
  }

  bool take(std::string_view what) {
    if (!now_.is(what)) return false;
    advance();
    return true;
  }
  void expect(std::string_view what) {
    if (!take(what)) fail(now_.line, fmt::format("found {}, expected '{}'", shown(), what));
  }

  void statement() {
    const Token first = now_;
    if (first.kind != Token::Kind::word)
      fail(now_.line, fmt::format("found {}, expected a command of gmsh", shown()));
    advance();
    if (is_of_the_mesh(first.text)) return skip();
    if (now_.is("=")) {
      advance();
      variables_[first.text] = sum();
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
    while (now_.kind != Token::Kind::end && !now_.is(";")) advance();
    expect(";");
  }

  Tag tag() {
    const std::size_t line = now_.line;
    const double value = sum();
    if (value != std::round(value) || std::abs(value) > 1e9)
      fail(line, fmt::format("found {:g}, expected a whole number", value));
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
        const double from = sum();
        list.push_back(from);
        if (!take(":")) continue;
        const double to = sum();
        if (std::abs(to - from) > 1e6)
          fail(now_.line, "found a range of more than a million numbers, expected less");
        while (std::abs(to - list.back()) >= 1.0) list.push_back(list.back() + (to > from ? 1.0 : -1.0));
      } while (take(","));
    expect("}");
    expect(";");
    return list;
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

  void curve(const Token& kind) {
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
      piece.radius = 0.5 * ((piece.from - piece.centre).norm() + (piece.to - piece.centre).norm());
      piece.clockwise = cross(piece.from - piece.centre, piece.to - piece.centre) < 0.0; // the shorter arc
    }
    curves_[number] = {piece, kind.line};
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
    std::string name = now_.kind == Token::Kind::text ? now_.text : "";
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
      drawing_.curves.push_back({curve.piece, curve.line, false});
    }
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
    const Token token = now_;
    if (token.kind == Token::Kind::number) return advance(), token.number;
    if (take("(")) {
      const double value = sum();
      expect(")");
      return value;
    }
    if (token.kind != Token::Kind::word)
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

  double function(const Token& name) {
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
        reader.fail(reader.line_, "found more than 100 parentheses or signs in each other, expected less");
    }
    ~Depth() { --reader.depth_; }
    GeoReader& reader;
  };

  std::string_view rest_;
  std::size_t line_ = 1;
  int depth_ = 0;
  Token now_;
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
