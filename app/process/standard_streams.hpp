#pragma once
// What the program prints: a reader that has gone does not end a run, and a full disk does not go unnoticed.

namespace cnem::app {

/// Stands between the program's stdout and stderr and their files from its construction to the end of the
/// process: printing never fails, and what cannot be written is dropped. One for a process.
class StandardStreams {
public:
  StandardStreams();
  StandardStreams(const StandardStreams&) = delete;
  StandardStreams& operator=(const StandardStreams&) = delete;

  /// The exit code of a program that would end with `code`: io_failed, told on stderr, instead of done when
  /// stdout could not be written. A closed pipe is nobody's fault: whoever read it has seen enough.
  int finish(int code) const;
};

} // namespace cnem::app
