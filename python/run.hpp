#pragma once
// A run as Python holds it.
#include "app/run.hpp"
#include "python/convert.hpp"
#include "python/watcher.hpp"

#include <atomic>
#include <memory>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <variant>
#include <vector>

namespace cnem::python {

/// Present corners of the cells, of which Python's arrays are parts.
struct Cells {
  std::vector<double> vertex; ///< m, [vertex][component]
  std::size_t dimensions = 2;
  std::vector<std::int32_t> begin, index; ///< as CellGeometry
};

/// While a call goes on, with the interpreter's lock released, others are refused: but for those that its
/// callback makes.
class PythonRun : public std::enable_shared_from_this<PythonRun> {
public:
  /// Throws InputError and IoError.
  PythonRun(const input::Case& input, const std::string& output, bool force, int threads);
  PythonRun(const std::string& folder, int threads); ///< goes on with the run there

  void go_on(const Until& until, py::object callback);
  /// Of the run as it ended; none when it is to go on.
  std::optional<int> exit() const { return exit_; }
  void stop(const std::string& by) { watcher_.stop(by); }
  bool is_going() const { return going_; }

  const Watcher& watcher() const { return watcher_; }
  const input::Case& input() const { return run_->input(); }
  const std::string output() const { return run_->options().output.string(); }
  results::RunStatus status() { return session().status(); }

  using Shot = std::variant<results::Snapshot<2>, results::Snapshot<3>>;
  Shot shot() { return session().snapshot(); }
  /// Values of a field of the catalogue, at "nodes" or "points"; "": where it lives. Throws InputError.
  py::array field(const std::string& name, const std::string& at);
  std::vector<std::string> field_names();
  /// One array for each component, m.
  py::tuple positions();
  Cells cells();
  /// A PNG of the present state. field: "" for the first that the case draws. Throws InputError in space.
  py::bytes picture(const std::string& field, int width);
  const std::vector<std::string>& columns() { return session().history().names(); }
  py::array column(std::size_t k);

private:
  /// Throws std::runtime_error while another call goes on.
  app::Session& session();
  /// As find(session), in the run as it is when it is asked; null once it is gone.
  template<class Find> std::function<const Field*()> finder(Find find);

  Watcher watcher_;
  std::optional<app::Run> run_;
  std::optional<int> exit_;
  std::atomic<bool> going_{false};
};

} // namespace cnem::python
