#include "machining/structure/eigenmodes.hpp"
#include "machining/structure/part.hpp"

#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::machining;

namespace {

/// The plate of paper 004, 3.3.1, whose base is fixed; E as its frequencies say (misprint).
PartShape plate(std::array<int, 3> divisions = {10, 5, 2}) {
  return {.size = Vec3(0.1, 0.04, 0.004),
          .divisions = divisions,
          .materials = {{2.0e11, 0.3, 7800.0}},
          .zones = {}};
}
const PartSupport base{.axis = 1};

Eigen::VectorXd frequencies(const PartShape& shape, PartElement element, Eigen::Index count) {
  const Part part(shape, element, {&base, 1});
  return lowest_modes(part.stiffness(part.presence()), part.mass(part.presence()), count).omega /
         (2.0 * std::numbers::pi);
}

/// Its upper three rows of elements, half of the thickness.
PartShape machined(double taken) {
  PartShape shape = plate();
  shape.zones.push_back({Vec3(0.0, 0.016, 0.002), Vec3(0.1, 0.04, 0.004), 0, taken});
  return shape;
}

} // namespace

TEST(Part, TrilinearHexahedraGiveTheFrequencyOfThePaper) {
  EXPECT_NEAR(frequencies(plate(), PartElement::hexahedron_8, 1)[0], 3342.677, 5e-4);
}

TEST(Part, OnePlateElement) {
  EXPECT_NEAR(frequencies(plate({1, 1, 1}), PartElement::plate_8, 1)[0], 2141.7, 0.05);
}

TEST(Part, Dump) {
  for (auto el : {PartElement::hexahedron_27, PartElement::plate_8}) {
    std::cout << frequencies(plate(), el, 5).transpose() << "\n";
    for (double d : {1.0, 0.9, 0.95, 0.999})
      std::cout << d << " " << frequencies(machined(d), el, 3).transpose() << "\n";
  }
}
