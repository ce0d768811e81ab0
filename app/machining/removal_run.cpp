#include "app/machining/removal_run.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace cnem::app {

namespace {

using results::si_format;

/// Where the force acts, [3 × unknowns]. Throws InputError with its key where there is no material.
SparseMatrix rows_of_force(const input::Case& input, const machining::Part& part, double time) {
  const input::RemovalCase& removal = *input.structure->removal;
  const input::RemovalCase::Force& force = *removal.force;
  const Vec3 at = force.follows ? Vec3(force.at + removal.shift(time)) : force.at;
  try {
    return part.displacement_at(std::array{at});
  } catch (const InputError& error) { throw input.error("removal.force.at", error.what()); }
}

std::vector<std::string> columns_of(const input::PartCase& part, bool reference) {
  std::vector<std::string> columns{"time[s]", "tool[m]"};
  for (const input::PartPlace& place : part.places) {
    for (const char* axis : {"x", "y", "z"}) columns.push_back(fmt::format("{}.u{}[m]", place.name, axis));
    if (reference) columns.push_back(place.name + ".deviation[m]");
  }
  for (const char* energy : {"work", "kinetic", "elastic", "damping", "chips", "imbalance"})
    columns.push_back(fmt::format("energy.{}[J]", energy));
  columns.emplace_back("iterations");
  return columns;
}

} // namespace

RemovalRun::RemovalRun(const input::Case& input, const RunOptions& options, RunObserver& observer,
                       bool goes_on)
    : SteppedRun(input, options, observer, goes_on,
                 columns_of(*input.structure->part, input.structure->removal->reference)),
      case_(*input.structure->part), removal_(*input.structure->removal), part_(part_of(input)),
      standing_(Eigen::VectorXd::Zero(part_.unknowns())),
      state_(machining::RemovalState::at_rest(part_.unknowns())), reference_(state_),
      largest_(case_.places.size(), 0.0), deviation_(largest_), reference_largest_(largest_) {
  for (const input::PartPlace& place : case_.places) {
    place_.push_back(displacement_at(input, part_, place));
    standing_ += place_.back().transpose() * place.force;
  }
  if (removal_.force)
    for (const double time : {0.0, removal_.duration}) rows_of_force(input, part_, time);
  status_.nodes = as<std::int64_t>(part_.nodes());
  observer_.begins();
}

std::vector<double> RemovalRun::presence(double time) const {
  return machining::presence_without(part_, removal_.taken_low(time), removal_.taken_high(time),
                                     removal_.most);
}

Eigen::VectorXd RemovalRun::load(double time) const {
  if (!removal_.force) return standing_;
  const Vec3 force =
      std::cos(machining::full_turn * removal_.force->frequency * time) * removal_.force->amplitude;
  return standing_ + rows_of_force(input_, part_, time).transpose() * force;
}

machining::Eigenmodes RemovalRun::modes_at(double time) const {
  const std::vector<double> there = presence(time);
  return machining::lowest_modes(part_.stiffness(there), part_.mass(there), case_.count);
}

void RemovalRun::advance() {
  const auto presence_at = [&](double time) { return presence(time); };
  const auto load_at = [&](double time, const Eigen::VectorXd&) { return load(time); };
  machining::RemovalSettings until = removal_.settings;
  until.steps = std::min(state_.step + until.interval, until.steps);
  std::vector<Vec3> exact; // [step of the interval × point]
  if (removal_.reference) {
    machining::RemovalSettings settings = until;
    settings.inverse = machining::EffectiveInverse::conjugate_gradients;
    machining::machine(part_, settings, reference_, presence_at, load_at,
                       [&](const machining::RemovalStep& step) {
                         for (const SparseMatrix& rows : place_) exact.emplace_back(rows * step.motion.q);
                       });
  }
  std::size_t at = 0;
  machining::machine(part_, until, state_, presence_at, load_at, [&](const machining::RemovalStep& step) {
    std::vector<double> row{step.time, removal_.way(step.time)};
    for (std::size_t p = 0; p < place_.size(); ++p) {
      const Vec3 u = place_[p] * step.motion.q;
      row.insert(row.end(), u.begin(), u.end());
      largest_[p] = std::max(largest_[p], u.norm());
      if (!removal_.reference) continue;
      row.push_back((u - exact[at]).norm());
      deviation_[p] = std::max(deviation_[p], row.back());
      reference_largest_[p] = std::max(reference_largest_[p], exact[at++].norm());
    }
    const machining::EnergyLedger& energy = step.energy;
    row.insert(row.end(), {energy.work, energy.kinetic, energy.elastic, energy.damping, energy.chips,
                           energy.imbalance(), static_cast<double>(step.iterations)});
    iterations_ += step.iterations;
    most_iterations_ = std::max<std::int64_t>(most_iterations_, step.iterations);
    history_.write(row);
    ++status_.steps;
  });
}

