#pragma once
// The eigenvalue of largest magnitude of a linear map that is known by what it does to vectors.
#include <Eigen/Core>

#include <complex>
#include <functional>

namespace cnem::machining {

using LinearMap = std::function<void(const Eigen::VectorXd& from, Eigen::VectorXd& to)>;

struct Eigenpair {
  std::complex<double> value;
  Eigen::VectorXcd vector; ///< of length 1
};

/// By Arnoldi's method without restarts, until the magnitude changes by less than `tolerance` of itself.
/// The same bits for the same map: it begins with a fixed vector.
Eigenpair largest_eigenvalue(const LinearMap& map, Eigen::Index size, double tolerance);

} // namespace cnem::machining
