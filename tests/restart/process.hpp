#pragma once
// The program as a child process that can be stopped, killed and denied disk space.
#include <functional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace cnem::app {

struct Ending {
  int code = -1;       ///< exit code; −1 when a signal killed it
  int signal = 0;      ///< that killed it
  std::string printed; ///< standard output and error
};

class Process {
public:
  /// Starts cnem with these arguments. file_limit: largest file it may write, bytes; 0: any. Environment
  /// variables as "NAME=value". `prepare` is called in the child before the program.
  explicit Process(std::vector<std::string> arguments, std::size_t file_limit = 0,
                   std::vector<std::string> environment = {}, const std::function<void()>& prepare = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t id() const { return pid_; }
  bool running();
  void send(int signal) const;
  Ending wait();

private:
  pid_t pid_;
  int log_;
  bool ended_ = false;
  int status_ = 0;
};

inline Ending run_cnem(std::vector<std::string> arguments, std::size_t file_limit = 0,
                       std::vector<std::string> environment = {}, const std::function<void()>& prepare = {}) {
  return Process(std::move(arguments), file_limit, std::move(environment), prepare).wait();
}

} // namespace cnem::app
