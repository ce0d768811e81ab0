#include "app/process_pool.hpp"

#include "core/error.hpp"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <map>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace cnem::app {

namespace {

[[noreturn]] void fail(const std::string& action) {
  throw IoError(
      fmt::format("cannot {}: {}", action, std::error_code(errno, std::generic_category()).message()));
}

/// Signals that wait until they are asked for, so that none is lost between two looks.
class HeldSignals {
public:
  HeldSignals() {
    sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM, SIGCHLD}) sigaddset(&held_, signal);
    pthread_sigmask(SIG_BLOCK, &held_, &before_);
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL; // ignored, the ends of children could not be waited for
    sigaction(SIGCHLD, &usual, &child_before_);
  }
  ~HeldSignals() {
    sigaction(SIGCHLD, &child_before_, nullptr);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  int wait() const {
    int signal = 0;
    do signal = sigwaitinfo(&held_, nullptr);
    while (signal < 0 && errno == EINTR);
    return signal;
  }
  const sigset_t& before() const { return before_; }

private:
  sigset_t held_{}, before_{};
  struct sigaction child_before_ {};
};

class Children {
public:
  Children() = default;
  ~Children() {
    for (const auto& [pid, job] : job_of_) kill(pid, SIGTERM);
    for (const auto& [pid, job] : job_of_) reap(pid, 0);
  }
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  void start(const Job& job, std::size_t index, const sigset_t& mask) {
    // Everything that allocates comes before the fork.
    std::vector<char*> arguments;
    for (const std::string& word : job.command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const int log = open(job.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (log < 0) fail("write " + job.log.string());
    const pid_t parent = getpid();
    const pid_t pid = fork();
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (getppid() != parent) _exit(127);
      const int nothing = open("/dev/null", O_RDONLY);
      dup2(nothing, STDIN_FILENO);
      dup2(log, STDOUT_FILENO);
      dup2(log, STDERR_FILENO);
      sigprocmask(SIG_SETMASK, &mask, nullptr);
      execv(arguments.front(), arguments.data());
      _exit(127);
    }
    const int error = errno;
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
  std::map<pid_t, std::size_t> job_of_;
};

} // namespace

bool run_jobs(const std::vector<Job>& jobs, std::size_t processes,
              const std::function<void(std::size_t)>& begin,
              const std::function<void(std::size_t, JobEnd)>& end) {
  const HeldSignals signals;
  Children children;
  for (std::size_t next = 0; next < jobs.size() || children.running() > 0;) {
    while (next < jobs.size() && children.running() < processes) {
      begin(next);
      children.start(jobs[next], next, signals.before());
      ++next;
    }
    if (signals.wait() != SIGCHLD) return false;
    for (const auto& [job, how] : children.ended()) end(job, how);
  }
  return true;
}

} // namespace cnem::app
