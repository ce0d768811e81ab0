#include "app/process/standard_streams.hpp"
#include "core/index.hpp"

#include "app/run.hpp"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>

namespace cnem::app {

namespace {

/// A file descriptor and the first error of writing to it; 0: none. They outlive main(), as the streams do.
struct Sink {
  int fd;
  int error = 0;
};
Sink output{STDOUT_FILENO}, errors{STDERR_FILENO};

ssize_t pass_on(void* cookie, const char* text, std::size_t size) {
  Sink& sink = *static_cast<Sink*>(cookie);
  for (std::size_t done = 0; done < size && sink.error == 0;) {
    const ssize_t n = write(sink.fd, text + done, size - done);
    if (n >= 0)
      done += index_of(n);
    else if (errno != EINTR)
      sink.error = errno;
  }
  return static_cast<ssize_t>(size);
}

std::FILE* stream_to(Sink& sink, int buffering, std::FILE* otherwise) {
  std::FILE* stream = fopencookie(&sink, "w", {nullptr, pass_on, nullptr, nullptr});
  if (!stream) return otherwise;
  std::setvbuf(stream, nullptr, buffering, BUFSIZ);
  return stream;
}

} // namespace

StandardStreams::StandardStreams() {
  // A closed one would give its number to the next file that is opened, and what is printed would land there.
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(fd, F_GETFD) < 0) [[maybe_unused]]
      const int same = open("/dev/null", fd == STDOUT_FILENO ? O_RDONLY : O_RDWR);
  stdout = stream_to(output, isatty(STDOUT_FILENO) == 1 ? _IOLBF : _IOFBF, stdout);
  stderr = stream_to(errors, _IONBF, stderr);
}

int StandardStreams::finish(int code) const {
  std::fflush(stdout);
  if (output.error == 0 || output.error == EPIPE) return code;
  fmt::print(stderr, "cannot write to standard output: {}\n",
             std::error_code(output.error, std::generic_category()).message());
  return code == Exit::done ? Exit::io_failed : code;
}

} // namespace cnem::app
