#include "app/process/exhaustion.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/output_folder.hpp"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <mutex>
#include <omp.h>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

namespace cnem::app {

namespace {

// Large enough for malloc to give it back to the system at once, and for a picture.
constexpr std::size_t reserve_size = std::size_t{8} << 20;
std::atomic<void*> reserve{nullptr};
std::atomic<bool> prepared{false}, reserve_taken{false}, ended_in_order{false};
std::terminate_handler terminate_before = nullptr;

struct LastWords {
  std::string message, status, path, temporary;
};
LastWords last_words;
std::mutex words_mutex;

void free_reserve() { ::operator delete(reserve.exchange(nullptr)); }

/// Called when memory cannot be had: what frees some is tried once more.
void use_reserve() {
  void* const kept = reserve.exchange(nullptr);
  if (!kept) throw std::bad_alloc();
  reserve_taken = true;
  ::operator delete(kept);
}

void write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = write(fd, text.data(), text.size());
    if (n <= 0) return;
    text.remove_prefix(index_of(n));
  }
}

/// Without any memory.
[[noreturn]] void end_with_last_words() {
  const std::unique_lock lock(words_mutex, std::try_to_lock);
  if (!lock) _exit(Exit::io_failed);
  write_all(STDERR_FILENO,
            last_words.message.empty() ? "memory or threads are exhausted\n" : last_words.message);
  if (last_words.path.empty()) _exit(Exit::io_failed);
  const int fd = open(last_words.temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd >= 0) {
    write_all(fd, last_words.status);
    if (fsync(fd) == 0) rename(last_words.temporary.c_str(), last_words.path.c_str());
  }
  _exit(Exit::io_failed);
}

[[noreturn]] void on_terminate() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) { end_with_last_words(); } catch (const std::system_error&) {
    end_with_last_words();
  } catch (...) {}
  if (terminate_before) terminate_before();
  std::abort();
}

/// Libraries in C go on with a null pointer, or abort, where malloc gives them nothing. Any other fault ends
/// the process as it would without this.
extern "C" void on_fault(int signal) {
  constexpr std::size_t some = std::size_t{16} << 20;
  void* const block = mmap(nullptr, some, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (block == MAP_FAILED) end_with_last_words();
  munmap(block, some);
  raise(signal); // whose handling is the system's again
}

void end_faults_of_exhaustion_with_last_words() {
#ifndef __SANITIZE_ADDRESS__ // which has handlers of its own
  struct sigaction action {};
  action.sa_handler = on_fault;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT}) sigaction(signal, &action, nullptr);
#endif
}

void on_exit() {
  if (!ended_in_order) end_with_last_words();
}

std::string how_to_go_on(const input::Case& input, const RunOptions& options) {
  if (options.output.empty() || input.analysis.type != input::Analysis::Type::explicit_dynamics) return "";
  const auto checkpoints = results::list_checkpoints(options.output);
  return fmt::format("once this is mended, `cnem restart {}` {}", options.output.string(),
                     checkpoints.empty() ? "begins at step 0"
                                         : "goes on from " + checkpoints.front().string());
}

results::RunStatus status_before_steps(const input::Case& input, const RunOptions& options) {
  results::RunStatus status;
  status.version = options.version;
  status.case_name = input.name;
  status.threads = omp_get_max_threads();
  status.peak_rss_bytes = results::peak_rss_bytes();
  return status;
}

} // namespace

void prepare_for_exhaustion() {
  prepared = true;
  reserve = ::operator new(reserve_size, std::nothrow);
  std::set_new_handler(use_reserve);
  terminate_before = std::set_terminate(on_terminate);
  std::atexit(on_exit);
  end_faults_of_exhaustion_with_last_words();
}

int in_order(int code) {
  ended_in_order = true;
  return code;
}

void check_reserve() {
  if (reserve_taken) throw std::bad_alloc();
}

std::string memory_exhausted() {
  free_reserve();
  return fmt::format("memory is exhausted; the most that was held is {:.0f} MB",
                     static_cast<double>(results::peak_rss_bytes()) / 1e6);
}

void set_last_words(const std::filesystem::path& folder, results::RunStatus status,
                    const std::string& how_to_go_on) {
  if (!prepared) return; // a run within another program, which has its own way to end
  status.exit = Exit::io_failed;
  status.reason = "memory or threads are exhausted";
  LastWords words;
  words.message = fmt::format("{}\n{}{}", status.reason, how_to_go_on, how_to_go_on.empty() ? "" : "\n");
  words.status = results::status_json(status);
  words.path = (folder / results::files::status).string();
  words.temporary = (folder / fmt::format(".{}.{}.tmp", results::files::status, getpid())).string();
  const std::lock_guard lock(words_mutex);
  last_words = std::move(words);
}

void forget_last_words() {
  const std::lock_guard lock(words_mutex);
  last_words = {};
}

void set_last_words_before_steps(const input::Case& input, const RunOptions& options) {
  if (!prepared) return;
  set_last_words(options.output, status_before_steps(input, options), how_to_go_on(input, options));
}

void fail_before_steps(const input::Case& input, const RunOptions& options, const std::string& reason) {
  forget_last_words();
  results::RunStatus status = status_before_steps(input, options);
  status.exit = Exit::io_failed;
  status.reason = reason;
  try {
    if (!options.output.empty()) results::write_status(options.output, status);
  } catch (const std::exception&) {} // there may be no room for this either
  const std::string how = how_to_go_on(input, options);
  throw ToldIoError(how.empty() ? reason : fmt::format("{}\n{}", reason, how));
}

} // namespace cnem::app
