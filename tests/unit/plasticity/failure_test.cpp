// Failure of plies: indices, strengths and modes against tests/data/ply.py, energies, what damage keeps.
#include "tests/unit/plasticity/ply_points.hpp"
#include "tests/unit/plasticity/tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace cnem::plasticity::test {
namespace {

constexpr const char* mode_names[] = {"fibre_tension", "fibre_compression", "matrix_tension",
                                      "matrix_compression", "shear"};

/// The plies of tests/data/ply.py by name, with a criterion; energies so large that nothing snaps back.
Material ply_of_table(const std::string& name, const std::string& criterion) {
  const std::vector<Row> rows = read_csv("ply_constants.csv");
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r[0] == name; });
  const auto at = [&](std::size_t k) { return std::stod(row->at(k)); };
  Material m;
  m.density = 1600.0;
  m.ply = Orthotropic{.E1 = at(1), .E2 = at(2), .nu12 = at(3), .G12 = at(4), .E3 = at(2), .nu13 = at(3)};
  const auto* const law =
      std::find(std::begin(failure_criterion_names), std::end(failure_criterion_names), criterion);
  m.failure = Failure{.criterion = static_cast<FailureCriterion>(law - failure_criterion_names),
                      .Xt = at(5),
                      .Xc = at(6),
                      .Yt = at(7),
                      .Yc = at(8),
                      .S = at(9),
                      .eps1t = at(10),
                      .alpha0 = at(11) * degrees,
                      .Gft = 1e4,
                      .Gfc = 1e4,
                      .Gmt = 1e3,
                      .Gmc = 1e3,
                      .Gs = 1e3};
  return m;
}

/// ε11, ε22, γ12 of a stress without stress out of the plane.
Eigen::Vector3d strain_of(const Orthotropic& p, const Eigen::Vector3d& s) {
  return {(s[0] - p.nu12 * s[1]) / p.E1, s[1] / p.E2 - p.nu12 * s[0] / p.E1, s[2] / p.G12};
}

TEST(Failure, indices_as_worked_out_without_the_program) {
  int rows = 0;
  for (const Row& row : read_csv("ply_indices.csv")) {
    const Material m = ply_of_table(row[0], row[1]);
    PlyPoint point(m);
    const Eigen::Vector3d stress(std::stod(row[2]), std::stod(row[3]), std::stod(row[4]));
    ASSERT_TRUE(point.set(stretch(strain_of(*m.ply, stress), 0.0), 0.0));
    const Field* index[] = {&point.state.fibre_tension_index, &point.state.fibre_compression_index,
                            &point.state.matrix_tension_index, &point.state.matrix_compression_index,
                            &point.state.shear_index};
    for (std::size_t mode = 0; mode < 5; ++mode) {
      const double wanted = std::stod(row[5 + mode]);
      EXPECT_NEAR((*index[mode])[0], wanted, 1e-6 + 1e-5 * wanted)
          << row[0] << " " << row[1] << " " << stress.transpose();
    }
    ++rows;
  }
  EXPECT_EQ(rows, 2 * 3 * 27);
}

/// Whether a mode stands in a list "a+b".
bool begins(const std::string& modes, const std::string& mode) {
  return ("+" + modes + "+").find("+" + mode + "+") != std::string::npos;
}

TEST(Failure, strengths_off_the_axes_and_their_modes) {
  for (const Row& row : read_csv("ply_strengths.csv")) {
    const double angle = std::stod(row[2]) * degrees, sign = std::stod(row[3]), strength = std::stod(row[4]);
    const double c = std::cos(angle), s = std::sin(angle);
    for (const double share : {0.9995, 1.0005}) {
      Material m = ply_of_table(row[0], row[1]);
      m.ply->angle = angle; // pulled along x: the body of the model is turned against its fibres
      PlyPoint point(m, true, 1e-7);
      const Eigen::Vector3d stress = sign * share * strength * Eigen::Vector3d(c * c, s * s, -s * c);
      ASSERT_TRUE(point.set(stretch(strain_of(*m.ply, stress), angle), 1e-9));
      for (std::size_t mode = 0; mode < 5; ++mode)
        EXPECT_EQ(point.state.begun[mode][0] > 0.0, share > 1.0 && begins(row[5], mode_names[mode]))
            << row[0] << " " << row[1] << " " << row[2] << "° " << sign << " " << share << " "
            << mode_names[mode];
    }
  }
}