void RemovalRun::judge() {
  std::array<double, 2> first{};
  for (const auto& [k, name, time] : {std::tuple{0U, "begin", 0.0}, {1U, "end", status_.time}}) {
    const machining::Eigenmodes modes = modes_at(time);
    for (Eigen::Index i = 0; i < modes.count(); ++i)
      status_.add_metric(fmt::format("removal.{}.f{}[Hz]", name, i + 1), modes.frequency(i));
    first[k] = modes.frequency(0);
  }
  std::string farthest;
  for (std::size_t p = 0; p < place_.size(); ++p) {
    const std::string name = "removal." + case_.places[p].name;
    status_.add_metric(name + ".displacement[m]", largest_[p]);
    if (!removal_.reference || !(reference_largest_[p] > 0.0)) continue;
    const double deviation = deviation_[p] / reference_largest_[p];
    status_.add_metric(name + ".deviation", deviation);
    farthest += fmt::format("; {} is off by up to {}% of its largest displacement", case_.places[p].name,
                            results::number_format(100.0 * deviation, 3));
  }
  const machining::EnergyLedger& energy = state_.energy;
  for (const auto& [name, value] : {std::pair{"work", energy.work},
                                    {"kinetic", energy.kinetic},
                                    {"elastic", energy.elastic},
                                    {"damping", energy.damping},
                                    {"chips", energy.chips},
                                    {"imbalance", energy.imbalance()}})
    status_.add_metric(fmt::format("removal.energy.{}[J]", name), value);
  if (iterations_ > 0) {
    status_.add_metric("removal.iterations",
                       static_cast<double>(iterations_) / static_cast<double>(removal_.settings.steps));
    status_.add_metric("removal.most_iterations", static_cast<double>(most_iterations_));
  }
  status_.reason = fmt::format("the first frequency goes from {} to {}{}", si_format(first[0], "Hz"),
                               si_format(first[1], "Hz"), farthest);
}

void RemovalRun::archive(Archive& archive) {
  state_.archive(archive, "removal/");
  if (removal_.reference) reference_.archive(archive, "removal/reference/");
  for (const auto& [name, list] : {std::pair{"largest", &largest_},
                                   {"deviation", &deviation_},
                                   {"reference_largest", &reference_largest_}}) {
    archive.list(fmt::format("removal/{}", name), "m", *list);
    if (list->size() != place_.size())
      throw IoError(fmt::format("removal/{} is not of this case's points", name));
  }
  archive.integer("removal/iterations", iterations_);
  archive.integer("removal/most_iterations", most_iterations_);
}

void describe_removal(const input::Case& input, const machining::Part& part, Checked& checked) {
  const input::RemovalCase& removal = *input.structure->removal;
  const machining::RemovalSettings& settings = removal.settings;
  if (removal.force)
    for (const double time : {0.0, removal.duration}) rows_of_force(input, part, time);
  checked.facts.emplace_back("tool", fmt::format("goes {} in {}, D up to {:g}",
                                                 si_format(removal.way(removal.duration), "m"),
                                                 si_format(removal.duration, "s"), removal.most));
  checked.facts.emplace_back("steps", fmt::format("{} of {}, a factor every {}", settings.steps,
                                                  si_format(settings.dt, "s"),
                                                  std::min(settings.interval, settings.steps)));
  checked.numbers.emplace_back("steps", static_cast<double>(settings.steps));
}

std::vector<std::string> removal_doubts(const input::Case& input) {
  const input::RemovalCase& removal = *input.structure->removal;
  constexpr double few = 20.0;
  std::vector<std::string> doubts;
  const double dt = removal.settings.dt;
  const double omega = SolvedPart(input).modes.omega[0];
  const auto doubt = [&](const char* what, double period) {
    if (period < few * dt)
      doubts.push_back(input
                           .error("removal.step", fmt::format("{} lasts {:.3g} steps, expected at least {:g}",
                                                              what, period / dt, few))
                           .what());
  };
  doubt("a period of the part's first mode", machining::full_turn / omega);
  if (removal.force && removal.force->frequency > 0.0)
    doubt("a period of the force", 1.0 / removal.force->frequency);
  return doubts;
}

} // namespace cnem::app
