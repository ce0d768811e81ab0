#pragma once
// Bytes as a domain with its spacing and pattern, so that mutations of bytes are small changes of shape.
#include "voronoi/generate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace cnem::fuzz {

struct Shape {
  voronoi::DomainShape domain;
  voronoi::SpacingField spacing;
  voronoi::CloudOptions options;
};

class Decoder {
public:
  Decoder(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {
    scale_ = std::pow(10.0, below(7) - 3);
    const int nudge = below(5); // how far off the lattice points may lie: not at all, or by tiny amounts
    nudge_ = nudge == 0 ? 0.0 : std::ldexp(1.0, -12 * nudge);
  }

  Shape shape() {
    Shape result;
    result.domain.outer = curve(128.0, "outer");
    for (int k = below(3); k > 0; --k) result.domain.holes.push_back(curve(32.0, "hole"));
    for (int k = below(3); k > 0; --k) result.domain.cracks.push_back(crack(k));
    result.spacing = spacing();
    result.options = options();
    if (result.options.pattern == voronoi::Pattern::list) list_corners(result);
    return result;
  }

private:
  /// The next byte; 0 beyond the end.
  int byte() { return at_ < size_ ? data_[at_++] : 0; }
  int below(int n) { return byte() % n; }

  double coordinate(double reach) {
    double x = (byte() - 128) / 128.0 * reach / 128.0;
    if (nudge_ != 0.0) x += nudge_ * (byte() - 128) / 128.0;
    return x * scale_;
  }
  Vec2 point(double reach = 128.0) {
    const double x = coordinate(reach);
    return {x, coordinate(reach)};
  }

  /// A circle, or corners joined by segments and arcs.
  Curve curve(double reach, const std::string& name) {
    const int corners = below(8) + 2;
    const Vec2 middle = reach < 128.0 ? point() : Vec2(0, 0);
    Curve result;
    if (corners == 2) {
      const double radius = (byte() + 1) / 256.0 * reach / 128.0 * scale_;
      const Vec2 right = middle + Vec2(radius, 0.0);
      result.pieces.push_back({right, right, middle, radius, below(2) == 1, name});
      return result;
    }
    std::vector<Vec2> corner;
    for (int k = 0; k < corners; ++k) corner.push_back(middle + point(reach));
    for (std::size_t k = 0; k < corner.size(); ++k) {
      CurvePiece piece{corner[k], corner[(k + 1) % corner.size()], {0, 0}, 0.0, false, name};
      const int bulge = byte();
      if (bulge >= 128) make_arc(piece, bulge - 128);
      result.pieces.push_back(piece);
    }
    return result;
  }

  /// The shorter arc between the ends of a piece, of a radius from half the chord on.
  static void make_arc(CurvePiece& piece, int bulge) {
    const Vec2 chord = piece.to - piece.from;
    const double half = 0.5 * chord.norm();
    piece.clockwise = bulge % 2 == 1;
    piece.radius = half * (1.0 + bulge / 16.0);
    const double height = std::sqrt(std::max(0.0, (piece.radius - half) * (piece.radius + half)));
    const Vec2 side = half > 0.0
                          ? Vec2((piece.clockwise ? right_normal(chord) : left_normal(chord)) / (2.0 * half))
                          : Vec2(0, 0);
    piece.centre = 0.5 * (piece.from + piece.to) + height * side;
  }

  voronoi::Crack crack(int number) {
    voronoi::Crack result{"crack" + std::to_string(number), {}};
    for (int k = below(4) + 1; k > 0; --k) result.path.push_back(point());
    return result;
  }

  voronoi::SpacingField spacing() {
    voronoi::SpacingField field;
    field.spacing = scale_ / (1 + below(12));
    for (int k = below(3); k > 0; --k) {
      voronoi::Refinement refinement;
      const bool box = below(2) == 1;
      refinement.region = box ? voronoi::Refinement::Region::box : voronoi::Refinement::Region::path;
      for (int n = box ? 2 : below(3) + 1; n > 0; --n) refinement.points.push_back(point());
      refinement.spacing = field.spacing / (1 + below(16));
      refinement.growth = (byte() + 1) / 256.0;
      field.refinements.push_back(std::move(refinement));
    }
    return field;
  }

  voronoi::CloudOptions options() {
    voronoi::CloudOptions result;
    result.pattern = static_cast<voronoi::Pattern>(below(4));
    result.jitter = 0.4 * byte() / 255.0;
    result.seed = static_cast<std::uint64_t>(byte());
    result.nodes_limit = 250.0;
    if (result.pattern == voronoi::Pattern::list)
      for (int k = below(32); k > 0; --k) result.nodes.push_back(point());
    return result;
  }

  /// Lists need a node at every corner and end, which random ones would never hit.
  static void list_corners(Shape& shape) {
    std::vector<Vec2>& nodes = shape.options.nodes;
    const auto add = [&](const Vec2& x) {
      if (std::find(nodes.begin(), nodes.end(), x) == nodes.end()) nodes.push_back(x);
    };
    for (const CurvePiece& piece : shape.domain.outer.pieces) add(piece.from);
    for (const Curve& hole : shape.domain.holes)
      for (const CurvePiece& piece : hole.pieces) add(piece.from);
    for (const voronoi::Crack& crack : shape.domain.cracks)
      for (const Vec2& x : crack.path) add(x);
  }

  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
  double scale_ = 1.0, nudge_ = 0.0;
};

inline Shape shape_of(const std::uint8_t* data, std::size_t size) { return Decoder(data, size).shape(); }

} // namespace cnem::fuzz
