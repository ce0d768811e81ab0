// STL files, and what is no closed surface.
#include "core/error.hpp"
#include "core/geometry/triangle_surface.hpp"

#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>

using namespace cnem;

namespace {

/// A tetrahedron in text.
const std::string text = R"(solid tip
  facet normal 0 0 -1
    outer loop
      vertex 0 0 0
      vertex 0 1 0
      vertex 1 0 0
    endloop
  endfacet
  facet normal 0 -1 0
    outer loop
      vertex 0 0 0
      vertex 1 0 0
      vertex 0 0 1.0e0
    endloop
  endfacet
  facet normal -1 0 0
    outer loop
      vertex 0 0 0
      vertex 0 0 1
      vertex 0 +1 0
    endloop
  endfacet
  facet normal 1 1 1
    outer loop
      vertex 1 0 0
      vertex 0 1 0
      vertex -0 0 1
    endloop
  endfacet
endsolid tip
)";

std::string binary(const TriangleSurface& surface) {
  std::string bytes(80, ' ');
  const auto append = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(static_cast<std::uint32_t>(surface.triangles.size()));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) append(0.0F);
    for (const Vec3& x : surface.corners(t))
      for (const double value : x) append(static_cast<float>(value));
    append(std::uint16_t{0});
  }
  return bytes;
}

template<class Act> std::string message_of(Act&& act) {
  try {
    act();
  } catch (const InputError& error) { return error.what(); }
  return "";
}

} // namespace

TEST(Stl, text_and_binary_are_the_same_surface) {
  const TriangleSurface read = joined(parse_stl(text, 1e-3));
  ASSERT_EQ(read.points.size(), 4U);
  ASSERT_EQ(read.triangles.size(), 4U);
  EXPECT_NO_THROW(check_closed(read));
  EXPECT_NEAR(read.volume(), 1e-9 / 6.0, 1e-24);
  const TriangleSurface again = joined(parse_stl(binary(joined(parse_stl(text, 1.0))), 1e-3));
  ASSERT_EQ(again.triangles, read.triangles);
  EXPECT_EQ(again.points, read.points);
}

// Facets without area have normals that are no numbers.
TEST(Stl, normals_are_not_looked_at) {
  std::string other = text;
  other.replace(other.find("0 0 -1"), 6, "-nan nan 1.#IND");
  EXPECT_EQ(joined(parse_stl(other, 1.0)).triangles, joined(parse_stl(text, 1.0)).triangles);
  other.replace(other.find("-nan nan 1.#IND"), 15, "");
  EXPECT_EQ(message_of([&] { parse_stl(other, 1.0); }),
            "line 3 of the STL file: found \"outer\", expected a number");
}

TEST(Stl, solids_keep_their_names_and_those_of_one_name_are_one) {
  std::string second = text;
  second.replace(second.find("solid tip"), 9, "solid other part");
  const FacetSoup soup = parse_stl(text + second + text, 1.0);
  EXPECT_EQ(soup.solids, (std::vector<std::string>{"tip", "other part"}));
  ASSERT_EQ(soup.triangles.size(), 12U);
  EXPECT_EQ(soup.triangles[0].solid, 0);
  EXPECT_EQ(soup.triangles[4].solid, 1);
  EXPECT_EQ(soup.triangles[8].solid, 0);
}

TEST(Stl, tells_what_is_wrong_and_where) {
  EXPECT_NE(message_of([] { parse_stl("", 1.0); }).find("no STL file"), std::string::npos);
  std::string broken = text;
  broken.replace(broken.find("vertex 0 1 0"), 12, "vertex 0 x 0");
  EXPECT_EQ(message_of([&] { parse_stl(broken, 1.0); }),
            "line 5 of the STL file: found \"x\", expected a number");
  EXPECT_NE(message_of([] { parse_stl(text.substr(0, 150), 1.0); }).find("found its end"), std::string::npos);
  const std::string bytes = binary(joined(parse_stl(text, 1.0)));
  EXPECT_NE(
      message_of([&] { parse_stl(bytes.substr(0, 200), 1.0); }).find("found 200 bytes that are no STL file"),
      std::string::npos);
  EXPECT_NE(message_of([] { parse_stl("ply\n", 1.0); }).find("found 4 bytes that are no STL file"),
            std::string::npos);
  EXPECT_NE(message_of([] { parse_stl("solid a\n", 1.0); }).find("expected \"facet\" or \"endsolid\""),
            std::string::npos);
  EXPECT_NE(message_of([] { parse_stl("solid\nendsolid\n", 1.0); }).find("no triangle"), std::string::npos);
}

TEST(Stl, open_turned_and_inverted_surfaces_are_refused_by_triangle) {
  const TriangleSurface closed = joined(parse_stl(text, 1.0));
  TriangleSurface open = closed;
  open.triangles.pop_back();
  EXPECT_NE(message_of([&] {
              check_closed(open);
            }).find("open: triangles with an edge that no other one has: 1 at"),
            std::string::npos);
  TriangleSurface turned = closed;
  std::swap(turned.triangles[2][0], turned.triangles[2][1]);
  EXPECT_NE(message_of([&] { check_closed(turned); }).find("face opposite sides"), std::string::npos);
  TriangleSurface inverted = closed;
  for (auto& t : inverted.triangles) std::swap(t[0], t[1]);
  EXPECT_NE(message_of([&] { check_closed(inverted); }).find("inside out"), std::string::npos);
  TriangleSurface crowded = closed;
  crowded.triangles.push_back(closed.triangles[0]);
  EXPECT_NE(message_of([&] { check_closed(crowded); }).find("more than two triangles"), std::string::npos);
}
