#include "contact/periods.hpp"

#include "core/index.hpp"

#include <Eigen/Dense>

namespace cnem::contact {

bool add_period(std::vector<Vec3>& independent, const Vec3& period) {
  const double rounding = 1e-3 * period.norm(); // sides match within that share of an edge
  Vec3 beside = period, left = period; // what real multiples of those that are there leave, and whole ones
  if (!independent.empty()) {
    Eigen::Matrix<double, 3, Eigen::Dynamic> all(3, static_cast<Eigen::Index>(independent.size()));
    for (Eigen::Index p = 0; p < all.cols(); ++p) all.col(p) = independent[index_of(p)];
    const Eigen::VectorXd multiple = all.completeOrthogonalDecomposition().solve(period);
    beside -= all * multiple;
    left -= all * multiple.array().round().matrix();
  }
  if (beside.norm() <= rounding) return left.norm() <= rounding;
  independent.push_back(period);
  return true;
}

} // namespace cnem::contact
