#include "study/process_pool.hpp"

#include "core/error.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <map>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace cnem::study {

namespace {

[[noreturn]] void fail(const std::string& action) {
  throw IoError(
      fmt::format("cannot {}: {}", action, std::error_code(errno, std::generic_category()).message()));
}

int wake_pipe = -1; // end that the handler writes to

extern "C" void wake(int signal) {
  const int error = errno;
  const auto byte = static_cast<unsigned char>(signal);
  [[maybe_unused]] const ssize_t written = write(wake_pipe, &byte, 1); // a full pipe wakes as well
  errno = error;
}

/// Signals as bytes of a pipe, whichever thread they are delivered to.
class SignalPipe {
public:
  SignalPipe() {
    if (pipe2(end_.data(), O_CLOEXEC) != 0) fail("make a pipe");
    fcntl(end_[1], F_SETFL, O_NONBLOCK);
    wake_pipe = end_[1];
    struct sigaction action {};
    action.sa_handler = wake;
    action.sa_flags = SA_RESTART;
    for (std::size_t k = 0; k < signals.size(); ++k) {
      sigaction(signals[k], nullptr, &before_[k]);
      if (signals[k] != SIGHUP || before_[k].sa_handler != SIG_IGN) // as under nohup
        sigaction(signals[k], &action, nullptr);
    }
  }
  ~SignalPipe() {
    restore();
    for (const int fd : end_) close(fd);
  }
  SignalPipe(const SignalPipe&) = delete;
  SignalPipe& operator=(const SignalPipe&) = delete;

  int wait() const {
    unsigned char signal = 0;
    while (read(end_[0], &signal, 1) != 1)
      if (errno != EINTR) fail("wait for processes");
    return signal;
  }

  /// For a child, which must not wake its parent.
  void restore() const {
    for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &before_[k], nullptr);
  }

private:
  static constexpr std::array<int, 4> signals{SIGINT, SIGTERM, SIGHUP, SIGCHLD};
  std::array<int, 2> end_{-1, -1};
  std::array<struct sigaction, 4> before_{};
};

class Children {
public:
  explicit Children(const SignalPipe& signals) : signals_(signals) {}
  ~Children() {
    for (const auto& [pid, job] : job_of_) kill(pid, SIGTERM);
    for (const auto& [pid, job] : job_of_) reap(pid, 0);
  }
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  void start(const Job& job, std::size_t index) {
    // Everything that allocates comes before the fork.
    std::vector<char*> arguments;
    for (const std::string& word : job.command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const int log = open(job.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (log < 0) fail("write " + job.log.string());
    const pid_t parent = getpid();
    // A signal to the child must not be lost to the handler that it has until exec.
    sigset_t all, mask;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &mask);
    const pid_t pid = fork();
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (getppid() != parent) _exit(127);
      const int nothing = open("/dev/null", O_RDONLY);
      dup2(nothing, STDIN_FILENO);
      dup2(log, STDOUT_FILENO);
      dup2(log, STDERR_FILENO);
      signals_.restore();
      sigprocmask(SIG_SETMASK, &mask, nullptr);
      execv(arguments.front(), arguments.data());
      _exit(127);
    }
    const int error = errno;
    pthread_sigmask(SIG_SETMASK, &mask, nullptr);
    close(log);
    errno = error;
    if (pid < 0) fail("start a process");
    job_of_[pid] = index;
  }

  /// Those that have ended since the last call.
  std::vector<std::pair<std::size_t, JobEnd>> ended() {
    std::vector<std::pair<std::size_t, JobEnd>> list;
    for (auto child = job_of_.begin(); child != job_of_.end();) {
      int status = 0;
      const auto [pid, job] = *child++;
      if ((status = reap(pid, WNOHANG)) == still_running) continue;
      list.emplace_back(job,
                        WIFEXITED(status) ? JobEnd{WEXITSTATUS(status), 0} : JobEnd{-1, WTERMSIG(status)});
      job_of_.erase(pid);
    }
    return list;
  }
  std::size_t running() const { return job_of_.size(); }

private:
  static constexpr int still_running = -1;
  static int reap(pid_t pid, int options) {
    int status = 0;
    pid_t which = 0;
    do which = waitpid(pid, &status, options);
    while (which < 0 && errno == EINTR);
    return which == pid ? status : still_running;
  }
  const SignalPipe& signals_;
  std::map<pid_t, std::size_t> job_of_;
};

} // namespace

bool run_jobs(const std::vector<Job>& jobs, std::size_t processes,
              const std::function<void(std::size_t)>& begin,
              const std::function<void(std::size_t, JobEnd)>& end) {
  const SignalPipe signals;
  Children children(signals);
  for (std::size_t next = 0; next < jobs.size() || children.running() > 0;) {
    while (next < jobs.size() && children.running() < processes) {
      begin(next);
      children.start(jobs[next], next);
      ++next;
    }
    if (signals.wait() != SIGCHLD) return false;
    for (const auto& [job, how] : children.ended()) end(job, how);
  }
  return true;
}

} // namespace cnem::study
