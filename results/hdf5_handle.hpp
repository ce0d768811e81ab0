#pragma once
// Calls of HDF5 that end well or throw.
#include "core/error.hpp"

#include <fmt/format.h>

#include <hdf5.h>

#include <new>
#include <string>

namespace cnem::results::hdf5 {

extern "C" inline herr_t note_lack_of_memory(unsigned, const H5E_error2_t* error, void* lacking) {
  if (error->maj_num == H5E_RESOURCE || error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC)
    *static_cast<bool*>(lacking) = true;
  return 0;
}

/// A file that lives in memory fails for lack of memory, or because it holds something else than expected.
[[noreturn]] inline void fail(const std::string& message) {
  bool lacking = false;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, note_lack_of_memory, &lacking);
  if (lacking) throw std::bad_alloc();
  throw IoError(message);
}

/// An HDF5 object that closes itself.
class Handle {
public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) fail(fmt::format("HDF5 failed at {}", what));
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

inline void check(herr_t result, const std::string& what) {
  if (result < 0) fail(fmt::format("HDF5 failed at {}", what));
}

} // namespace cnem::results::hdf5
