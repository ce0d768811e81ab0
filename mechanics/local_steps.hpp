#pragma once
// Local time steps: which stress points and nodes are due in each sub-step (docs/theory.md, "Local time
// steps").
#include "core/fields/archive.hpp"
#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "core/operators/discretisation.hpp"
#include "core/operators/resampling.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cnem {

/// What a run asks of local time steps.
struct LocalStepControl {
  bool on = false;
  int levels = 5;          ///< at most so many: the coarsest step is up to 2^(levels − 1) finest ones
  double least_gain = 1.5; ///< where they would save less, all points take the finest step
};

/// Consecutive nodes (and their stress points) that are treated alike.
struct LevelRange {
  std::size_t begin, end;
  int level;
  bool marked; ///< what it means is said where ranges are handed out
};

/// Levels of stress points, in blocks of `block` so that kernels work on ranges; nodes come in blocks of the
/// same size. A point of level l steps by 2^l finest steps. All points that share a node, and so all stencils
/// that overlap, are within one level of each other. A node moves at the rate of its finest point: when a
/// point is due, all nodes of its stencil are at the present time.
///
/// A macro step is 2^L finest steps, L the highest level. In it the *activity* of the state after sub-step s
/// is the number of times 2 divides s, L at its end; points of level ≤ activity are due.
template<int dim> class LocalSteps {
public:
  static constexpr std::size_t block = 16; ///< whole vectors of every instruction set
  using Levels = std::vector<std::int8_t>; ///< [block of points]

  explicit LocalSteps(LocalStepControl control = {}) : control_(control) {}

  bool on() const { return control_.on; }

  /// Levels for steps that are stable for each block [block], s. Levels in use are kept as long as they cost
  /// at most 5% more updates than new ones, or than when they were chosen.
  Levels choose(const DiscreteOperators<dim>& operators, const StabilisationLinks<dim>& links,
                const Field& stable);
  /// The finest step with which no block exceeds its stable one, s, and the block that limits it.
  static std::pair<double, std::size_t> finest_step(const Levels& level, const Field& stable);
  /// The nodes are others: blocks take the finest level that their nodes, or the first
  /// of those an inserted one lies between, had.
  void follow(const NodeRows& labels);
  /// The operators are new: the next choice compares levels in use with new ones.
  void look_again() { chosen_cost_ = 0.0; }

  /// Lowers levels until neighbours are within one of each other.
  static void grade(const DiscreteOperators<dim>& operators, const StabilisationLinks<dim>& links,
                    Levels& level);

  /// Sets the levels for these operators. `finest` [node]: nodes that move in every finest step, because
  /// something outside the cells acts on them there.
  void set_levels(Levels level, const DiscreteOperators<dim>& operators, const StabilisationLinks<dim>& links,
                  const std::vector<bool>& finest);

  /// One level: all points and all nodes in every step.
  void set_one_level(const DiscreteOperators<dim>& operators);

  /// Carries the levels out or in; `set_levels` must follow.
  void archive(Archive& archive);

  const Levels& level() const { return level_; }
  int level_of_point(std::size_t p) const { return highest_ == 0 ? 0 : int{level_[p / block]}; }
  int highest() const { return highest_; }
  int sub_steps() const { return 1 << highest_; }
  /// After sub-step s = 1 … 2^L of a macro step.
  int activity(int s) const;
  /// Updates of nodes, by their finest point, in a macro step.
  double updates() const { return updates_; }

  // What is due at an activity.
  /// Stress points; marked: some are linked to coarser neighbours.
  const std::vector<LevelRange>& points(int activity) const { return due_[at(activity)].points; }
  /// Nodes that receive impulses, at the level of their finest point; marked: with nodal operators, their own
  /// points are due too.
  const std::vector<LevelRange>& kicked(int activity) const { return due_[at(activity)].kicked; }
  /// Nodes that move, at the level of their motion; marked: they are kicked before.
  const std::vector<LevelRange>& moved(int activity) const { return due_[at(activity)].moved; }
  /// Points due at this activity but not in the next sub-step, that finer nodes gather from in the meantime.
  const std::vector<LevelRange>& silenced(int activity) const { return due_[at(activity)].silenced; }

  /// Of all links those of each node to neighbours that are not coarser, due with the node.
  const StabilisationLinks<dim>& own_links(const StabilisationLinks<dim>& all) const {
    return highest_ == 0 ? all : own_;
  }
  /// Links to coarser neighbours, due with those; weighted by the ratio of steps, since what acts on a node
  /// is multiplied with its own step.
  const StabilisationLinks<dim>& coarse_links() const { return coarse_; }

  std::size_t node_blocks() const { return kick_.size(); }
  /// 2^level of the impulses of node i.
  double weight(std::size_t node) const {
    return highest_ == 0 ? 1.0 : static_cast<double>(1 << kick_[node / block]);
  }
  /// Over how many finest steps the forces reach a node at an activity, as a mean over its points.
  double window(const DiscreteOperators<dim>& operators, NodeIndex node, int activity) const;

private:
  struct Due {
    std::vector<LevelRange> points, kicked, moved, silenced;
  };
  static std::size_t at(int i) { return index_of(i); }
  void split(const StabilisationLinks<dim>& links);
  void list(const DiscreteOperators<dim>& operators, const std::vector<bool>& silent);

  LocalStepControl control_;
  Levels level_; ///< of points
  Levels kick_;  ///< [block of nodes] of the finest point that acts on one of them
  Levels move_;  ///< [block of nodes]
  int highest_ = 0;
  double updates_ = 0.0;
  double chosen_cost_ = 0.0; ///< 1/s, updates over time when levels were compared last
  StabilisationLinks<dim> own_, coarse_;
  std::vector<bool> has_coarse_; ///< [block of points]
  std::vector<Due> due_;         ///< [activity]
};

extern template class LocalSteps<2>;
extern template class LocalSteps<3>;

/// Fills the part of a field of records of `stride` numbers that belongs to a range.
inline void fill_records(Field& field, std::size_t stride, const LevelRange& range, double value) {
  std::fill(field.begin() + static_cast<std::ptrdiff_t>(stride * range.begin),
            field.begin() + static_cast<std::ptrdiff_t>(stride * range.end), value);
}

/// body(range) for all ranges, shared out to the threads. body must write only to its range.
template<class Body> void for_each_range(const std::vector<LevelRange>& ranges, Body&& body) {
  for_each_part(static_cast<std::ptrdiff_t>(ranges.size()),
                [&](std::ptrdiff_t r) { body(ranges[index_of(r)]); });
}

/// Sum of body(range), added up in the order of the ranges.
template<class Body> double sum_ranges(const std::vector<LevelRange>& ranges, Body&& body) {
  std::vector<double> partial(ranges.size());
  for_each_range(ranges,
                 [&](const LevelRange& range) { partial[index_of(&range - ranges.data())] = body(range); });
  double sum = 0.0;
  for (const double value : partial) sum += value;
  return sum;
}

} // namespace cnem
