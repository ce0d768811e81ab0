#include "contact/images.hpp"

#include "core/index.hpp"

#include <Eigen/Dense>
#include <array>
#include <cassert>
#include <cmath>

namespace cnem::contact {

std::vector<Vec3> images(std::span<const Vec3> period, const Vec3& extent, double margin) {
  std::vector<Vec3> found{Vec3::Zero()};
  if (period.empty()) return found;
  const Vec3 reach = extent + Vec3::Constant(margin);
  assert(period.size() <= 3);
  Eigen::Matrix<double, 3, Eigen::Dynamic> all(3, static_cast<Eigen::Index>(period.size()));
  for (std::size_t p = 0; p < period.size(); ++p) all.col(static_cast<Eigen::Index>(p)) = period[p];
  const Eigen::MatrixXd inverse = all.completeOrthogonalDecomposition().pseudoInverse();
  std::array<int, 3> most{0, 0, 0}; // multiples that a vector within reach may have
  for (Eigen::Index p = 0; p < all.cols(); ++p)
    most[index_of(p)] = static_cast<int>(std::floor(inverse.row(p).cwiseAbs().dot(reach.transpose())));
  for (int i = 0; i <= most[0]; ++i)
    for (int j = -most[1]; j <= most[1]; ++j)
      for (int k = -most[2]; k <= most[2]; ++k) {
        if (i == 0 && (j < 0 || (j == 0 && k <= 0))) continue; // none, or the opposite of one that counts
        Vec3 shift = Vec3::Zero();
        for (Eigen::Index p = 0; p < all.cols(); ++p) shift += std::array{i, j, k}[index_of(p)] * all.col(p);
        if ((shift.cwiseAbs().array() > reach.array()).any()) continue;
        found.push_back(shift);
        found.push_back(-shift);
      }
  return found;
}

} // namespace cnem::contact
