#pragma once
// Keeps a second process out of an output folder while one is at work there.
#include "core/error.hpp"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace cnem::app {

class FolderLock {
public:
  /// `who` is at work there if the lock is taken. Throws InputError then; a folder that cannot be locked is
  /// none the worse.
  FolderLock(const std::filesystem::path& folder, const char* who)
      : fd_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (fd_ >= 0 && flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(fd_);
      throw InputError(
          fmt::format("another {} is at work in {}: wait for it, or choose another folder with --output", who,
                      folder.string()));
    }
  }
  ~FolderLock() {
    if (fd_ >= 0) close(fd_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  int fd_;
};

} // namespace cnem::app
