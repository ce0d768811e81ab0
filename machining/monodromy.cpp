#include "machining/monodromy.hpp"

#include "core/index.hpp"
#include "machining/gauss.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace cnem::machining {

namespace {

constexpr int nodes = 8; ///< of an element

using Index = Eigen::Index;

Index size_of(std::size_t n) { return static_cast<Index>(n); }

/// Angles in [0, period) at which factors of a tooth have a jump or a kink, and 0.
std::vector<double> break_points(const MillingCut& cut, const EngagedEdges& edges, double period) {
  std::vector<double> list{0.0};
  for (std::size_t j = 0; j < cut.cutter.teeth(); ++j)
    for (const double change : edges.changes(j)) {
      const double angle = change + cut.cutter.behind(j);
      list.push_back(angle - period * std::floor(angle / period));
    }
  std::sort(list.begin(), list.end());
  list.push_back(period);
  const double same = edges.rounding();
  std::vector<double> apart{0.0};
  for (const double angle : list)
    if (angle > apart.back() + same) apart.push_back(angle);
  if (period - apart.back() < same) apart.back() = period;
  return apart;
}

} // namespace

Monodromy::Monodromy(const MillingCut& cut, std::span<const Mode> modes, double spindle, double depth)
    : modes_(modes.begin(), modes.end()) {
  const Index m = size_of(modes.size());
  participation_.resize(3, m);
  for (Index i = 0; i < m; ++i) {
    participation_.col(i) = modes_[index_of(i)].participation();
    fastest_ = std::max(fastest_, modes_[index_of(i)].omega());
  }
  Eigen::MatrixXd known = participation_; // to chips: a flat end moves along its edges in z
  if (!cut.cutter.rounded()) known.row(2).setZero();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(known);
  qr.setThreshold(1e-9);
  d_ = qr.rank();
  basis_ = Eigen::MatrixXd(qr.householderQ()).leftCols(d_);
  shape_ = basis_.transpose() * known;
  ploughs_ = cut.flank.presses();
  each_ = ploughs_ ? 2 * d_ : d_;
  states_ = 2 * m;
  const EngagedEdges edges(cut, depth, spindle);
  divide(cut, edges, spindle);
  couple(cut, edges, spindle);
  for (Element& element : elements_) solve(element, modes);
}

void Monodromy::divide(const MillingCut& cut, const EngagedEdges& edges, double spindle) {
  const double angle = period_of(cut);
  period_ = angle / spindle;
  const std::vector<double> breaks = break_points(cut, edges, angle);
  // rad of the cutter, rad of the fastest mode; what a tooth cut before it lies in an earlier element.
  const double widest =
      std::min(0.8, 0.5 * *std::min_element(cut.cutter.pitch.begin(), cut.cutter.pitch.end()));
  constexpr double longest = 4.0;
  for (std::size_t b = 1; b < breaks.size(); ++b) {
    const double from = breaks[b - 1], to = breaks[b], middle = 0.5 * (from + to);
    bool cutting = false;
    // One that misses the cut, too: what the next tooth cuts is told from where it was.
    for (std::size_t j = 0; j < cut.cutter.teeth(); ++j)
      cutting |= edges.engages(j, middle - cut.cutter.behind(j));
    const double pieces = std::max((to - from) / widest, fastest_ * (to - from) / spindle / longest);
    const int count = cutting ? static_cast<int>(std::ceil(pieces)) : 1;
    for (int k = 0; k < std::max(count, 1); ++k) {
      Element element;
      element.length = (to - from) / spindle / std::max(count, 1);
      element.begin = from / spindle + k * element.length;
      element.cutting = cutting;
      element.first = displacements_;
      if (cutting) displacements_ += nodes * each_;
      elements_.push_back(std::move(element));
    }
  }
}

