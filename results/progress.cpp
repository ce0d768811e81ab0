#include "results/progress.hpp"
#include "core/index.hpp"

#include "results/si_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <unistd.h>

namespace cnem::results {
namespace {

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Columns a UTF-8 text takes: its bytes less the continuation bytes.
std::size_t columns(const std::string& text) {
  return index_of(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

constexpr double terminal_interval = 0.1, plain_interval = 10.0; // s

} // namespace

Progress::Progress() : Progress(std::cerr, isatty(STDERR_FILENO) == 1, wall_clock) {}

Progress::Progress(std::ostream& out, bool terminal, std::function<double()> clock)
    : out_(&out), terminal_(terminal), clock_(std::move(clock)), start_(clock_()), printed_at_(start_) {}

std::string Progress::line(const ProgressState& state, double now) const {
  const double fraction = state.end > 0.0 ? std::clamp(state.time / state.end, 0.0, 1.0) : 1.0;
  const double elapsed = now - start_, done = fraction - start_fraction_;
  std::string text = fmt::format("{:3.0f} %  t = {} of {}  step {}  dt {}", std::floor(100.0 * fraction),
                                 si_format(state.time, "s"), si_format(state.end, "s"), state.step,
                                 si_format(state.dt, "s", 3));
  if (state.nodes > 0) text += fmt::format("  {} nodes", state.nodes); // milling has none
  if (fraction < 1.0 && done > 0.0 && elapsed > 0.5)
    text += "  ETA " + duration_format(elapsed * (1.0 - fraction) / done);
  else if (fraction >= 1.0)
    text += "  in " + duration_format(elapsed);
  return text;
}

void Progress::update(const ProgressState& state) {
  const double now = clock_();
  const double fraction = state.end > 0.0 ? state.time / state.end : 1.0;
  const int tenth = static_cast<int>(std::floor(10.0 * fraction + 1e-9));
  const bool first = start_fraction_ < 0.0;
  if (first) { // a restarted run does not begin at zero
    start_fraction_ = fraction;
    start_ = now;
  }
  const bool due = first || fraction >= 1.0 ||
                   (terminal_ ? now - printed_at_ >= terminal_interval
                              : tenth > printed_tenth_ || now - printed_at_ >= plain_interval);
  if (!due) return;
  printed_at_ = now;
  printed_tenth_ = tenth;
  const std::string text = line(state, now);
  if (terminal_) {
    const std::size_t width = columns(text);
    *out_ << '\r' << text << std::string(width_ > width ? width_ - width : 0, ' ');
    width_ = width;
  } else {
    *out_ << text << '\n';
  }
  out_->flush();
}

void Progress::message(const std::string& text) {
  if (width_ > 0) *out_ << '\r' << std::string(width_, ' ') << '\r';
  width_ = 0;
  *out_ << text << '\n';
  out_->flush();
}

void Progress::finish() {
  if (width_ > 0) *out_ << '\n';
  width_ = 0;
  out_->flush();
}

} // namespace cnem::results
