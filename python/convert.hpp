#pragma once
// What Python hands over, as the input knows it, and what it gets, as NumPy arrays.
#include "core/fields/aligned.hpp"
#include "input/schema/document.hpp"

#include <functional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <utility>
#include <vector>

namespace cnem::python {

namespace py = pybind11;

/// A dict of a case as a document: bool, int, float, str, path, list, tuple, dict, and NumPy's numbers and
/// arrays, nested. Throws InputError that names the key of anything else.
input::Value document_of(const py::dict& tables);

/// {"time.end": "2 us"} or ["time.end=2 us"]; None: none. Throws InputError.
std::vector<input::Override> overrides_of(const py::object& overrides);

/// What the arrays of a run stand on: memory that stays as long as one of them.
class Buffer {
public:
  /// where: finds the field in the run as it is now; null when there is none any more.
  Buffer(KeptField kept, std::function<const Field*()> where)
      : kept_(std::move(kept)), where_(std::move(where)) {}
  /// Whether the run still keeps these values in it.
  bool current() const {
    const Field* now = where_ ? where_() : nullptr;
    return now && kept_.is_of(*now);
  }
  const KeptField& kept() const { return kept_; }

private:
  KeptField kept_;
  std::function<const Field*()> where_;
};

/// A read-only array on the memory of a field: no copy. `where` as for Buffer.
py::array view(const Field& field, std::function<const Field*()> where);
/// A read-only array that owns calculated values.
py::array owned(const Field& values);
/// A read-only array [rows][columns] on memory of `owner`.
template<class T>
py::array part_of(const py::object& owner, const T* data, std::size_t rows, std::size_t columns = 0);

void bind_arrays(py::module_& module);

} // namespace cnem::python
