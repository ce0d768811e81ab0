#include "study/calibration_search.hpp"

#include <algorithm>
#include <array>
#include <nlopt.hpp>

namespace cnem::study {
namespace {

/// Halton's sequence, between 0 and 1.
double halton(int index, int base) {
  double value = 0.0, part = 1.0;
  for (; index > 0; index /= base) {
    part /= base;
    value += part * (index % base);
  }
  return value;
}

/// The n-th prime, from 0.
int prime(std::size_t n) {
  int candidate = 2;
  for (std::size_t found = 0;; ++candidate) {
    bool divides = false;
    for (int d = 2; d * d <= candidate; ++d) divides = divides || candidate % d == 0;
    if (!divides && found++ == n) return candidate;
  }
}

/// Answers what is known.
class KnownMisfit {
public:
  KnownMisfit(const Evaluator& evaluator, Eigen::Index constants, std::size_t together)
      : evaluator_(evaluator), constants_(constants), together_(together) {}

  double operator()(const std::vector<double>& x) {
    ++asked_;
    if (!replay.wanted.empty() && asked_ > together_) throw nlopt::forced_stop();
    const Eigen::VectorXd place = Eigen::Map<const Eigen::VectorXd>(x.data(), constants_);
    if (const Evaluation* evaluation = evaluator_.known(place)) {
      SearchEnd& end = replay.end;
      if (replay.wanted.empty()) {
        end.course.push_back({place, evaluation->misfit, evaluation->good()});
        if (end.course.back().better_than(end.course[end.best])) end.best = end.course.size() - 1;
      }
      return std::min(evaluation->misfit, failed_misfit); // nothing is worse than a failure
    }
    if (std::find(replay.wanted.begin(), replay.wanted.end(), place) == replay.wanted.end())
      replay.wanted.push_back(place);
    if (asked_ > together_) throw nlopt::forced_stop();
    return 1.0; // of no account: the search is played again
  }

  SearchReplay replay;

private:
  const Evaluator& evaluator_;
  Eigen::Index constants_;
  std::size_t together_, asked_ = 0;
};

} // namespace

Eigen::VectorXd start_place(const Calibration& calibration, int k) {
  const std::size_t n = calibration.constants.size();
  Eigen::VectorXd place(static_cast<Eigen::Index>(n));
  for (std::size_t c = 0; c < n; ++c) {
    const SoughtConstant& constant = calibration.constants[c];
    place[static_cast<Eigen::Index>(c)] = k == 0 ? constant.place_of(constant.start) : halton(k, prime(c));
  }
  return place;
}

SearchReplay replay_search(const Calibration& calibration, const Eigen::VectorXd& start,
                           const Evaluator& evaluator) {
  constexpr double first_step = 0.1;
  // BOBYQA needs two variables: beside a single constant an idle one stands.
  const auto n = static_cast<unsigned>(std::max<std::size_t>(2, calibration.constants.size()));
  KnownMisfit misfit(evaluator, start.size(), 2 * n + 1);
  nlopt::opt search(nlopt::LN_BOBYQA, n);
  search.set_lower_bounds(0.0);
  search.set_upper_bounds(1.0);
  search.set_initial_step(first_step);
  search.set_xtol_abs(calibration.tolerance);
  search.set_maxeval(calibration.evaluations / calibration.starts);
  search.set_min_objective([](const std::vector<double>& x, std::vector<double>&,
                              void* data) { return (*static_cast<KnownMisfit*>(data))(x); },
                           &misfit);
  std::vector<double> x(n, 0.5);
  std::copy(start.begin(), start.end(), x.begin());
  std::string reason = "it can get no closer within rounding";
  try {
    double least = 0.0;
    reason = search.optimize(x, least) == nlopt::MAXEVAL_REACHED ? "the evaluations are used up"
                                                                 : "the constants no longer change";
  } catch (const nlopt::forced_stop&) {
  } catch (const nlopt::roundoff_limited&) {}
  misfit.replay.end.reason = reason;
  return misfit.replay;
}

} // namespace cnem::study
