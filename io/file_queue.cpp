#include "io/file_queue.hpp"

#include <algorithm>

namespace cnem::io {

FileQueue::~FileQueue() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void FileQueue::rethrow() const {
  if (failure_) std::rethrow_exception(failure_);
}

void FileQueue::put(std::filesystem::path path, std::string content) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || waiting_bytes_ <= most_waiting; });
  rethrow();
  // A list that is replaced before it was written need not be; the new one goes last, behind what it names.
  const auto old = std::find_if(waiting_.begin(), waiting_.end(),
                                [&](const FileContent& file) { return file.path == path; });
  if (old != waiting_.end()) {
    waiting_bytes_ -= old->content.size();
    waiting_.erase(old);
  }
  waiting_bytes_ += content.size();
  waiting_.push_back({std::move(path), std::move(content)});
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  changed_.notify_all();
}

void FileQueue::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || (waiting_.empty() && !writing_); });
  rethrow();
}

void FileQueue::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    std::vector<FileContent> batch;
    batch.swap(waiting_);
    waiting_bytes_ = 0;
    writing_ = true;
    lock.unlock();
    std::exception_ptr failure;
    try {
      write_atomically(batch);
    } catch (...) { failure = std::current_exception(); }
    lock.lock();
    writing_ = false;
    failure_ = failure;
    changed_.notify_all();
    if (failure_) return;
  }
}

} // namespace cnem::io
