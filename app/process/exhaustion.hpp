#pragma once
// What a run does when memory or threads run out: it says so, and its last checkpoint stays.
#include "app/run.hpp"
#include "core/error.hpp"
#include "input/case.hpp"
#include "results/status.hpp"

#include <filesystem>
#include <new>
#include <string>
#include <system_error>

namespace cnem::app {

/// For a whole process: puts memory aside, so that what is under way when memory ends can be finished. Where
/// an exception cannot pass (destructors and threads of libraries; OpenMP, which calls exit(); libraries in C
/// that go on with a null pointer) the process ends with io_failed and its last words.
void prepare_for_exhaustion();

/// Returns the exit code that main() ends with: what comes after is no early end.
int in_order(int code);

/// Throws std::bad_alloc when the memory that was put aside has been taken: for moments at which a run can
/// stop.
void check_reserve();

/// Frees the memory that was put aside; returns what a message says.
std::string memory_exhausted();

/// What a prepared process leaves behind when it ends where nothing can be made any more: the reason as its
/// message, and the status in the folder. They hold until the next ones, or until they are forgotten.
void set_last_words(const std::filesystem::path& folder, results::RunStatus status,
                    const std::string& how_to_go_on);
void forget_last_words();

/// The same for a run that has not come to its first step.
void set_last_words_before_steps(const input::Case& input, const RunOptions& options);

/// A failure that the status tells already.
struct ToldIoError : IoError {
  using IoError::IoError;
};

/// Writes the status of such a run, where it has a folder and as far as that is possible, and throws
/// ToldIoError with the reason.
[[noreturn]] void fail_before_steps(const input::Case& input, const RunOptions& options,
                                    const std::string& reason);

/// act(), which comes before the first step. Memory, threads or files that fail in it end with a status.
template<class Act> auto before_steps(const input::Case& input, const RunOptions& options, Act&& act) {
  set_last_words_before_steps(input, options);
  try {
    return act();
  } catch (const std::bad_alloc&) {
    fail_before_steps(input, options, memory_exhausted());
  } catch (const std::system_error& error) {
    fail_before_steps(input, options, error.what());
  } catch (const ToldIoError&) { throw; } catch (const IoError& error) {
    fail_before_steps(input, options, error.what());
  }
}

} // namespace cnem::app
