#include "app/process/console.hpp"

#include <cstdio>
#include <fmt/format.h>

namespace cnem::app {

void Console::outcome(const std::string& text) { fmt::print("{}{}", text, text.ends_with('\n') ? "" : "\n"); }

void Console::failure(const std::string& text) { fmt::print(stderr, "{}\n", text); }

Request Console::request() {
  const bool checkpoint = RunSignals::take_checkpoint();
  if (const char* signal = RunSignals::stop()) return {Request::Kind::stop, signal};
  return {checkpoint ? Request::Kind::checkpoint : Request::Kind::go_on};
}

} // namespace cnem::app
