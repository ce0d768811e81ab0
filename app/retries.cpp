#include "app/retries.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::app {

void Retries::look(double time) {
  if (in_a_row_ == 0 || time - failed_ <= failed_ - last_pass_at_) return;
  in_a_row_ = 0;
  last_pass_.clear(); // going back there again would lead the same way
}

double Retries::strain_share() const { return std::ldexp(1.0, -in_a_row_); }

void Retries::take(double time, const Course& course) {
  // On the way past a failure the state before it stays: passes that come sooner lead up to the same place.
  if (!renewable_ || (in_a_row_ > 0 && !last_pass_.empty())) return;
  taken_.clear();
  course(taken_);
  taken_at_ = time;
}

void Retries::keep() {
  if (taken_.empty()) return;
  last_pass_.swap(taken_);
  last_pass_at_ = taken_at_;
  failed_ = last_pass_at_;
  taken_.clear();
}

bool Retries::may_go_back(const DivergenceError& error) const {
  return !last_pass_.empty() && in_a_row_ < most && error.field != "tool velocity" &&
         error.field != "tool spring";
}

void Retries::go_back(double time, const std::string& failure, const Course& course) {
  taken_.clear();
  failed_ = std::max(failed_, time);
  ++in_a_row_;
  if (count_++ == 0) first_ = failure;
  last_pass_.recall();
  course(last_pass_);
}

std::string Retries::warning() const {
  if (count_ == 0) return "";
  return fmt::format(
      "the run went back to its last pass {} and renewed the reference sooner, first because {}",
      count_ == 1 ? "once" : fmt::format("{} times", count_), first_);
}

void Retries::archive(Archive& archive) {
  archive.integer("run/retries/count", count_);
  archive.integer("run/retries/in_a_row", in_a_row_);
  archive.number("run/retries/failed", "s", failed_);
  archive.number("run/retries/last_pass_at", "s", last_pass_at_);
  archive.text("run/retries/first", first_);
  last_pass_.archive(archive, "last_pass");
}

} // namespace cnem::app
