#include "plasticity/orthotropic.hpp"

#include <cmath>
#include <complex>

namespace cnem::plasticity {

bool Orthotropic::sound_in_plane() const { return nu12 * nu12 * E2 < E1; }

bool Orthotropic::sound_in_space() const {
  const double nu21 = nu12 * E2 / E1, nu31 = nu13 * E3 / E1, nu32 = nu23 * E3 / E2;
  return sound_in_plane() && nu13 * nu31 < 1.0 && nu23 * nu32 < 1.0 &&
         1.0 - nu12 * nu21 - nu23 * nu32 - nu13 * nu31 - 2.0 * nu12 * nu23 * nu31 > 0.0;
}

void PlyStiffness::stress(const double (&e)[3], double (&s)[3]) const {
  s[0] = Q11 * e[0] + Q12 * e[1];
  s[1] = Q12 * e[0] + Q22 * e[1];
  s[2] = Q66 * e[2];
}

double PlyStiffness::largest_eigenvalue() const {
  return std::fmax(0.5 * (Q11 + Q22) + std::hypot(0.5 * (Q11 - Q22), Q12), 2.0 * Q66);
}

PlyStiffness PlyConstants::stiffness(const PlyShares& left) const {
  const double both = left.fibre * left.matrix, by_delta = 1.0 / (1.0 - both * nu12 * nu21());
  return {left.fibre * E1 * by_delta, left.matrix * E2 * by_delta, both * nu12 * E2 * by_delta,
          left.shear * G12};
}

PlyConstants ply_constants(const Orthotropic& elastic, bool stress_free) {
  const double E1 = elastic.E1, E2 = elastic.E2, E3 = elastic.E3;
  if (stress_free) return {E1, E2, elastic.nu12, elastic.G12, {0.0, 0.0}};
  const double out1 = elastic.nu13 * E3 / E1, out2 = elastic.nu23 * E3 / E2; // ν31, ν32
  const double s11 = (1.0 - elastic.nu13 * out1) / E1, s22 = (1.0 - elastic.nu23 * out2) / E2,
               s12 = -(elastic.nu12 + elastic.nu13 * out2) / E1;
  return {1.0 / s11, 1.0 / s22, -s12 / s11, elastic.G12, {out1, out2}};
}

double crack_modulus(const PlyConstants& ply, double angle) {
  using Complex = std::complex<double>;
  const double S11 = 1.0 / ply.E1, S22 = 1.0 / ply.E2, both = 1.0 / ply.G12 - 2.0 * ply.nu12 / ply.E1;
  const double half = 0.5 * both / S11;
  const Complex apart = std::sqrt(Complex(half * half - S22 / S11));
  const double c = std::cos(angle), s = std::sin(angle);
  Complex sum = 0.0, product = 1.0;
  for (const double sign : {1.0, -1.0}) {
    Complex along_fibres = std::sqrt(-half + sign * apart);
    if (along_fibres.imag() < 0.0) along_fibres = -along_fibres;
    const Complex root = (along_fibres * c - s) / (c + along_fibres * s);
    sum += root;
    product *= root;
  }
  const double across = S11 * s * s * s * s + both * s * s * c * c + S22 * c * c * c * c; // compliance
  return 2.0 / (across * std::abs((sum / product).imag()));
}

PlaneStiffness plane_stiffness(const Orthotropic& elastic, bool stress_free) {
  const PlyConstants ply = ply_constants(elastic, stress_free);
  const PlyStiffness q = ply.stiffness();
  const double c = std::cos(elastic.angle), s = std::sin(elastic.angle);
  const double T[3][3] = {
      {c * c, s * s, c * s}, {s * s, c * c, -c * s}, {-2 * c * s, 2 * c * s, c * c - s * s}};
  PlaneStiffness plane{.D = {}, .zz = {}, .thickness = {}, .shear = elastic.G12};
  double stress[3][3]; // in the axes of the ply, over each strain of the model
  for (int j = 0; j < 3; ++j) {
    const double strain[3] = {T[0][j], T[1][j], T[2][j]};
    q.stress(strain, stress[j]);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) plane.D[i][j] += T[k][i] * stress[j][k];
    plane.zz[j] = ply.out_of_plane[0] * stress[j][0] + ply.out_of_plane[1] * stress[j][1];
    if (stress_free)
      plane.thickness[j] =
          -elastic.nu13 / elastic.E1 * stress[j][0] - elastic.nu23 / elastic.E2 * stress[j][1];
  }
  return plane;
}

} // namespace cnem::plasticity
