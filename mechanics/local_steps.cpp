#include "mechanics/local_steps.hpp"

#include "core/index.hpp"
#include "core/machine/parallel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

namespace cnem {

namespace {

template<int dim> constexpr std::size_t block = LocalSteps<dim>::block;

std::size_t blocks_of(std::size_t items, std::size_t size) { return (items + size - 1) / size; }

/// [node] level of its finest point.
template<int dim>
std::vector<std::int8_t> finest_point(const DiscreteOperators<dim>& op,
                                      const typename LocalSteps<dim>::Levels& level) {
  std::vector<std::int8_t> finest(index_of(op.nodes));
  for (std::size_t j = 0; j < finest.size(); ++j) {
    std::int8_t least = op.nodal ? level[j / block<dim>] : std::numeric_limits<std::int8_t>::max();
    for (std::size_t e = index_of(op.col_begin[j]); e < index_of(op.col_begin[j + 1]); ++e)
      least = std::min(least, level[index_of(op.point[e]) / block<dim>]);
    finest[j] = least;
  }
  return finest;
}

/// Updates of all points over one unit of time.
double cost(const std::vector<std::int8_t>& level, std::size_t points, std::size_t size, double finest) {
  double sum = 0.0;
  for (std::size_t b = 0; b < level.size(); ++b)
    sum += static_cast<double>(std::min(size, points - b * size)) / static_cast<double>(1 << level[b]);
  return sum / finest;
}

/// Runs of whole blocks that agree in level and mark, cut where the blocks of core/machine/parallel.hpp are.
void append(std::vector<LevelRange>& list, std::size_t begin, std::size_t end, int level, bool marked) {
  if (!list.empty()) {
    LevelRange& last = list.back();
    if (last.end == begin && last.level == level && last.marked == marked && begin % block_size != 0) {
      last.end = end;
      return;
    }
  }
  list.push_back({begin, end, level, marked});
}

} // namespace

template<int dim>
void LocalSteps<dim>::grade(const DiscreteOperators<dim>& op, const StabilisationLinks<dim>& links,
                            Levels& level) {
  for (bool changed = true; changed;) {
    changed = false;
    const std::vector<std::int8_t> finest = finest_point(op, level);
    const auto lower = [&](std::size_t p, int to) {
      std::int8_t& own = level[p / block];
      if (own <= to) return;
      own = static_cast<std::int8_t>(to);
      changed = true;
    };
    for (std::size_t p = 0; p < index_of(op.points); ++p) {
      for (std::size_t e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e)
        lower(p, finest[index_of(op.node[e])] + 1);
      if (links.neighbour.empty()) continue;
      for (std::size_t e = index_of(links.begin[p]); e < index_of(links.begin[p + 1]); ++e)
        lower(p, level[index_of(links.neighbour[e]) / block] + 1);
    }
  }
}

template<int dim>
std::pair<double, std::size_t> LocalSteps<dim>::finest_step(const Levels& level, const Field& stable) {
  std::pair<double, std::size_t> finest{std::numeric_limits<double>::infinity(), 0};
  for (std::size_t b = 0; b < level.size(); ++b)
    if (const double dt = stable[b] / static_cast<double>(1 << level[b]); dt < finest.first) finest = {dt, b};
  return finest;
}

template<int dim>
typename LocalSteps<dim>::Levels LocalSteps<dim>::choose(const DiscreteOperators<dim>& op,
                                                         const StabilisationLinks<dim>& links,
                                                         const Field& stable) {
  const std::size_t points = index_of(op.points);
  const auto cost_of = [&](const Levels& level) {
    return cost(level, points, block, finest_step(level, stable).first);
  };
  constexpr double worth_changing = 1.05;
  const bool fits = level_.size() == stable.size();
  const double kept_cost = fits ? cost_of(level_) : 0.0;
  if (fits && kept_cost <= worth_changing * chosen_cost_) return level_;

  const Levels one(stable.size(), 0);
  const double all = cost_of(one), finest = finest_step(one, stable).first;
  Levels fresh = one;
  for (std::size_t b = 0; b < stable.size(); ++b)
    fresh[b] =
        static_cast<std::int8_t>(std::min(control_.levels - 1.0, std::floor(std::log2(stable[b] / finest))));
  grade(op, links, fresh);
  chosen_cost_ = cost_of(fresh);
  if (all < control_.least_gain * chosen_cost_) {
    fresh = one;
    chosen_cost_ = all;
  }
  if (!fits || kept_cost > worth_changing * chosen_cost_) return fresh;
  Levels graded = level_;
  grade(op, links, graded);
  if (graded != level_) return fresh;
  chosen_cost_ = kept_cost;
  return level_;
}

template<int dim> void LocalSteps<dim>::follow(const NodeRows& labels) {
  Levels followed(blocks_of(labels.size(), block), std::numeric_limits<std::int8_t>::max());
  for (std::size_t i = 0; i < labels.size(); ++i)
    followed[i / block] =
        std::min(followed[i / block], level_[index_of(labels.from[index_of(labels.begin[i])]) / block]);
  level_ = std::move(followed);
}

template<int dim>
void LocalSteps<dim>::set_levels(Levels level, const DiscreteOperators<dim>& op,
                                 const StabilisationLinks<dim>& links, const std::vector<bool>& finest) {
  level_ = std::move(level);
  const std::size_t nodes = index_of(op.nodes), points = index_of(op.points);
  level_.resize(blocks_of(points, block), 0);
  highest_ = *std::max_element(level_.begin(), level_.end());
  const std::vector<std::int8_t> least = finest_point(op, level_);
  kick_.assign(blocks_of(nodes, block), std::numeric_limits<std::int8_t>::max());
  for (std::size_t i = 0; i < nodes; ++i) kick_[i / block] = std::min(kick_[i / block], least[i]);
  move_ = kick_;
  for (std::size_t i = 0; i < nodes; ++i)
    if (finest[i]) move_[i / block] = 0;
  std::vector<bool> silent(level_.size(), false);
  for (std::size_t p = 0; p < points; ++p)
    for (std::size_t e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e)
      if (kick_[index_of(op.node[e]) / block] < level_[p / block]) silent[p / block] = true;
  split(links);
  list(op, silent);
}

template<int dim> void LocalSteps<dim>::set_one_level(const DiscreteOperators<dim>& op) {
  level_.clear();
  highest_ = 0;
  updates_ = static_cast<double>(op.nodes);
  due_.assign(1, {});
  Due& due = due_.front();
  const auto in_blocks = [](std::size_t n, bool marked) {
    std::vector<LevelRange> ranges;
    for (std::size_t begin = 0; begin < n; begin += block_size)
      ranges.push_back({begin, std::min(begin + block_size, n), 0, marked});
    return ranges;
  };
  due.points = in_blocks(index_of(op.points), false);
  due.kicked = in_blocks(index_of(op.nodes), op.nodal);
  due.moved = in_blocks(index_of(op.nodes), true);
}

template<int dim> void LocalSteps<dim>::split(const StabilisationLinks<dim>& links) {
  has_coarse_.assign(level_.size(), false);
  own_ = coarse_ = {};
  if (links.neighbour.empty()) return;
  const std::size_t nodes = links.begin.size() - 1;
  for (StabilisationLinks<dim>* part : {&own_, &coarse_}) part->begin.assign(nodes + 1, 0);
  own_.neighbour.reserve(links.neighbour.size());
  own_.weight.reserve(links.weight.size());
  for (std::size_t i = 0; i < nodes; ++i) {
    for (std::size_t e = index_of(links.begin[i]); e < index_of(links.begin[i + 1]); ++e) {
      const int coarser = level_[index_of(links.neighbour[e]) / block] - level_[i / block];
      StabilisationLinks<dim>& part = coarser > 0 ? coarse_ : own_;
      part.neighbour.push_back(links.neighbour[e]);
      part.weight.push_back(coarser > 0 ? links.weight[e] * (1 << coarser) : links.weight[e]);
      if (coarser > 0) has_coarse_[i / block] = true;
    }
    own_.begin[i + 1] = as<std::int32_t>(own_.neighbour.size());
    coarse_.begin[i + 1] = as<std::int32_t>(coarse_.neighbour.size());
  }
}

template<int dim>
void LocalSteps<dim>::list(const DiscreteOperators<dim>& op, const std::vector<bool>& silent) {
  const std::size_t nodes = index_of(op.nodes), points = index_of(op.points);
  due_.assign(at(highest_) + 1, {});
  updates_ = 0.0;
  for (std::size_t b = 0; b < level_.size(); ++b) {
    const std::size_t begin = b * block, end = std::min(begin + block, points);
    for (int a = level_[b]; a <= highest_; ++a) {
      Due& due = due_[at(a)];
      append(due.points, begin, end, level_[b], has_coarse_[b]);
      if (level_[b] > 0 && silent[b]) append(due.silenced, begin, end, level_[b], true);
    }
  }
  for (std::size_t b = 0; b < kick_.size(); ++b) {
    const std::size_t begin = b * block, end = std::min(begin + block, nodes);
    const int finest = op.nodal ? level_[b] : kick_[b];
    updates_ += static_cast<double>((end - begin) << (highest_ - finest));
    for (int a = 0; a <= highest_; ++a) {
      Due& due = due_[at(a)];
      const bool kicked = kick_[b] <= a;
      if (kicked) append(due.kicked, begin, end, kick_[b], op.nodal && level_[b] <= a);
      if (move_[b] <= a) append(due.moved, begin, end, move_[b], kicked);
    }
  }
}

template<int dim> void LocalSteps<dim>::archive(Archive& archive) {
  std::vector<double> level(level_.begin(), level_.end());
  archive.list("solver/local/level", "1", level);
  archive.number("solver/local/chosen_cost", "1/s", chosen_cost_);
  level_.clear();
  for (const double l : level) level_.push_back(static_cast<std::int8_t>(l));
}

template<int dim> int LocalSteps<dim>::activity(int s) const {
  return s == sub_steps() ? highest_ : std::countr_zero(static_cast<unsigned>(s));
}

template<int dim>
double LocalSteps<dim>::window(const DiscreteOperators<dim>& op, NodeIndex node, int activity) const {
  double sum = 0.0, whole = 0.0;
  const std::size_t j = index_of(node);
  for (std::size_t e = index_of(op.col_begin[j]); e < index_of(op.col_begin[j + 1]); ++e) {
    double square = 0.0;
    for (std::size_t k = 0; k < dim; ++k) square += op.weighted_gradient[k][e] * op.weighted_gradient[k][e];
    const double share = std::sqrt(square);
    const int level = level_[index_of(op.point[e]) / block];
    whole += share;
    if (level <= activity) sum += share * (1 << level);
  }
  return sum / whole;
}

template class LocalSteps<2>;
template class LocalSteps<3>;

} // namespace cnem
