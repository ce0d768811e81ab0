#include "tests/restart/process.hpp"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cnem::app {

Process::Process(std::vector<std::string> arguments, std::size_t file_limit,
                 std::vector<std::string> environment, const std::function<void()>& prepare)
    : log_(memfd_create("log", 0)) {
  std::string program = CNEM_PROGRAM;
  std::vector<char*> words{program.data()};
  for (std::string& word : arguments) words.push_back(word.data());
  words.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  dup2(log_, STDOUT_FILENO);
  dup2(log_, STDERR_FILENO);
  for (std::string& variable : environment) putenv(variable.data());
  if (file_limit > 0) {
    const rlimit limit{file_limit, file_limit};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (prepare) prepare();
  execv(words.front(), words.data());
  _exit(127);
}

Process::~Process() {
  if (running()) {
    send(SIGKILL);
    wait();
  }
  close(log_);
}

bool Process::running() {
  if (!ended_ && waitpid(pid_, &status_, WNOHANG) == pid_) ended_ = true;
  return !ended_;
}

void Process::send(int signal) const { kill(pid_, signal); }

Ending Process::wait() {
  if (!ended_) waitpid(pid_, &status_, 0);
  ended_ = true;
  Ending ending;
  if (WIFEXITED(status_)) ending.code = WEXITSTATUS(status_);
  if (WIFSIGNALED(status_)) ending.signal = WTERMSIG(status_);
  lseek(log_, 0, SEEK_SET);
  char buffer[4096];
  for (ssize_t n; (n = read(log_, buffer, sizeof buffer)) > 0;)
    ending.printed.append(buffer, static_cast<std::size_t>(n));
  return ending;
}

} // namespace cnem::app
