// The module cnem._cnem; what users see of it is python/cnem.
#include "app/process/exhaustion.hpp"
#include "core/error.hpp"
#include "python/bind.hpp"
#include "python/convert.hpp"

#include <system_error>

namespace cnem::python {

namespace {

/// Raises cnem.NAME(message).
void raise(const char* name, const char* message) {
  const py::object type = py::module_::import("cnem.errors").attr(name);
  PyErr_SetObject(type.ptr(), type(message).ptr());
}

} // namespace

void bind_errors() {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise("InputError", error.what());
    } catch (const DivergenceError& error) {
      raise("DivergedError", error.what());
    } catch (const IoError& error) {
      raise("IoError", error.what());
    } catch (const std::system_error& error) { // files and threads
      raise("IoError", error.what());
    } catch (const std::bad_alloc&) { PyErr_SetString(PyExc_MemoryError, app::memory_exhausted().c_str()); }
  });
}

} // namespace cnem::python

PYBIND11_MODULE(_cnem, module) {
  cnem::python::bind_errors();
  cnem::python::bind_arrays(module);
  cnem::python::bind_case(module);
  cnem::python::bind_run(module);
}
