#pragma once
// Keeps a second process out of an output folder while one is at work there.
#include <filesystem>

namespace cnem::results {

class FolderLock {
public:
  /// shared: with others who say so too.
  enum class Use { alone, shared };
  /// Makes the folder when it is not there. `who` uses it already if the lock is taken: throws InputError
  /// then. A folder that cannot be made or locked is left to whoever writes there first.
  FolderLock(std::filesystem::path folder, const char* who, Use use = Use::alone);
  /// A folder that was made and has stayed empty goes again.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  bool is_folder_there() const;

  std::filesystem::path folder_;
  bool made_ = false;
  int fd_ = -1;
};

} // namespace cnem::results
