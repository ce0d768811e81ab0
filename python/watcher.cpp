#include "python/watcher.hpp"

#include "core/machine/clock.hpp"

#include <utility>

namespace cnem::python {

void Watcher::expect(const Until& until, py::object callback) {
  until_ = until;
  callback_ = std::move(callback);
  row_ = frame_ = false;
}

void Watcher::settle() {
  callback_ = py::object();
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

void Watcher::stop(const std::string& by) {
  const std::lock_guard lock(mutex_);
  stopped_by_ = by;
}

std::vector<std::string> Watcher::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

std::string Watcher::failed() const {
  const std::lock_guard lock(mutex_);
  return failed_;
}

void Watcher::remark(const std::string& text) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(text);
}

void Watcher::failure(const std::string& text) {
  remark(text);
  const std::lock_guard lock(mutex_);
  failed_ = text;
}

void Watcher::recorded(bool row, bool frame) {
  row_ = row;
  frame_ = frame;
  if (!callback_ || thrown_) return;
  const py::gil_scoped_acquire interpreter;
  calling_ = true;
  try {
    const py::object answer = callback_(row, frame);
    py::detail::make_caster<bool> truth;
    // Without conversion: bool, and numpy.bool_ as comparisons of fields give it; None is no answer.
    if (truth.load(answer, false) && !py::detail::cast_op<bool>(truth)) stop("the callback");
  } catch (py::error_already_set& error) {
    stop(std::string(py::str(error.type().attr("__name__"))) + " in the callback");
    thrown_ = std::current_exception();
  }
  calling_ = false;
}

/// Handlers of signals run in Python's main thread, when it is asked to look: seldom enough to cost nothing.
void Watcher::look_for_interrupt() {
  constexpr double every = 0.05; // s
  const double now = wall_time();
  if (now - looked_at_ < every) return;
  looked_at_ = now;
  const py::gil_scoped_acquire interpreter;
  if (PyErr_CheckSignals() == 0) return;
  try {
    throw py::error_already_set();
  } catch (py::error_already_set& error) {
    stop(py::str(error.type().attr("__name__")));
    thrown_ = std::current_exception();
  }
}

app::Request Watcher::request() {
  if (!thrown_) look_for_interrupt();
  {
    const std::lock_guard lock(mutex_);
    if (stopped_by_) return {app::Request::Kind::stop, *std::exchange(stopped_by_, std::nullopt)};
  }
  if (now_ >= until_.time || until_.steps == 0 || (until_.output && (row_ || frame_)))
    return {app::Request::Kind::pause};
  --until_.steps;
  return {};
}

} // namespace cnem::python
