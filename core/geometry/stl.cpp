// STL: 80 bytes of anything, the number of triangles, and 50 bytes for each; or text, "solid … facet …
// endsolid".
#include "core/error.hpp"
#include "core/geometry/triangle_surface.hpp"
#include "core/index.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <map>

namespace cnem {
namespace {

constexpr std::size_t header = 84, record = 50;

class Gatherer {
public:
  explicit Gatherer(double scale) : scale_(scale) {}

  void add(const std::array<Vec3, 3>& corners) {
    std::array<std::int32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 x = scale_ * corners[k] + Vec3::Zero(); // −0 is 0
      const auto [found, is_new] =
          number_.try_emplace({x.x(), x.y(), x.z()}, as<std::int32_t>(surface_.points.size()));
      if (is_new) surface_.points.push_back(x);
      triangle[k] = found->second;
    }
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      surface_.triangles.push_back(triangle);
  }
  TriangleSurface take() { return std::move(surface_); }

private:
  double scale_;
  TriangleSurface surface_;
  std::map<std::array<double, 3>, std::int32_t> number_;
};

bool is_binary(std::string_view bytes) {
  if (bytes.size() < header) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  return bytes.size() == header + record * std::size_t{count} || !bytes.starts_with("solid");
}

TriangleSurface parse_binary(std::string_view bytes, double scale) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  if (bytes.size() < header + record * std::size_t{count})
    throw InputError(fmt::format("found {} bytes, expected binary STL of {} triangles in {} bytes",
                                 bytes.size(), count, header + record * std::size_t{count}));
  Gatherer gathered(scale);
  for (std::size_t t = 0; t < count; ++t) {
    std::array<float, 12> number{};
    std::memcpy(number.data(), bytes.data() + header + record * t, sizeof number);
    std::array<Vec3, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = Vec3(number[3 * k + 3], number[3 * k + 4], number[3 * k + 5]);
      if (!corner[k].allFinite())
        throw InputError(
            fmt::format("triangle {} has a corner that is no place, expected finite numbers", t + 1));
    }
    gathered.add(corner);
  }
  return gathered.take();
}

/// Words of a text with the line each stands on.
class Words {
public:
  explicit Words(std::string_view text) : left_(text) {}

  std::string_view next() {
    while (!left_.empty() && is_space(left_.front())) {
      line_ += left_.front() == '\n';
      left_.remove_prefix(1);
    }
    std::size_t n = 0;
    while (n < left_.size() && !is_space(left_[n])) ++n;
    const std::string_view word = left_.substr(0, n);
    left_.remove_prefix(n);
    return word;
  }
  void skip_line() {
    const auto end = left_.find('\n');
    left_.remove_prefix(end == std::string_view::npos ? left_.size() : end);
  }
  void expect(std::string_view word) {
    if (const std::string_view found = next(); found != word) fail(found, word);
  }
  double number() {
    std::string_view word = next();
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    double value = 0.0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (fault != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
      fail(word, "a number");
    return value;
  }
  [[noreturn]] void fail(std::string_view found, std::string_view wanted) const {
    throw InputError(fmt::format("line {}: found {}, expected {} of STL", line_,
                                 found.empty() ? "the end" : fmt::format("'{}'", found.substr(0, 40)),
                                 wanted));
  }

private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  std::string_view left_;
  int line_ = 1;
};

TriangleSurface parse_text(std::string_view text, double scale) {
  Words words(text);
  Gatherer gathered(scale);
  words.expect("solid");
  words.skip_line();
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "solid" || word == "endsolid") {
      words.skip_line();
      continue;
    }
    if (word != "facet") words.fail(word, "facet or endsolid");
    words.skip_line(); // its normal
    words.expect("outer"), words.expect("loop");
    std::array<Vec3, 3> corner;
    for (Vec3& x : corner) {
      words.expect("vertex");
      for (double& value : x) value = words.number();
    }
    words.expect("endloop"), words.expect("endfacet");
    gathered.add(corner);
  }
  return gathered.take();
}

} // namespace

TriangleSurface parse_stl(std::string_view bytes, double scale) {
  TriangleSurface surface = is_binary(bytes) ? parse_binary(bytes, scale) : parse_text(bytes, scale);
  if (surface.triangles.empty()) throw InputError("found no triangle, expected STL with some");
  return surface;
}

TriangleSurface read_stl(const std::string& path, double scale) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: cannot be read, expected a file of STL", path));
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  try {
    return parse_stl(bytes, scale);
  } catch (const InputError& error) { throw InputError(fmt::format("{}: {}", path, error.what())); }
}

} // namespace cnem
