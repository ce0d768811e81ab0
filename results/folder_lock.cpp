#include "results/folder_lock.hpp"

#include "core/error.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace cnem::results {

FolderLock::FolderLock(std::filesystem::path folder, const char* who, Use use) : folder_(std::move(folder)) {
  while (true) {
    std::error_code ignored;
    made_ = std::filesystem::create_directories(folder_, ignored);
    fd_ = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd_ < 0) return;
    const bool locked = flock(fd_, (use == Use::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0;
    if (!locked && errno == EWOULDBLOCK) {
      close(fd_);
      throw InputError(fmt::format(
          "another {} is using the folder {}: wait for it, or choose another folder with --output", who,
          folder_.string()));
    }
    // Whoever held it may have removed it between opening and locking.
    if (!locked || is_folder_there()) return;
    close(fd_);
  }
}

FolderLock::~FolderLock() {
  std::error_code ignored;
  if (made_) std::filesystem::remove(folder_, ignored); // only when empty
  if (fd_ >= 0) close(fd_);
}

bool FolderLock::is_folder_there() const {
  struct stat own {
  }, there{};
  return fstat(fd_, &own) == 0 && stat(folder_.c_str(), &there) == 0 && own.st_dev == there.st_dev &&
         own.st_ino == there.st_ino;
}

} // namespace cnem::results
