#pragma once
// Files made and written in the background, so that a run waits neither for its pictures nor for its disk.
#include "results/output_folder.hpp"

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>

namespace cnem::results {

/// Makes the content of files and writes them whole, atomically and in order, on a thread of its own. After a
/// failure nothing more is written, so that no list names a file that is not there.
class FileQueue {
public:
  /// Returns the content of a file. Called once, on another thread: it owns what it reads, and starts no
  /// parallel region.
  using Maker = std::function<std::string()>;

  FileQueue() = default;
  /// Waits for what is under way; whoever must know of failures calls wait() before.
  ~FileQueue();
  FileQueue(const FileQueue&) = delete;
  FileQueue& operator=(const FileQueue&) = delete;

  /// Takes a file to be written, in place of one of the same path that waits; blocks while more than
  /// `most_waiting` bytes wait. Throws what stopped an earlier file: IoError, or what its maker
  /// threw; std::bad_alloc when memory is short. IoError, too, when there is no thread to be had.
  void put(std::filesystem::path path, std::string content);
  /// The same for a file yet to be made, whose maker holds about `bytes`.
  void put(std::filesystem::path path, Maker maker, std::size_t bytes);

  /// Returns when every file is on the disk, and helps to make those that wait. Throws what stopped one.
  void wait();

  /// Makes and writes nothing more, because memory is exhausted.
  void give_up();

  static constexpr std::size_t most_waiting = std::size_t{64} << 20;

private:
  enum class Stage { waiting, under_way, made };
  struct Job {
    FileContent file;
    Maker maker;
    std::size_t bytes = 0;
    Stage stage = Stage::waiting;
  };
  using Lock = std::unique_lock<std::mutex>;

  void put(Job job);
  void start();
  void work();
  bool make_one(Lock& lock);
  bool write_made(Lock& lock);
  void fail(std::exception_ptr failure);
  void rethrow() const;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Job> jobs_; ///< in the order in which they reach the disk
  std::size_t waiting_bytes_ = 0;
  bool closed_ = false;
  std::exception_ptr failure_;
  std::thread thread_; ///< begun with the first file
};

} // namespace cnem::results
