#pragma once
// A run that diverges goes back to its last pass and renews the reference sooner, before it is given up.
#include "core/error.hpp"
#include "core/fields/memory_archive.hpp"

#include <functional>
#include <string>

namespace cnem::app {

/// Remembers the state before the last new reference, and how often the run has gone back to it. Each time
/// halves the strain at which references are renewed, `most` times at most. Once the run is as far beyond the
/// failure as the state lies before it, the strain of the case returns, and the state there is the next one
/// to go back to.
class Retries {
public:
  static constexpr int most = 3; ///< in a row

  /// Carries what evolves in the run.
  using Course = std::function<void(Archive&)>;

  /// renewable: references are renewed by strain; without, nothing is remembered and every failure is final.
  explicit Retries(bool renewable) : renewable_(renewable) {}

  /// Before each step: looks whether the last failure lies behind at `time`, s. Then it lacks a state.
  void look(double time);
  /// Of the strain of the case at which references are renewed: 1; after going back 1/2, 1/4, 1/8.
  double strain_share() const;

  /// Takes the state at `time` (s) before a new reference, or where there is none yet.
  void take(double time, const Course& course);
  bool lacks_state() const { return renewable_ && last_pass_.empty(); }
  /// What was taken is where the run goes back to from now on: the reference made of it is good.
  void keep();

  /// Whether going back may help. Not where a tool is too fast: the metal has no part in that.
  bool may_go_back(const DivergenceError& error) const;
  /// Counts a failure at `time` (s) and hands the remembered state to `course`. Throws IoError.
  void go_back(double time, const std::string& failure, const Course& course);

  int count() const { return count_; } ///< over the whole run
  /// What to tell about it; empty when the run never went back.
  std::string warning() const;
  void archive(Archive& archive);

private:
  bool renewable_;
  MemoryArchive taken_, last_pass_;
  double taken_at_ = 0.0, last_pass_at_ = 0.0; ///< s
  double failed_ = 0.0;                        ///< s, the latest failure since `last_pass_at_`
  int in_a_row_ = 0;
  int count_ = 0;
  std::string first_; ///< failure, with its place and time
};

} // namespace cnem::app