void Monodromy::couple(const MillingCut& cut, const EngagedEdges& edges, double spindle) {
  const GaussRule& rule = gauss_rule(nodes);
  const Cutter& cutter = cut.cutter;
  const bool even = period_of(cut) == cutter.pitch[0]; // what was cut before lies one period back
  // Where a time of this period or the one before falls: what cuts now was cut by another tooth then, so that
  // it lies in an element that cuts, but for rounding at its ends.
  const auto find = [&](double time) -> const Element& {
    const Element* best = nullptr;
    double nearest = infinite;
    for (const Element& element : elements_) {
      if (!element.cutting) continue;
      const double away = std::max({element.begin - time, time - element.begin - element.length, 0.0});
      if (away < nearest) {
        nearest = away;
        best = &element;
      }
    }
    assert(best && nearest * spindle < 2.0 * edges.rounding() + 1e-6);
    return *best;
  };
  for (Element& element : elements_) {
    if (!element.cutting) continue;
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      const double time = element.begin + rule.node[k] * element.length;
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(participation_.cols(), each_);
      for (std::size_t j = 0; j < cutter.teeth(); ++j) {
        const double tip = spindle * time - cutter.behind(j);
        if (ploughs_)
          all.rightCols(d_) += fastest_ * participation_.transpose() * edges.damping(j, tip) * basis_;
        const DirectionalFactors w = edges.factors(j, tip);
        if (w.isZero(0.0)) continue;
        const Eigen::MatrixXd modal = participation_.transpose() * w * basis_;
        all.leftCols(d_) += modal;
        if (even && !element.delayed.empty() && element.delayed.back().node == k) {
          element.delayed.back().factors += modal;
          continue;
        }
        if (even) {
          element.delayed.push_back({k, element.first + size_of(k) * each_, true, {}, modal});
          continue;
        }
        double then = time - cutter.pitch_before(j) / spindle;
        constexpr double rounding = 1e-12;
        const bool previous = then < -rounding * period_;
        if (previous) then += period_;
        const Element& source = find(then);
        element.delayed.push_back(
            {k, source.first, previous, lagrange(rule.node, (then - source.begin) / source.length), modal});
      }
      element.factors.push_back(std::move(all));
    }
  }
}

void Monodromy::solve(Element& element, std::span<const Mode> modes) {
  const Index m = size_of(modes.size());
  element.move = Eigen::MatrixXd::Zero(states_, states_);
  for (Index i = 0; i < m; ++i) {
    const FreeMotion free(modes[index_of(i)], element.length);
    for (const auto& [a, row] : {std::pair{0, i}, {1, m + i}}) {
      element.move(row, i) = free.of_state(a, 0);
      element.move(row, m + i) = free.of_state(a, 1);
    }
  }
  if (!element.cutting) return;
  const GaussRule &rule = gauss_rule(nodes), &fine = gauss_rule(16);
  element.shift = Eigen::MatrixXd::Zero(states_, m * nodes);
  element.from_states = Eigen::MatrixXd::Zero(nodes * each_, states_);
  // [unknown × modal force]: what a force at one node does at the others.
  Eigen::MatrixXd reach = Eigen::MatrixXd::Zero(nodes * each_, m * nodes);
  std::vector<std::vector<double>> shape(fine.node.size());
  for (int k = 0; k <= nodes; ++k) { // the last one is the end of the element
    const double x = k < nodes ? rule.node[index_of(k)] : 1.0, length = x * element.length;
    for (std::size_t q = 0; q < fine.node.size(); ++q) shape[q] = lagrange(rule.node, x * fine.node[q]);
    for (Index i = 0; i < m; ++i) {
      const double faster = modes[index_of(i)].omega() / fastest_;
      // What a state (q, v/ω) of the mode is in unknowns of the node.
      const auto at_node = [&](auto&& target, const auto& state) {
        target.topRows(d_) = shape_.col(i) * state[0];
        if (ploughs_) target.bottomRows(d_) = shape_.col(i) * (faster * state[1]);
      };
      if (k < nodes) {
        const FreeMotion free(modes[index_of(i)], length);
        at_node(element.from_states.block(k * each_, i, each_, 1), free.of_state.col(0));
        at_node(element.from_states.block(k * each_, m + i, each_, 1), free.of_state.col(1));
      }
      Eigen::Matrix<double, 2, nodes> response = Eigen::Matrix<double, 2, nodes>::Zero();
      for (std::size_t q = 0; q < fine.node.size(); ++q) {
        const FreeMotion impulse(modes[index_of(i)], length * (1.0 - fine.node[q]));
        for (int l = 0; l < nodes; ++l)
          response.col(l) += fine.weight[q] * length * shape[q][index_of(l)] * impulse.of_impulse;
      }
      for (int l = 0; l < nodes; ++l) {
        if (k < nodes)
          at_node(reach.block(k * each_, l * m + i, each_, 1), response.col(l));
        else {
          element.shift(i, l * m + i) = response(0, l);
          element.shift(m + i, l * m + i) = response(1, l);
        }
      }
    }
  }
  Eigen::MatrixXd system = Eigen::MatrixXd::Identity(nodes * each_, nodes * each_);
  for (int l = 0; l < nodes; ++l)
    system.middleCols(l * each_, each_) -= reach.middleCols(l * m, m) * element.factors[index_of(l)];
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(system);
  element.from_states = lu.solve(element.from_states).eval();
  element.from_delayed = lu.solve(reach);
}