struct Broken {
  double released = 0.0; ///< J/m²
  double work = 0.0;     ///< J/m²
};

/// Drives a point of length ℓ along a strain until it is broken.
Broken drive(const Material& m, const Eigen::Vector3d& direction, double largest, double length, int steps,
             double dt, PlyPoint* last = nullptr) {
  PlyPoint point(m, true, length);
  Broken sum;
  Mat2 before = Mat2::Identity(), stress = Mat2::Zero();
  for (int k = 1; k <= steps; ++k) {
    const Mat2 F = stretch(largest * k / steps * direction, 0.0);
    EXPECT_TRUE(point.set(F, dt));
    sum.work += length * 0.5 * (stress + point.piola()).cwiseProduct(F - before).sum();
    sum.released += length * point.state.failure_release[0];
    before = F, stress = point.piola();
  }
  if (last) *last = point;
  return sum;
}

TEST(Failure, modes_take_their_energy_whatever_the_length) {
  struct Mode {
    const char* law;
    int mode;
    Eigen::Vector3d direction;
    double energy, opened; ///< J/m², m where all is spent
  };
  Material m = ply_of_table("gfrp", "hashin");
  for (const Mode& mode : {Mode{"hashin", fibre_tension, {1, 0, 0}, 1e4, 2e4 / 697.8e6},
                           Mode{"hashin", fibre_compression, {-1, 0, 0}, 1e4, 2e4 / 443.76e6},
                           Mode{"hashin", matrix_tension, {0, 1, 0}, 1e3, 2e3 / 89.7216e6},
                           Mode{"hashin", matrix_compression, {0, -1, 0}, 1e3, 2e3 / 148.33e6},
                           Mode{"max-stress", ply_shear, {0, 0, 1}, 1e3, 2e3 / 33.1e6},
                           Mode{"larc02", fibre_tension, {1, 0, 0}, 1e4, 2e4 / 788.44e6},
                           Mode{"larc02", matrix_compression, {0, -1, 0}, 1e3, 2e3 / 148.33e6}})
    for (const double length : {1e-5, 1e-4, 5e-4}) {
      m.failure->criterion = ply_of_table("gfrp", mode.law).failure->criterion;
      m.ply->nu12 = 0.0; // one stress for one strain
      if (std::string(mode.law) == "hashin" && mode.mode == fibre_tension) m.failure->S = 1e12; // alone
      PlyPoint last(m);
      // as far as the opening at which all is spent, over the length; strains that a bar would not see
      const Broken sum = drive(m, mode.direction, mode.opened / length, length, 4000, 1e-9, &last);
      // a hundredth of the strength is left: what it stores then is not let go
      EXPECT_NEAR(sum.released, mode.energy, 0.01 * mode.energy) << mode.law << mode.mode << " " << length;
      EXPECT_NEAR(sum.work, sum.released + length * last.energy(), 2e-3 * mode.energy)
          << mode.law << mode.mode;
      m.failure->S = 33.1e6;
    }
}

