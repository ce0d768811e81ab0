#include "app/command_line.hpp"
#include "app/process/exhaustion.hpp"
#include "app/process/standard_streams.hpp"

#include <csignal>
#include <cstdlib>
#include <unistd.h>

namespace {

// libgomp reads its environment when it is loaded, before any of our code. By default its threads spin for
// milliseconds at every barrier: on a busy machine the one that spins keeps the core from the one it waits
// for, and a run takes ten to thirty times as long. So the program starts itself once more with a short spin;
// a user's own choice stands.
void limit_spinning(char** argv) {
  if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
  if (setenv("GOMP_SPINCOUNT", "1000", 0) == 0) execv("/proc/self/exe", argv); // goes on here if it cannot
}

} // namespace

int main(int argc, char** argv) {
  limit_spinning(argv);
  std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is an error of writing, with its exit code
  std::signal(SIGPIPE, SIG_IGN); // nor does a reader of what is printed end a run by going away
  cnem::app::prepare_for_exhaustion();
  const cnem::app::StandardStreams streams;
  return cnem::app::in_order(streams.finish(cnem::app::command_line(argc, argv)));
}
