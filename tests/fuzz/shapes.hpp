#pragma once
// Bytes as a domain with its spacing and pattern, the parts that interfaces divide it into and what happens
// to its cloud, so that mutations of bytes are small changes of shape.
#include "clouds/generate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace cnem::fuzz {

/// What a cloud goes through before it is resampled. Lengths are in units of the size of the domain, or,
/// where single nodes move, of the spacing at them.
struct Deformation {
  double shear[4] = {0.0, 0.0, 0.0, 0.0}; ///< amplitudes of waves and plain shears along x and y
  double wave[2] = {0.0, 0.0};
  struct Jump {
    int node;
    Vec2 by;
  };
  std::vector<Jump> jumps; ///< nodes that pass others, or the boundary
  struct Wish {
    int node;
    double factor;
  };
  std::vector<Wish> wishes; ///< where another spacing is wanted
  int held = 0;             ///< every n-th boundary node has to stay; 0: none
  bool at_vertices = false; ///< new nodes on Voronoi vertices
};

struct Shape {
  clouds::DomainShape domain;
  clouds::SpacingField spacing;
  clouds::CloudOptions options;
  std::size_t interfaces = 0; ///< so many of the cracks, the last ones, are bonded
  std::vector<Vec2> regions;  ///< a point of each, m
  std::vector<Deformation> deformations;
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
    // What was added later stands at the end of the bytes: old entries of the corpus keep their meaning.
    result.interfaces = static_cast<std::size_t>(below(4));
    for (std::size_t k = 0; k < result.interfaces; ++k) {
      clouds::Crack face = interface(result.domain, static_cast<int>(k));
      result.domain.cracks.push_back(std::move(face));
    }
    for (int k = below(4); k > 0; --k) result.regions.push_back(point());
    for (int k = below(4); k > 0; --k) result.deformations.push_back(deformation());
    if (result.options.pattern == clouds::Pattern::list) list_corners(result);
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

  clouds::Crack crack(int number) {
    clouds::Crack result{"crack" + std::to_string(number), {}};
    for (int k = below(4) + 1; k > 0; --k) result.path.push_back(point());
    return result;
  }

  /// From a place on the boundary to another.
  clouds::Crack interface(const clouds::DomainShape& domain, int number) {
    clouds::Crack result{"interface" + std::to_string(number), {place(domain)}};
    for (int k = below(3); k > 0; --k) result.path.push_back(point());
    result.path.push_back(place(domain));
    return result;
  }
  Vec2 place(const clouds::DomainShape& domain) {
    const auto curve = static_cast<std::size_t>(below(static_cast<int>(domain.holes.size()) + 1));
    const auto& pieces = (curve == 0 ? domain.outer : domain.holes[curve - 1]).pieces;
    const auto piece = static_cast<std::size_t>(below(static_cast<int>(pieces.size())));
    return pieces[piece].point(byte() / 255.0);
  }

  Deformation deformation() {
    Deformation result;
    for (double& amplitude : result.shear) amplitude = 0.3 * (byte() - 128) / 128.0;
    for (double& wave : result.wave) wave = byte() / 16.0;
    for (int k = below(4); k > 0; --k) {
      const int node = byte();
      const double x = (byte() - 128) / 64.0;
      result.jumps.push_back({node, {x, (byte() - 128) / 64.0}});
    }
    for (int k = below(4); k > 0; --k) {
      const int node = byte();
      result.wishes.push_back({node, std::ldexp(1.0, below(5) - 2)});
    }
    result.held = below(8);
    result.at_vertices = below(2) == 1;
    return result;
  }

  clouds::SpacingField spacing() {
    clouds::SpacingField field;
    field.spacing = scale_ / (1 + below(12));
    for (int k = below(3); k > 0; --k) {
      clouds::Refinement refinement;
      const bool box = below(2) == 1;
      refinement.region = box ? clouds::Refinement::Region::box : clouds::Refinement::Region::path;
      for (int n = box ? 2 : below(3) + 1; n > 0; --n) refinement.points.push_back(point());
      refinement.spacing = field.spacing / (1 + below(16));
      refinement.growth = (byte() + 1) / 256.0;
      field.refinements.push_back(std::move(refinement));
    }
    return field;
  }

  clouds::CloudOptions options() {
    clouds::CloudOptions result;
    result.pattern = static_cast<clouds::Pattern>(below(4));
    result.jitter = 0.4 * byte() / 255.0;
    result.seed = static_cast<std::uint64_t>(byte());
    result.nodes_limit = 250.0;
    if (result.pattern == clouds::Pattern::list)
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
    for (const clouds::Crack& crack : shape.domain.cracks)
      for (const Vec2& x : crack.path) add(x);
  }

  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
  double scale_ = 1.0, nudge_ = 0.0;
};

inline Shape shape_of(const std::uint8_t* data, std::size_t size) { return Decoder(data, size).shape(); }

} // namespace cnem::fuzz
