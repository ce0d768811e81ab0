// Cases: read, built, checked.
#include "app/run.hpp"
#include "app/version.hpp"
#include "input/case_reader.hpp"
#include "input/schema/schema.hpp"
#include "python/bind.hpp"
#include "python/convert.hpp"

#include <pybind11/stl.h>

namespace cnem::python {

namespace {

py::dict checked_case(const input::Case& input, const std::string& output, int threads) {
  app::Checked checked;
  {
    const py::gil_scoped_release others;
    checked = app::check(input, {.output = output, .threads = threads, .version = app::version()});
  }
  py::dict result;
  result["warnings"] = checked.warnings;
  result["facts"] = checked.facts;
  py::dict numbers;
  for (const auto& [name, number] : checked.numbers) numbers[py::str(name)] = number;
  result["numbers"] = numbers;
  result["fault"] = checked.fault;
  return result;
}

py::dict variables_of(const input::Case& input) {
  py::dict variables;
  for (const input::Variable& variable : input.variables)
    variables[py::str(variable.name)] = py::make_tuple(variable.value, variable.unit);
  return variables;
}

} // namespace

void bind_case(py::module_& module) {
  py::class_<input::Case, std::shared_ptr<input::Case>>(module, "Case")
      .def_static(
          "read",
          [](const std::string& path, const py::object& overrides) {
            return std::make_shared<input::Case>(input::read_case_with(path, overrides_of(overrides)));
          },
          py::arg("path"), py::arg("overrides") = py::none())
      .def_static(
          "build",
          [](const py::dict& tables, const std::string& path, const py::object& overrides) {
            return std::make_shared<input::Case>(
                input::read_case_document(document_of(tables), path, overrides_of(overrides)));
          },
          py::arg("tables"), py::arg("path"), py::arg("overrides") = py::none())
      .def_readonly("path", &input::Case::path)
      .def_readonly("name", &input::Case::name)
      .def_readonly("title", &input::Case::title)
      .def_readonly("resolved", &input::Case::resolved)
      .def_readonly("warnings", &input::Case::warnings)
      .def_property_readonly("dimensions", [](const input::Case& c) { return c.analysis.dimensions(); })
      .def_property_readonly(
          "static", [](const input::Case& c) { return c.analysis.type == input::Analysis::Type::statics; })
      .def_property_readonly("method", [](const input::Case& c) { return c.method.name; })
      .def_property_readonly("end", [](const input::Case& c) { return c.time.end; })
      .def_property_readonly("variables", &variables_of)
      .def_property_readonly("variable_texts", &app::variable_texts)
      .def("check", &checked_case, py::arg("output"), py::arg("threads"));
  module.def("version", &app::version);
  module.def("schema", &input::json_schema);
}

} // namespace cnem::python
