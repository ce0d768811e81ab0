#include "python/convert.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <memory>
#include <string>

namespace cnem::python {

namespace {

using input::Value;

const input::Location in_dict{"dict", 0, 0};
constexpr std::size_t deepest = 64; // as in files

std::string type_name(const py::handle& object) {
  return py::str(py::type::handle_of(object).attr("__name__"));
}

[[noreturn]] void refuse(const std::string& source, const std::string& key, const std::string& found,
                         const std::string& expected) {
  throw InputError(fmt::format("{}: key '{}': found {}, expected {}", source, key, found, expected));
}

Value value_of(const py::handle& object, const input::Location& where, const std::string& key,
               std::size_t depth = 0);

std::vector<input::Member> members_of(const py::dict& table, const input::Location& where,
                                      const std::string& path, std::size_t depth) {
  std::vector<input::Member> members;
  for (const auto& [name, object] : table) {
    if (!py::isinstance<py::str>(name))
      refuse(where.source, (path.empty() ? "" : path + ".") + std::string(py::str(name)),
             "a key of type " + type_name(name), "a str");
    std::string key = name.cast<std::string>();
    const std::string inside = path.empty() ? key : path + "." + key;
    Value value = value_of(object, where, inside, depth + 1);
    members.push_back({std::move(key), where, std::move(value)});
  }
  return members;
}

Value value_of(const py::handle& object, const input::Location& where, const std::string& key,
               std::size_t depth) {
  if (depth > deepest)
    throw InputError(
        fmt::format("{}: key '{}': found tables or lists in one another more than {} deep, expected fewer",
                    where.source, key, deepest));
  Value value;
  value.where = where;
  if (py::isinstance<py::bool_>(object)) {
    value.kind = Value::Kind::boolean;
    value.boolean = object.cast<bool>();
  } else if (py::isinstance<py::int_>(object)) {
    value.kind = Value::Kind::integer;
    int overflow = 0;
    value.integer = PyLong_AsLongLongAndOverflow(object.ptr(), &overflow);
    if (overflow != 0) refuse(where.source, key, std::string(py::str(object)), "a whole number of 64 bits");
  } else if (py::isinstance<py::float_>(object)) {
    value.kind = Value::Kind::real;
    value.real = object.cast<double>();
  } else if (py::isinstance<py::str>(object)) {
    value.kind = Value::Kind::text;
    value.text = object.cast<std::string>();
  } else if (py::hasattr(object, "__fspath__")) {
    value.kind = Value::Kind::text;
    value.text = object.attr("__fspath__")().cast<std::string>();
  } else if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object)) {
    value.kind = Value::Kind::array;
    for (const py::handle& element : object)
      value.elements.push_back(
          value_of(element, where, fmt::format("{}[{}]", key, value.elements.size()), depth + 1));
  } else if (py::isinstance<py::dict>(object)) {
    value.kind = Value::Kind::table;
    value.members = members_of(py::reinterpret_borrow<py::dict>(object), where, key, depth);
  } else if (py::hasattr(object, "tolist")) { // NumPy's arrays and numbers
    return value_of(object.attr("tolist")(), where, key, depth + 1);
  } else {
    refuse(where.source, key, object.is_none() ? "None" : "an object of type " + type_name(object),
           "bool, int, float, str, list, dict or a NumPy array");
  }
  return value;
}

} // namespace

input::Value document_of(const py::dict& tables) {
  Value document;
  document.kind = Value::Kind::table;
  document.where = in_dict;
  document.members = members_of(tables, in_dict, "", 0);
  return document;
}

std::vector<input::Override> overrides_of(const py::object& overrides) {
  std::vector<input::Override> list;
  if (overrides.is_none()) return list;
  if (py::isinstance<py::dict>(overrides)) {
    for (const auto& [name, object] : py::reinterpret_borrow<py::dict>(overrides)) {
      const std::string key = py::str(name);
      const input::Location where{fmt::format("override {}", key), 0, 0};
      list.push_back({key, value_of(object, where, key), where});
    }
    return list;
  }
  if (py::isinstance<py::str>(overrides))
    throw InputError(
        "overrides: found a str, expected a dict such as {\"time.end\": \"3 us\"} or a list such as "
        "[\"time.end=3 us\"]");
  for (const py::handle& assignment : overrides)
    list.push_back(input::parse_override(std::string(py::str(assignment)), "override"));
  return list;
}

namespace {

template<class T> py::array array_on(const T* data, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array array(py::dtype::of<T>(), std::move(shape), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

} // namespace

py::array view(const Field& field, std::function<const Field*()> where) {
  auto buffer = std::make_unique<Buffer>(KeptField(field), std::move(where));
  const double* data = buffer->kept().data();
  const auto size = static_cast<py::ssize_t>(buffer->kept().size());
  return array_on(data, {size}, py::cast(std::move(buffer)));
}

py::array owned(const Field& values) { return view(values, nullptr); }

template<class T>
py::array part_of(const py::object& owner, const T* data, std::size_t rows, std::size_t columns) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows)};
  if (columns > 0) shape.push_back(static_cast<py::ssize_t>(columns));
  return array_on(data, std::move(shape), owner);
}
template py::array part_of(const py::object&, const double*, std::size_t, std::size_t);
template py::array part_of(const py::object&, const std::int32_t*, std::size_t, std::size_t);

void bind_arrays(py::module_& module) {
  py::class_<Buffer>(module, "Buffer", "Memory that arrays of a run share; the `base` of each of them.")
      .def_property_readonly(
          "current", &Buffer::current,
          "Whether the run still keeps its values here. False after the run has changed its "
          "cloud of nodes, added rows to the history, or is gone: the array then holds what "
          "was there before. False for values that were calculated for the array alone.");
}

} // namespace cnem::python
