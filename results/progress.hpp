#pragma once
// How far a run is, for whoever watches: one line rewritten on a terminal, a few plain lines elsewhere.
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

namespace cnem::results {

struct ProgressState {
  double time = 0.0; ///< s
  double end = 0.0;  ///< s
  std::int64_t step = 0;
  double dt = 0.0; ///< s
  std::int64_t nodes = 0;
};

class Progress {
public:
  /// To standard error; a terminal gets the rewritten line.
  Progress();
  /// To `out`; `clock` gives wall time in s.
  Progress(std::ostream& out, bool terminal, std::function<double()> clock);

  /// Cheap enough for every step: prints at most ten times a second on a terminal, elsewhere at every tenth
  /// of the way or every 10 s.
  void update(const ProgressState& state);

  /// Prints a message on a line of its own, without spoiling the progress line.
  void message(const std::string& text);

  /// Ends the progress line.
  void finish();

private:
  std::string line(const ProgressState& state, double now) const;
  std::ostream* out_;
  bool terminal_;
  std::function<double()> clock_;
  double start_, start_fraction_ = -1.0, printed_at_;
  int printed_tenth_ = 0;
  std::size_t width_ = 0; ///< of the line on the terminal
};

} // namespace cnem::results
