// Runs: on their way, and what can be seen of them.
#include "core/error.hpp"
#include "python/bind.hpp"
#include "python/run.hpp"

#include <cmath>
#include <limits>
#include <pybind11/stl.h>

namespace cnem::python {

namespace {

template<class... Arguments> std::shared_ptr<PythonRun> begin(const Arguments&... arguments) {
  const py::gil_scoped_release others;
  return std::make_shared<PythonRun>(arguments...);
}

void go_on(PythonRun& run, std::optional<double> until, std::optional<std::int64_t> steps, bool output,
           py::object callback) {
  if (until && std::isnan(*until)) throw InputError("until: found nan, expected a time in s");
  Until limits;
  limits.output = output;
  if (until) limits.time = *until - 1e-9 * run.input().time.end; // as outputs are due
  if (steps) limits.steps = *steps;
  run.go_on(limits, callback.is_none() ? py::object() : std::move(callback));
}

py::dict metrics_of(PythonRun& run) {
  const results::RunStatus status = run.status();
  py::dict metrics;
  for (const auto& [name, value] : status.metrics) metrics[py::str(name)] = value;
  return metrics;
}

} // namespace

void bind_run(py::module_& module) {
  py::class_<Cells, std::shared_ptr<Cells>>(
      module, "Cells",
      "Cells of the stress points as they were when asked for: polygons, or tetrahedra in space.")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) {
            const auto& cells = self.cast<const Cells&>();
            return part_of(self, cells.vertex.data(), cells.vertex.size() / cells.dimensions,
                           cells.dimensions);
          },
          "Places of the corners, [vertex, component] m.")
      .def_property_readonly(
          "begin",
          [](const py::object& self) {
            const auto& cells = self.cast<const Cells&>();
            return part_of(self, cells.begin.data(), cells.begin.size());
          },
          "Where each cell begins in `index`, [cell + 1].")
      .def_property_readonly(
          "index",
          [](const py::object& self) {
            const auto& cells = self.cast<const Cells&>();
            return part_of(self, cells.index.data(), cells.index.size());
          },
          "Corners of the cells, one cell after the other, counter-clockwise in the plane.")
      .def("__len__", [](const Cells& cells) { return cells.begin.size() - 1; });

  py::class_<PythonRun, std::shared_ptr<PythonRun>>(module, "Run")
      .def(py::init(&begin<input::Case, std::string, bool, int>), py::arg("case"), py::arg("output"),
           py::arg("force"), py::arg("threads"))
      .def(py::init(&begin<std::string, int>), py::arg("folder"), py::arg("threads"))
      .def("go_on", &go_on, py::arg("until"), py::arg("steps"), py::arg("output"), py::arg("callback"))
      .def("stop", &PythonRun::stop)
      .def_property_readonly("exit", &PythonRun::exit)
      .def_property_readonly("going", &PythonRun::is_going)
      .def_property_readonly("output", &PythonRun::output)
      .def_property_readonly("messages", [](const PythonRun& run) { return run.watcher().messages(); })
      .def_property_readonly("failed", [](const PythonRun& run) { return run.watcher().failed(); })
      .def_property_readonly("row", [](const PythonRun& run) { return run.watcher().row(); })
      .def_property_readonly("frame", [](const PythonRun& run) { return run.watcher().frame(); })
      .def_property_readonly("case_name", [](const PythonRun& run) { return run.input().name; })
      .def_property_readonly("title", [](const PythonRun& run) { return run.input().title; })
      .def_property_readonly("end", [](const PythonRun& run) { return run.input().time.end; })
      .def_property_readonly("dimensions",
                             [](const PythonRun& run) { return run.input().analysis.dimensions(); })
      .def_property_readonly("time",
                             [](PythonRun& run) {
                               return std::visit([](const auto& shot) { return shot.state.time; },
                                                 run.shot());
                             })
      .def_property_readonly("step",
                             [](PythonRun& run) {
                               return std::visit([](const auto& shot) { return shot.state.step; },
                                                 run.shot());
                             })
      .def_property_readonly("nodes",
                             [](PythonRun& run) {
                               return std::visit([](const auto& shot) { return shot.state.node.size(); },
                                                 run.shot());
                             })
      .def("status", [](PythonRun& run) { return results::status_json(run.status()); })
      .def("metrics", &metrics_of)
      .def("metric_units", [](PythonRun& run) { return run.status().metric_units; })
      .def("field", &PythonRun::field, py::arg("name"), py::arg("at"))
      .def("field_names", &PythonRun::field_names)
      .def("positions", &PythonRun::positions)
      .def("cells", [](PythonRun& run) { return std::make_shared<Cells>(run.cells()); })
      .def("picture", &PythonRun::picture, py::arg("field"), py::arg("width"))
      .def("columns", &PythonRun::columns)
      .def("column", &PythonRun::column);
}

} // namespace cnem::python