TEST(Failure, sudden_loss_spends_less_the_smaller_the_cell) {
  Material m = ply_of_table("gfrp", "max-stress");
  m.failure->degradation = Degradation::sudden;
  m.ply->nu12 = 0.0;
  const double onset = 89.7216e6 / 11.57e9, stored = 0.5 * 89.7216e6 * onset;
  const auto released = [&](double length) { // held at the strain of its onset for many times ℓ/c
    PlyPoint point(m, true, length);
    EXPECT_TRUE(point.set(stretch({0.0, onset * (1 - 1e-9), 0.0}, 0.0), 1e-9));
    EXPECT_EQ(point.state.matrix_tension_damage[0], 0.0);
    double sum = 0.0;
    for (int k = 0; k < 400; ++k) {
      EXPECT_TRUE(point.set(stretch({0.0, onset * (1 + 1e-9), 0.0}, 0.0), 0.05 * length / 4658.0));
      sum += length * point.state.failure_release[0];
    }
    EXPECT_EQ(point.state.matrix_tension_damage[0], Failure::broken);
    return sum;
  };
  EXPECT_NEAR(released(1e-4), 0.99 * stored * 1e-4, 1e-3 * stored * 1e-4);
  EXPECT_NEAR(released(2e-4) / released(1e-4), 2.0, 1e-9);
  // at the rate (1 − d) c/ℓ from the onset on
  PlyPoint point(m, true, 1e-4);
  EXPECT_TRUE(point.set(stretch({0.0, onset * (1 + 1e-9), 0.0}, 0.0), 1e-9));
  const double c = std::sqrt(34.28e9 / 1600.0);
  EXPECT_NEAR(point.state.matrix_tension_damage[0], 1.0 - std::exp(-c * 1e-9 / 1e-4), 1e-12);
}

TEST(Failure, cracks_close_and_damage_stays) {
  Material m = ply_of_table("gfrp", "max-stress");
  PlyPoint point(m, true, 1e-4);
  const auto stress_at = [&](double strain) {
    EXPECT_TRUE(point.set(stretch({0.0, strain, 0.0}, 0.0), 1e-9));
    return (point.piola() * stretch({0.0, strain, 0.0}, 0.0)).eval()(1, 1);
  };
  const double onset = 89.7216e6 / 11.57e9;
  stress_at(3.0 * onset);
  const double d = point.state.matrix_tension_damage[0];
  EXPECT_GT(d, 0.6);
  const double half = stress_at(1.5 * onset);
  EXPECT_EQ(point.state.matrix_tension_damage[0], d); // it does not heal
  EXPECT_EQ(point.state.failure_release[0], 0.0);
  const PlyShares left{.fibre = 1.0, .matrix = 1.0 - d};
  const PlyConstants elastic = ply_constants(*m.ply, true);
  EXPECT_NEAR(half, elastic.stiffness(left).Q22 * 1.5 * onset, 1e-6 * half);
  EXPECT_NEAR(stress_at(-onset), -elastic.stiffness().Q22 * onset, 1.0); // faces bear on each other
  EXPECT_EQ(point.state.matrix_compression_damage[0], 0.0);
}

TEST(Failure, longest_length_is_that_of_snap_back) {
  const PlyConstants elastic = ply_constants(*gfrp(0.0).ply, true);
  Material m = ply_of_table("gfrp", "max-stress");
  m.failure->Gft = m.failure->Gfc = 12.5e3;
  // 2 G E/X², mm: the table of energies of Lapczyk and Hurtado 2007
  EXPECT_NEAR(m.failure->longest_length(elastic, fibre_tension), 1.76e-3, 5e-6);
  EXPECT_NEAR(m.failure->longest_length(elastic, fibre_compression), 4.35e-3, 5e-6);
  EXPECT_NEAR(m.failure->longest_length(elastic, matrix_tension), 2.87e-3, 5e-6);
  EXPECT_NEAR(m.failure->longest_length(elastic, matrix_compression), 1.05e-3, 5e-6);
  EXPECT_NEAR(m.failure->longest_length(elastic, ply_shear), 2.0e3 * 2.05e9 / (33.1e6 * 33.1e6), 1e-9);
  m.failure->criterion = FailureCriterion::hashin;
  EXPECT_EQ(m.failure->longest_length(elastic, ply_shear), infinite);
}

} // namespace
} // namespace cnem::plasticity::test
