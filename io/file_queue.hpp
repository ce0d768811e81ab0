#pragma once
// Files written by a thread of their own, so that a run does not wait for its disk.
#include "io/output_folder.hpp"

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace cnem::io {

/// Writes whole files atomically and in order. After a failure nothing more is written, so that no list names
/// a file that is not there.
class FileQueue {
public:
  FileQueue() = default;
  /// Waits for what is under way; whoever must know of failures calls wait() before.
  ~FileQueue();
  FileQueue(const FileQueue&) = delete;
  FileQueue& operator=(const FileQueue&) = delete;

  /// Takes a file to be written, in place of one of the same path that waits; blocks while more than
  /// `most_waiting` bytes wait. Throws the IoError of an earlier file.
  void put(std::filesystem::path path, std::string content);

  /// Returns when every file is on the disk. Throws the IoError of one that is not.
  void wait();

  static constexpr std::size_t most_waiting = std::size_t{256} << 20;

private:
  void work();
  void rethrow() const;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<FileContent> waiting_;
  std::size_t waiting_bytes_ = 0;
  bool writing_ = false, closed_ = false;
  std::exception_ptr failure_;
  std::thread thread_; ///< begun with the first file
};

} // namespace cnem::io
