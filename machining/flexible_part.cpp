#include "machining/flexible_part.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace cnem::machining {

ModalMotion::ModalMotion(Eigen::MatrixXd follow, const std::vector<Coordinate>& coordinates, double dt)
    : follow_(std::move(follow)), flexibility_(follow_.cols()),
      state_(Eigen::MatrixXd::Zero(2, follow_.cols())) {
  assert(follow_.cols() == as<Eigen::Index>(coordinates.size()));
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const auto& [omega, damping] = coordinates[i];
    flexibility_[as<Eigen::Index>(i)] = 1.0 / (omega * omega);
    free_.emplace_back(
        Mode{.frequency = omega / (2.0 * std::numbers::pi), .damping = damping, .stiffness = omega * omega},
        dt);
  }
}

Eigen::MatrixXd ModalMotion::moved(const Eigen::VectorXd& load) const {
  Eigen::MatrixXd state = state_;
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const auto column = as<Eigen::Index>(i);
    const Vec2 rest(flexibility_[column] * follow_.col(column).dot(load), 0.0);
    state.col(column) = rest + free_[i].of_state * (state_.col(column) - rest);
  }
  return state;
}

Eigen::VectorXd ModalMotion::ask(const Eigen::VectorXd& load) const {
  return follow_ * moved(load).row(0).transpose();
}

void ModalMotion::take(const Eigen::VectorXd& load) { state_ = moved(load); }

void ModalMotion::archive(Archive& archive) {
  std::vector<double> numbers(state_.data(), state_.data() + state_.size());
  archive.list("milling/part/modes", "m kg^0.5", numbers);
  if (as<Eigen::Index>(numbers.size()) != state_.size())
    throw IoError("milling/part/modes holds no modes of this case");
  std::copy(numbers.begin(), numbers.end(), state_.data());
}

double ModalMotion::frequency() const {
  return 1.0 / (2.0 * std::numbers::pi * std::sqrt(flexibility_.maxCoeff()));
}

HexahedralMap hexahedra_over(const Vec3& low, const Vec3& high, double radius,
                             const std::optional<std::array<int, 3>>& cells) {
  const Vec3 beside = 0.5 * Vec3(radius, radius, 0.0), size = high - low + 2.0 * beside;
  std::array<int, 3> count{};
  for (std::size_t a = 0; a < 3; ++a) {
    constexpr double rounding = 1e-9;
    count[a] =
        cells ? (*cells)[a] : static_cast<int>(std::ceil(size[as<Eigen::Index>(a)] / radius - rounding));
  }
  return {low - beside, high + beside, count, size.cwiseMax(radius)};
}

void FlexiblePart::check() const {
  if (const auto cell = end_.folded())
    throw DivergenceError(
        fmt::format("the deformed workpiece is not one-to-one any more: {} folds, its nodes move by up to "
                    "{:.3g} m; expected displacements that are small beside the hexahedra",
                    end_.name(*cell), end_.largest()),
        -1, "displacement");
}

void FlexiblePart::take() {
  motion_->take(load_);
  begin_ = end_;
}

void FlexiblePart::archive(Archive& archive) {
  motion_->archive(archive);
  std::vector<double> nodes(begin_.displacements().begin(), begin_.displacements().end());
  archive.list("milling/part/nodes", "m", nodes);
  if (as<Eigen::Index>(nodes.size()) != begin_.unknowns())
    throw IoError("milling/part/nodes is not of this case's hexahedra");
  begin_.displace(Eigen::Map<const Eigen::VectorXd>(nodes.data(), begin_.unknowns()));
  end_ = begin_;
  std::vector<double> load(load_.begin(), load_.end()); // where the next step's questions begin
  archive.list("milling/part/load", "N", load);
  if (load.size() != nodes.size()) throw IoError("milling/part/load is not of this case's hexahedra");
  load_ = Eigen::Map<const Eigen::VectorXd>(load.data(), load_.size());
}

} // namespace cnem::machining
