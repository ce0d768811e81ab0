#include "study/calibration_least_squares.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::study {
namespace {

constexpr double difference_step = 0.03; ///< of a place, for sensitivities

/// The damped step to the least squares of r + J step. A constant that stands at a bound stays there if the
/// step would leave it.
Eigen::VectorXd damped_step(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                            const Eigen::VectorXd& place, double damping) {
  const Eigen::Index n = place.size();
  Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < n; ++k)
    if (jacobian.col(k).allFinite()) free.push_back(k);
  while (!free.empty()) {
    const Eigen::MatrixXd part = jacobian(Eigen::all, free);
    Eigen::MatrixXd normal = part.transpose() * part;
    normal.diagonal().array() += damping * normal.diagonal().maxCoeff();
    const Eigen::VectorXd solved = normal.ldlt().solve(-part.transpose() * residual);
    step.setZero();
    step(free) = solved;
    const auto leaves = [&](Eigen::Index k) {
      return (place[k] <= 0.0 && step[k] < 0.0) || (place[k] >= 1.0 && step[k] > 0.0);
    };
    if (std::erase_if(free, leaves) == 0) return step;
  }
  return Eigen::VectorXd::Zero(n);
}

std::optional<Eigen::MatrixXd> jacobian_at(const Eigen::VectorXd& place, Evaluator& evaluator) {
  std::vector<Eigen::VectorXd> sides;
  for (Eigen::Index k = 0; k < place.size(); ++k)
    for (const double way : {-1.0, 1.0}) {
      sides.push_back(place);
      sides.back()[k] = std::clamp(place[k] + way * difference_step, 0.0, 1.0);
    }
  if (!evaluator.evaluate(sides)) return std::nullopt;
  const Evaluation& middle = *evaluator.known(place);
  Eigen::MatrixXd jacobian(middle.residual.size(), place.size());
  for (Eigen::Index k = 0; k < place.size(); ++k) {
    const auto usable = [&](std::size_t side) -> const Evaluation& {
      const Evaluation& one = *evaluator.known(sides[side]);
      return one.good() && one.residual.size() == middle.residual.size() ? one : middle;
    };
    const Evaluation &low = usable(2 * index_of(k)), &high = usable(2 * index_of(k) + 1);
    if (high.place[k] > low.place[k])
      jacobian.col(k) = (high.residual - low.residual) / (high.place[k] - low.place[k]);
    else
      jacobian.col(k).setConstant(std::nan(""));
  }
  return jacobian;
}

/// Steps with the same sensitivities, an evaluation each, while they promise to lessen the misfit. None after
/// a signal.
std::optional<Eigen::VectorXd> steps_with(const Linearised& at, Evaluator& evaluator) {
  constexpr int most_steps = 4;
  constexpr double least_gain = 1e-3; // of the misfit: no run is made for less
  const auto change = [&](const Eigen::VectorXd& step) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(at.jacobian.rows());
    for (Eigen::Index k = 0; k < step.size(); ++k)
      if (step[k] != 0.0) sum += step[k] * at.jacobian.col(k);
    return sum;
  };
  Eigen::VectorXd best = at.place;
  double damping = 1e-4;
  for (int k = 0; k < most_steps; ++k) {
    const double misfit = evaluator.known(best)->misfit;
    const Eigen::VectorXd residual = evaluator.known(best)->residual;
    const Eigen::VectorXd next =
        (best + damped_step(at.jacobian, residual, best, damping)).cwiseMax(0.0).cwiseMin(1.0);
    if (!((residual + change(next - best)).squaredNorm() < (1.0 - least_gain) * misfit)) break;
    if (!evaluator.evaluate({next})) return std::nullopt;
    const Evaluation& there = *evaluator.known(next);
    const bool better = there.good() && there.misfit < misfit && there.residual.size() == residual.size();
    damping *= better ? 0.1 : 100.0;
    if (better) best = next;
  }
  return best;
}

} // namespace

std::optional<Linearised> least_squares_from(Eigen::VectorXd place, Evaluator& evaluator) {
  constexpr int most_steps = 30, most_trials = 6;
  constexpr double least_gain = 1e-4; // of the misfit, by a step that is hardly damped
  double damping = 1e-2;
  for (int round = 0; round < most_steps; ++round) {
    const std::optional<Eigen::MatrixXd> jacobian = jacobian_at(place, evaluator);
    if (!jacobian) return std::nullopt;
    const double misfit = evaluator.known(place)->misfit;
    const Eigen::VectorXd residual = evaluator.known(place)->residual;
    bool better = false;
    for (int trial = 0; trial < most_trials && !better; ++trial) {
      const Eigen::VectorXd next =
          (place + damped_step(*jacobian, residual, place, damping)).cwiseMax(0.0).cwiseMin(1.0);
      if (!evaluator.evaluate({next})) return std::nullopt;
      const Evaluation& there = *evaluator.known(next);
      better = there.good() && there.misfit < misfit;
      damping *= better ? 0.1 : 10.0;
      if (better) place = next;
    }
    if (!better) break;
    constexpr double hardly = 1e-7;
    if (evaluator.known(place)->misfit > (1.0 - least_gain) * misfit && damping < hardly) break;
  }
  std::optional<Eigen::MatrixXd> jacobian = jacobian_at(place, evaluator);
  if (!jacobian) return std::nullopt;
  return Linearised{std::move(place), std::move(*jacobian)};
}

std::optional<Linearised> few_steps_from(const Eigen::VectorXd& place, Evaluator& evaluator) {
  constexpr int most_rounds = 3;
  Linearised at{place, {}};
  for (int round = 0; round <= most_rounds; ++round) {
    std::optional<Eigen::MatrixXd> jacobian = jacobian_at(at.place, evaluator);
    if (!jacobian) return std::nullopt;
    at.jacobian = std::move(*jacobian);
    if (round == most_rounds) break;
    const std::optional<Eigen::VectorXd> next = steps_with(at, evaluator);
    if (!next) return std::nullopt;
    const double moved = (*next - at.place).cwiseAbs().maxCoeff();
    at.place = *next;
    if (moved <= difference_step) break;
  }
  return at;
}

} // namespace cnem::study
