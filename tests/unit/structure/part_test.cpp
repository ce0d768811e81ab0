#include "core/error.hpp"
#include "tests/unit/structure/paper_plate.hpp"

#include <array>
#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::machining;

namespace {

Eigen::VectorXd frequencies(const PartShape& shape, PartElement element, Eigen::Index count) {
  return modes(Part(shape, element, {&base, 1}), count).omega / (2.0 * std::numbers::pi);
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

// Reference: an independent program, 27-node hexahedra 10 × 5 × 2.
TEST(Part, WhatIsTakenOfAPlate) {
  const auto expect = [](double taken, const Eigen::Vector3d& reference) {
    const Eigen::VectorXd f = frequencies(machined(taken), PartElement::hexahedron_27, 3);
    EXPECT_LT((f - reference).cwiseAbs().maxCoeff(), 0.6) << taken << ": " << f.transpose();
  };
  expect(1.0, {2184.4, 2548.7, 3629.2});
  expect(0.999, {2191.5, 2557.3, 3642.7});
  expect(0.95, {2407.0, 2839.0, 4121.0});
  expect(0.9, {2492.0, 2976.0, 4401.0});
}

// Plates of which cells are layers beside the surface that their unknowns belong to.
TEST(Part, OffsetLayersAreSteppedPlates) {
  for (const double taken : {1.0, 0.999}) {
    const Eigen::VectorXd plates = frequencies(machined(taken), PartElement::plate_8, 3),
                          solid = frequencies(machined(taken), PartElement::hexahedron_27, 3);
    EXPECT_LT(((plates - solid).array() / solid.array()).abs().maxCoeff(), 0.01);
  }
}

// Where the surface of the unknowns lies changes nothing: the same plate in the lower half of a box.
TEST(Part, OffsetPlateIsThePlate) {
  PartShape thick = plate({10, 5, 1});
  thick.size.z() = 0.008;
  thick.zones.push_back({Vec3(0.0, 0.0, 0.004), Vec3(0.1, 0.04, 0.008), 0, 1.0});
  const Eigen::VectorXd offset = frequencies(thick, PartElement::plate_8, 4),
                        centred = frequencies(plate({10, 5, 1}), PartElement::plate_8, 4);
  EXPECT_LT(((offset - centred).array() / centred.array()).abs().maxCoeff(), 2e-3);
}

// Mindlin's simply supported square plate, a/h = 10, ω a² √(ρh/D) of the first mode 19.065 (Navier's solution
// with 5/6).
TEST(Part, SupportedPlate) {
  const double a = 0.2, h = 0.02, young = 2.0e11, nu = 0.3, rho = 7800.0;
  const PartShape shape{
      .size = Vec3(a, a, h), .divisions = {12, 12, 1}, .materials = {{young, nu, rho}}, .zones = {}};
  std::vector<PartSupport> all;
  for (const int axis : {0, 1})
    for (const bool far : {false, true}) all.push_back({.axis = axis, .far = far, .turns = true});
  const Part part(shape, PartElement::plate_8, all);
  const double D = young * h * h * h / 12.0 / (1.0 - nu * nu), scale = a * a * std::sqrt(rho * h / D);
  const Eigenmodes found = modes(part, 3);
  EXPECT_NEAR(found.omega[0] * scale, 19.065, 0.001 * 19.065);
  EXPECT_NEAR(found.omega[1] / found.omega[2], 1.0, 1e-9); // twice the same
}

// A cantilever under a force at its end: Timoshenko's deflection, with elements through whose thickness there
// is one, and at a square of the slenderness that locks trilinear ones.
TEST(Part, Cantilever) {
  const double l = 0.1, b = 0.002, h = 0.004, young = 7.0e10;
  const PartShape shape{
      .size = Vec3(b, l, h), .divisions = {1, 20, 1}, .materials = {{young, 0.0, 2700.0}}, .zones = {}};
  const double inertia = b * h * h * h / 12.0, shear = 5.0 / 6.0 * 0.5 * young * b * h;
  const double exact = l * l * l / (3.0 * young * inertia) + l / shear;
  for (const PartElement element : {PartElement::hexahedron_27, PartElement::plate_8}) {
    const Part part(shape, element, {&base, 1});
    const SparseMatrix face = part.displacement_of(1, true);
    const Eigen::VectorXd q = SparseCholesky(part.stiffness(part.presence()))
                                  .solve(face.transpose() * Eigen::Vector3d(0.0, 0.0, 1.0));
    EXPECT_NEAR((face * q)[2] / exact, 1.0, 2e-3);
  }
}

// Two layers under a change of length would bend; a beam of steel under aluminium has the stiffness of both
// about their common neutral axis.
TEST(Part, Layers) {
  const double l = 0.1, b = 0.002, h = 0.004, soft = 7.0e10, stiff = 2.1e11;
  const PartShape shape{.size = Vec3(b, l, h),
                        .divisions = {1, 20, 1},
                        .materials = {{soft, 0.0, 2700.0}, {stiff, 0.0, 7800.0}},
                        .zones = {{Vec3(0, 0, 0), Vec3(b, l, 0.25 * h), 1, 0.0}}};
  const double a1 = 0.25 * b * h, a2 = 0.75 * b * h, z1 = 0.125 * h, z2 = 0.625 * h;
  const double neutral = (stiff * a1 * z1 + soft * a2 * z2) / (stiff * a1 + soft * a2);
  const double bending = stiff * (a1 * 0.0625 * h * h / 12.0 + a1 * (z1 - neutral) * (z1 - neutral)) +
                         soft * (a2 * 0.5625 * h * h / 12.0 + a2 * (z2 - neutral) * (z2 - neutral));
  for (const PartElement element : {PartElement::hexahedron_27, PartElement::plate_8}) {
    const Part part(shape, element, {&base, 1});
    const SparseMatrix face = part.displacement_of(1, true);
    const Eigen::VectorXd q = SparseCholesky(part.stiffness(part.presence()))
                                  .solve(face.transpose() * Eigen::Vector3d(0.0, 0.0, 1.0));
    EXPECT_NEAR((face * q)[2] / (l * l * l / (3.0 * bending)), 1.0, 5e-3);
  }
}

// A wall whose upper half is half as thick, which bends in its step: 4240.5 Hz by hexahedra of degree 5, 4
// and 3 in another program.
TEST(Part, ThinCellsBesideStepsFindHowTheyBend) {
  PartShape shape{.size = Vec3(0.06, 0.03, 0.004),
                  .divisions = {8, 8, 1},
                  .materials = {{1.1e11, 0.31, 4430.0}},
                  .zones = {{Vec3(0.0, 0.015, 0.002), Vec3(0.06, 0.03, 0.004), 0, 1.0}}};
  const auto error = [&] {
    const Part part(shape, PartElement::hexahedron_27, {&base, 1});
    return modes(part, 1).omega[0] / (2.0 * std::numbers::pi * 4240.5) - 1.0;
  };
  const double coarse = error();
  shape.more = beside_steps(shape);
  EXPECT_TRUE(shape.more[0].empty());
  for (const auto& [axis, step] : {std::pair{1, 0.015}, {2, 0.002}}) {
    const std::vector<double>& more = shape.more[static_cast<std::size_t>(axis)];
    ASSERT_EQ(more.size(), 2U);
    EXPECT_NEAR(more[0], step - 5e-4, 1e-12);
    EXPECT_NEAR(more[1], step + 5e-4, 1e-12);
  }
  EXPECT_GT(coarse, 0.012);
  EXPECT_NEAR(error(), 0.0, 0.004);
}

// A thin wall of titanium, clamped below: 1018.3, 1357.0, 2270.6, 3885.3 Hz with 60 × 24 × 2 and 40 × 20 × 3
// cells and a thin one below; upper bounds by polynomials of degree 8, 16, 5 are 0.1 to 0.4% above.
TEST(Part, ThinCellsBesideClampsFindHowWallsBend) {
  PartShape shape{.size = Vec3(0.13, 0.052, 0.0032),
                  .divisions = {30, 12, 1},
                  .materials = {{1.13e11, 0.342, 4430.0}},
                  .zones = {}};
  const auto error = [&] {
    const Part part(shape, PartElement::hexahedron_27, {&base, 1});
    return modes(part, 1).omega[0] / (2.0 * std::numbers::pi * 1018.3) - 1.0;
  };
  const double without = error();
  const std::array supports{base, PartSupport{.axis = 0, .far = true}, PartSupport{.axis = 2, .turns = true}};
  shape.more = beside_clamps(shape, supports);
  ASSERT_EQ(shape.more[0].size(), 1U);
  EXPECT_NEAR(shape.more[0][0], 0.13 - 8e-4, 1e-12);
  ASSERT_EQ(shape.more[1].size(), 1U);
  EXPECT_NEAR(shape.more[1][0], 8e-4, 1e-12);
  EXPECT_TRUE(shape.more[2].empty());
  shape.more = beside_clamps(shape, {&base, 1});
  EXPECT_GT(without, 0.003);
  EXPECT_NEAR(error(), 0.0, 0.0015);
  shape.divisions = {30, 60, 1}; // of 0.87 mm beside it, as thin
  EXPECT_TRUE(beside_clamps(shape, supports)[1].empty());
}

// Rounding of K⁻¹ M keeps residuals of a plate of 1:1000 above 1e-7: its modes come to an end all the same.
TEST(Part, ModesOfAThinStepComeToAnEnd) {
  const auto first = [](double thickness) {
    PartShape shape = plate({6, 3, 1});
    shape.size.z() = thickness;
    shape.zones.push_back(
        {Vec3(0.0, 0.016, 0.5 * thickness), Vec3(0.1, 0.04, thickness), std::size_t{0}, 1.0});
    return modes(Part(shape, PartElement::hexahedron_27, {&base, 1}), 4).frequency(0);
  };
  EXPECT_NEAR(first(1e-4) / (0.1 * first(1e-3)), 1.0, 0.02);
  EXPECT_THROW(first(2e-5), InputError);
}

TEST(Part, CellsAreCounted) {
  PartShape shape = plate({6, 3, 1});
  shape.zones.push_back({Vec3(0.0, 0.016, 0.002), Vec3(0.1, 0.04, 0.004), std::size_t{0}, 1.0});
  const Part part(shape, PartElement::hexahedron_27, {&base, 1});
  EXPECT_EQ(cells_of(shape), part.cells());
  EXPECT_EQ(part.cells(), 6U * (2 * 2 + 2)); // two rows below the step, of two layers, and two above
}

TEST(Part, PointsFollowNodesAndForcesAreTheTranspose) {
  const Part part(machined(1.0), PartElement::hexahedron_27, {});
  // A linear field: rows give it back anywhere, faces the one at their middle.
  const Eigen::Matrix3d gradient{{1.0, 2.0, 3.0}, {-1.0, 0.5, 2.0}, {0.2, 0.1, -0.7}};
  Eigen::VectorXd q(part.unknowns());
  for (std::size_t n = 0; n < part.nodes(); ++n)
    q.segment<3>(3 * static_cast<Eigen::Index>(n)) = gradient * part.positions()[n];
  const std::vector<Vec3> points{{0.033, 0.0171, 0.0013}, {0.1, 0.04, 0.002}};
  const Eigen::VectorXd u = part.displacement_at(points) * q;
  for (std::size_t p = 0; p < points.size(); ++p)
    EXPECT_LT((u.segment<3>(3 * static_cast<Eigen::Index>(p)) - gradient * points[p]).norm(), 1e-15);
  EXPECT_LT((part.displacement_of(1, true) * q - gradient * Vec3(0.05, 0.04, 0.001)).norm(), 1e-15);
  const std::vector<Vec3> gone{{0.05, 0.03, 0.003}};
  EXPECT_THROW(part.displacement_at(gone), InputError);
}

TEST(Part, NothingLeft) {
  PartShape shape = plate();
  shape.zones.push_back({Vec3(0, 0, 0), shape.size, 0, 1.0});
  EXPECT_THROW(Part(shape, PartElement::plate_8, {}), InputError);
}
