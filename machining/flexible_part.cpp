#include "machining/flexible_part.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "machining/milling_ledger.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace cnem::machining {

ModalMotion::ModalMotion(Eigen::MatrixXd follow, const std::vector<Coordinate>& coordinates)
    : follow_(std::move(follow)), state_(Eigen::MatrixXd::Zero(2, follow_.cols())) {
  assert(follow_.cols() == as<Eigen::Index>(coordinates.size()));
  for (const auto& [omega, damping] : coordinates)
    mode_.push_back(
        {.frequency = omega / (2.0 * std::numbers::pi), .damping = damping, .stiffness = omega * omega});
}

void ModalMotion::begin(double dt) {
  if (dt == dt_) return;
  dt_ = dt;
  free_.clear();
  loss_.clear();
  for (const Mode& mode : mode_) {
    free_.emplace_back(mode, dt);
    loss_.push_back(damping_loss(mode, dt));
  }
}

double ModalMotion::rest_of(std::size_t i, const Eigen::VectorXd& load) const {
  return follow_.col(as<Eigen::Index>(i)).dot(load) / mode_[i].stiffness;
}

Eigen::MatrixXd ModalMotion::moved(const Eigen::VectorXd& load) const {
  assert(free_.size() == mode_.size());
  Eigen::MatrixXd state = state_;
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const auto column = as<Eigen::Index>(i);
    const Vec2 rest(rest_of(i, load), 0.0);
    state.col(column) = rest + free_[i].of_state * (state_.col(column) - rest);
  }
  return state;
}

Eigen::VectorXd ModalMotion::ask(const Eigen::VectorXd& load) const {
  return follow_ * moved(load).row(0).transpose();
}

void ModalMotion::take(const Eigen::VectorXd& load) {
  Eigen::MatrixXd state = moved(load);
  energy_.work += load.dot(follow_ * (state.row(0) - state_.row(0)).transpose());
  energy_.kinetic = energy_.elastic = 0.0;
  for (std::size_t i = 0; i < mode_.size(); ++i) {
    const auto column = as<Eigen::Index>(i);
    const Vec2 begin = state_.col(column) - Vec2(rest_of(i, load), 0.0);
    energy_.damping += begin.dot(loss_[i] * begin);
    energy_.elastic += 0.5 * mode_[i].stiffness * state(0, column) * state(0, column);
    energy_.kinetic += 0.5 * mode_[i].stiffness * state(1, column) * state(1, column);
  }
  state_ = std::move(state);
}

void ModalMotion::rest() {
  lose_what_it_holds();
  state_.setZero();
}

void ModalMotion::archive(Archive& archive) {
  std::vector<double> numbers(state_.data(), state_.data() + state_.size());
  archive.list("milling/part/modes", "m kg^0.5", numbers);
  if (as<Eigen::Index>(numbers.size()) != state_.size())
    throw IoError("milling/part/modes holds no modes of this case");
  std::copy(numbers.begin(), numbers.end(), state_.data());
  energy_.archive(archive, "milling/part/energy/");
}

double ModalMotion::frequency() const {
  double lowest = mode_.front().frequency;
  for (const Mode& mode : mode_) lowest = std::min(lowest, mode.frequency);
  return lowest;
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

void FlexiblePart::rest() {
  motion_->rest();
  load_.setZero();
  end_.displace(Eigen::VectorXd::Zero(end_.unknowns()));
  begin_ = end_;
}

void FlexiblePart::take() {
  motion_->take(load_);
  begin_ = end_;
}

void FlexiblePart::go_back(const Eigen::VectorXd& load) {
  load_ = load;
  end_ = begin_;
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
