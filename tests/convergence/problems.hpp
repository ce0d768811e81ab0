#pragma once
// Linear problems with known solutions, on clouds of any spacing.
#include "core/geometry/cloud.hpp"
#include "core/operators/discretisation.hpp"
#include "mechanics/statics/statics.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cnem::convergence {

/// A point value of an exact solution.
struct Exact {
  Vec2 displacement{0, 0};
  Mat2 stress = Mat2::Zero();
};

struct Problem {
  std::string name;    ///< of the baseline file
  std::string title;   ///< for the table
  std::string spacing; ///< what the spacings below are relative to
  plasticity::Elasticity elasticity;
  OutOfPlane out_of_plane = OutOfPlane::strain_free;
  std::vector<double> spacings; ///< from coarse to fine
  std::function<Cloud<2>(double)> cloud;
  std::function<Exact(const Vec2&)> exact;
  /// Names of pieces on which displacements are prescribed, and components (0, 1); tractions elsewhere.
  struct Held {
    std::string piece;
    std::vector<Eigen::Index> components;
  };
  std::vector<Held> held;
};

Problem plate_with_hole();
Problem thick_cylinder();
Problem cantilever();
Problem affine_patch();

/// Cook's membrane, n × n cells: tip displacement.
Cloud<2> cook_cloud(int n);

struct Method {
  std::string name;
  std::shared_ptr<Discretisation<2>> method;
  double stabilisation = 0.05;
};
std::vector<Method> methods();

/// Relative errors of one solution.
struct Errors {
  int nodes = 0;
  double l2 = 0.0;     ///< of nodal displacements, weighted with nodal volumes
  double energy = 0.0; ///< of the stress, constant on each cell, integrated over the cells
};
Errors solve(const Problem& problem, const Method& method, double spacing);

/// Vertical displacement of the middle of the loaded edge (48, 52) of Cook's membrane under a shear force
/// of 1.
double cook_tip(const Method& method, const plasticity::Elasticity& elasticity, int n);

} // namespace cnem::convergence