template<class See>
void Monodromy::march(const Eigen::VectorXd& from, Eigen::VectorXd& to, const See& see) const {
  const Index m = states_ / 2;
  Eigen::VectorXd state = from.head(states_), force(m * nodes);
  to.resize(size());
  for (const Element& element : elements_) {
    if (!element.cutting) {
      state = (element.move * state).eval();
      continue;
    }
    force.setZero();
    for (const auto& delayed : element.delayed) {
      const Eigen::VectorXd& period = delayed.previous ? from : to;
      auto target = force.segment(size_of(delayed.node) * m, m);
      const Index at = states_ + delayed.first;
      if (delayed.weights.empty())
        target.noalias() -= delayed.factors * period.segment(at, d_);
      else
        for (int l = 0; l < nodes; ++l)
          target.noalias() -=
              delayed.factors * (delayed.weights[index_of(l)] * period.segment(at + l * each_, d_));
    }
    auto u = to.segment(states_ + element.first, nodes * each_);
    u.noalias() = element.from_states * state;
    u.noalias() += element.from_delayed * force;
    for (int l = 0; l < nodes; ++l)
      force.segment(l * m, m).noalias() += element.factors[index_of(l)] * u.segment(l * each_, each_);
    see(element, force);
    state = (element.move * state + element.shift * force).eval();
  }
  to.head(states_) = state;
}

void Monodromy::operator()(const Eigen::VectorXd& from, Eigen::VectorXd& to) const {
  march(from, to, [](const Element&, const Eigen::VectorXd&) {});
}

double Monodromy::strongest_frequency(std::complex<double> multiplier, const Eigen::VectorXcd& vector) const {
  using Complex = std::complex<double>;
  const Index m = states_ / 2;
  const GaussRule& rule = gauss_rule(nodes);
  struct Sample {
    double time, weight;
    Eigen::VectorXcd force;
  };
  std::vector<Sample> samples;
  for (const Complex part : {Complex(1.0, 0.0), Complex(0.0, 1.0)}) {
    const Eigen::VectorXd from = (std::conj(part) * vector).real();
    Eigen::VectorXd to;
    std::size_t next = 0;
    march(from, to, [&](const Element& element, const Eigen::VectorXd& force) {
      for (std::size_t l = 0; l < rule.node.size(); ++l, ++next) {
        if (next == samples.size())
          samples.push_back({element.begin + rule.node[l] * element.length, rule.weight[l] * element.length,
                             Eigen::VectorXcd::Zero(m)});
        samples[next].force += part * force.segment(size_of(l) * m, m).cast<Complex>();
      }
    });
  }
  // A solution is exp(λt) times something of the period: its harmonics answer the modes' to the forces'.
  const Complex exponent = std::log(multiplier) / period_;
  const int most = static_cast<int>(std::ceil(2.0 * fastest_ * period_ / full_turn)) + 2;
  double strongest = 0.0, frequency = std::abs(exponent.imag());
  for (int k = -most; k <= most; ++k) {
    const Complex lambda = exponent + Complex(0.0, full_turn * k / period_);
    Eigen::VectorXcd displacement = Eigen::VectorXcd::Zero(d_);
    Eigen::VectorXcd harmonic = Eigen::VectorXcd::Zero(m);
    for (const Sample& sample : samples)
      harmonic += sample.weight * std::exp(-lambda * sample.time) * sample.force;
    for (Index i = 0; i < m; ++i) {
      const Mode& mode = modes_[index_of(i)];
      const double w = mode.omega();
      const Complex stiffness = mode.mass() * (lambda * lambda + 2.0 * mode.damping * w * lambda + w * w);
      displacement += shape_.col(i).cast<Complex>() * (harmonic[i] / stiffness);
    }
    if (displacement.norm() > strongest) {
      strongest = displacement.norm();
      frequency = std::abs(lambda.imag());
    }
  }
  return frequency;
}

} // namespace cnem::machining
