#include "results/file_queue.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/machine/memory.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <new>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace cnem::results {

// A step on all cores waits for its slowest thread: where cores are scarce, files can wait instead.
constexpr int lower_priority = 10;

// What the makers of fields, pictures and their letters take beside a copy of the content: fonts, an image.
constexpr std::size_t work_copies = 4, work_memory = std::size_t{16} << 20;

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
  const std::size_t bytes = content.size();
  put(Job{{std::move(path), std::move(content)}, nullptr, bytes, Stage::made});
}

void FileQueue::put(std::filesystem::path path, Maker maker, std::size_t bytes) {
  put(Job{{std::move(path), {}}, std::move(maker), bytes, Stage::waiting});
}

void FileQueue::put(Job job) {
  Lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || waiting_bytes_ <= most_waiting; });
  rethrow();
  // A list that is replaced before it was written need not be; the new one goes last, behind what it names.
  const auto old = std::find_if(jobs_.begin(), jobs_.end(), [&](const Job& other) {
    return other.file.path == job.file.path && other.stage != Stage::under_way;
  });
  if (old != jobs_.end()) {
    waiting_bytes_ -= old->bytes;
    jobs_.erase(old);
  }
  waiting_bytes_ += job.bytes;
  jobs_.push_back(std::move(job));
  if (!thread_.joinable()) start();
  changed_.notify_all();
}

void FileQueue::start() {
  try {
    thread_ = std::thread([this] { work(); });
  } catch (const std::system_error& error) {
    jobs_.clear(); // nobody makes them
    throw IoError(fmt::format("cannot start a thread that writes files: {}", error.code().message()));
  }
}

void FileQueue::give_up() {
  const Lock lock(mutex_);
  fail(std::make_exception_ptr(std::bad_alloc()));
}

void FileQueue::wait() {
  Lock lock(mutex_);
  while (!failure_ && !jobs_.empty())
    if (!make_one(lock) && !write_made(lock)) changed_.wait(lock);
  rethrow();
}

void FileQueue::work() {
  [[maybe_unused]] const int priority = ::nice(lower_priority); // of this thread alone
  Lock lock(mutex_);
  try {
    while (!failure_) {
      if (make_one(lock) || write_made(lock)) continue;
      if (closed_ && jobs_.empty()) return;
      changed_.wait(lock);
    }
  } catch (...) { fail(std::current_exception()); } // memory that is exhausted between two files
}

void FileQueue::fail(std::exception_ptr failure) {
  failure_ = std::move(failure);
  changed_.notify_all();
}

/// Makes the first file that waits for it. Returns false when there is none.
bool FileQueue::make_one(Lock& lock) {
  const auto job = std::find_if(jobs_.begin(), jobs_.end(),
                                [](const Job& other) { return other.stage == Stage::waiting; });
  if (job == jobs_.end()) return false;
  job->stage = Stage::under_way;
  lock.unlock();
  std::exception_ptr failure;
  try {
    try_memory(work_copies * job->bytes + work_memory);
    job->file.content = job->maker();
  } catch (...) { failure = std::current_exception(); }
  job->maker = nullptr; // and what it holds
  lock.lock();
  waiting_bytes_ += job->file.content.size() - job->bytes;
  job->bytes = job->file.content.size();
  job->stage = Stage::made;
  if (failure)
    fail(failure);
  else
    changed_.notify_all();
  return true;
}

/// Writes the files at the head of the queue that are made. Returns false when there is none.
bool FileQueue::write_made(Lock& lock) {
  const auto end =
      std::find_if(jobs_.begin(), jobs_.end(), [](const Job& job) { return job.stage != Stage::made; });
  if (end == jobs_.begin()) return false;
  std::vector<FileContent> batch;
  batch.reserve(index_of(std::distance(jobs_.begin(), end)));
  for (auto job = jobs_.begin(); job != end; ++job) {
    job->stage = Stage::under_way; // stays in the list: whoever waits, waits for it
    batch.push_back(std::move(job->file));
  }
  lock.unlock();
  std::exception_ptr failure;
  try {
    write_atomically(batch);
  } catch (...) { failure = std::current_exception(); }
  lock.lock();
  if (failure) {
    fail(failure);
    return true;
  }
  for (std::size_t k = 0; k < batch.size(); ++k, jobs_.pop_front()) waiting_bytes_ -= jobs_.front().bytes;
  changed_.notify_all();
  return true;
}

} // namespace cnem::results
