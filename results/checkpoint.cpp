#include "results/checkpoint.hpp"

#include "core/error.hpp"
#include "core/fnv.hpp"
#include "core/index.hpp"
#include "core/machine/memory.hpp"

#include <fmt/format.h>

#include <hdf5.h>

#include <atomic>
#include <charconv>
#include <mutex>
#include <new>
#include <utility>

namespace cnem::results {
namespace {

constexpr std::size_t head_size = 512; // where HDF5 looks for its signature next after the first byte
constexpr std::string_view signature = "cnem checkpoint, format ";
constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

std::string head_of(std::string_view body) {
  std::string head = fmt::format("{}{}\n{} bytes of HDF5 follow these {}\nchecksum fnv-1a {:016x}\n",
                                 signature, checkpoint_format, body.size(), head_size, fnv(body));
  head.resize(head_size, '\0');
  return head;
}

/// The number at the start of a text; −1 when there is none.
std::int64_t leading_number(std::string_view text) {
  std::int64_t value = -1;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// The HDF5 part of a file that is whole. Throws IoError with the reason otherwise.
std::string_view checked_body(std::string_view content) {
  if (!content.starts_with(signature)) {
    if (content.empty()) throw IoError("it is empty");
    if (content.starts_with(hdf5_signature)) throw IoError("it is an HDF5 file, but no checkpoint of cnem");
    throw IoError("it is no checkpoint of cnem");
  }
  const std::string_view rest = content.substr(signature.size());
  if (const std::int64_t format = leading_number(rest); format != checkpoint_format && format >= 0)
    throw IoError(
        fmt::format("it has format {}, this version of cnem reads format {}", format, checkpoint_format));
  const std::string_view body = content.substr(std::min(head_size, content.size()));
  const std::int64_t wanted = leading_number(rest.substr(std::min(rest.find('\n') + 1, rest.size())));
  if (wanted > static_cast<std::int64_t>(body.size()))
    throw IoError(fmt::format("it is cut short: {} of {} bytes are there", content.size(),
                              head_size + index_of(wanted)));
  if (content.substr(0, head_size) != head_of(body))
    throw IoError("it is damaged: the checksum does not fit the content");
  return body;
}

extern "C" herr_t note_lack_of_memory(unsigned, const H5E_error2_t* error, void* lacking) {
  if (error->maj_num == H5E_RESOURCE || error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC)
    *static_cast<bool*>(lacking) = true;
  return 0;
}

/// A file that lives in memory fails for lack of memory, or because it holds something else than expected.
[[noreturn]] void fail(const std::string& message) {
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

void check(herr_t result, const std::string& what) {
  if (result < 0) fail(fmt::format("HDF5 failed at {}", what));
}

/// HDF5 is one for the process: while one lives, no other thread calls it, and it prints nothing. HDF5 itself
/// does not outlive a lack of memory for the caches that it makes with each file.
class OneAtATime {
public:
  OneAtATime() {
    constexpr std::size_t caches = std::size_t{6} << 20;
    try_memory(caches);
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // failures are ours to tell
  }
  ~OneAtATime() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  OneAtATime(const OneAtATime&) = delete;
  OneAtATime& operator=(const OneAtATime&) = delete;

private:
  static std::recursive_mutex& mutex() {
    static std::recursive_mutex only;
    return only;
  }
  std::lock_guard<std::recursive_mutex> lock_{mutex()};
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// Properties of a file that lives in memory alone.
hid_t in_memory() {
  const hid_t properties = H5Pcreate(H5P_FILE_ACCESS);
  check(H5Pset_fapl_core(properties, std::size_t{1} << 20, false), "its memory");
  return properties;
}

/// A name of its own: HDF5 takes two open files of one name for one file.
std::string unused_name() {
  static std::atomic<int> used{0};
  return fmt::format("checkpoint {}", ++used);
}

} // namespace

void CheckpointInfo::archive(Archive& archive) {
  archive.text("info/version", version);
  archive.text("info/instruction_set", isa);
  archive.text("info/case", name);
  archive.text("info/inputs", inputs);
  archive.integer("info/step", step);
  archive.number("info/time", "s", time);
}

std::string hash_of_inputs(std::string_view resolved_case) {
  return fmt::format("{:016x}", fnv(resolved_case.substr(resolved_case.find('\n') + 1)));
}

struct CheckpointWriter::File {
  OneAtATime alone;
  Handle access{in_memory(), H5Pclose, "file properties"};
  Handle links{H5Pcreate(H5P_LINK_CREATE), H5Pclose, "link properties"};
  Handle sets{H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "data properties"};
  Handle file{H5Fcreate(unused_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "a file"};

  File() {
    check(H5Pset_create_intermediate_group(links, 1), "groups");
    check(H5Pset_obj_track_times(sets, false), "times"); // the same bytes whenever they are written
  }
  void write(const std::string& name, hid_t stored, hid_t space, hid_t given, const void* data,
             const char* unit) const {
    const Handle set(H5Dcreate2(file, name.c_str(), stored, space, links, sets, H5P_DEFAULT), H5Dclose, name);
    check(H5Dwrite(set, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), name);
    if (!unit) return;
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, name), scalar(H5Screate(H5S_SCALAR), H5Sclose, name);
    check(H5Tset_size(type, std::char_traits<char>::length(unit) + 1), name);
    const Handle attribute(H5Acreate2(set, "unit", type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
    check(H5Awrite(attribute, type, unit), name);
  }
};

CheckpointWriter::CheckpointWriter() : file_(std::make_unique<File>()) {}
CheckpointWriter::~CheckpointWriter() = default;

std::string CheckpointWriter::content() {
  check(H5Fflush(file_->file, H5F_SCOPE_GLOBAL), "its end");
  const ssize_t size = H5Fget_file_image(file_->file, nullptr, 0);
  if (size < 0) fail("HDF5 failed at the size of the file");
  std::string all(head_size + index_of(size), '\0');
  if (H5Fget_file_image(file_->file, all.data() + head_size, index_of(size)) != size)
    fail("HDF5 failed at the content of the file");
  all.replace(0, head_size, head_of(std::string_view(all).substr(head_size)));
  return all;
}

std::size_t CheckpointWriter::extent(const std::string&) { return 0; }

void CheckpointWriter::carry(const std::string& name, const char* unit, std::span<double> values) {
  const hsize_t size = values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, name);
  file_->write(name, H5T_IEEE_F64LE, space, H5T_NATIVE_DOUBLE, values.data(), unit);
}

void CheckpointWriter::carry(const std::string& name, std::span<std::int64_t> values) {
  const hsize_t size = values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, name);
  file_->write(name, H5T_STD_I64LE, space, H5T_NATIVE_INT64, values.data(), nullptr);
}

void CheckpointWriter::carry(const std::string& name, std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, name), space(H5Screate(H5S_SCALAR), H5Sclose, name);
  check(H5Tset_size(type, value.size() + 1), name);
  file_->write(name, type, space, type, value.c_str(), nullptr);
}

struct CheckpointReader::File {
  OneAtATime alone;
  Handle access{in_memory(), H5Pclose, "file properties"};
  std::unique_ptr<Handle> file;

  explicit File(std::string_view body) {
    check(H5Pset_file_image(access, const_cast<char*>(body.data()), body.size()), "its content"); // copies
    file = std::make_unique<Handle>(H5Fopen(unused_name().c_str(), H5F_ACC_RDONLY, access), H5Fclose,
                                    "its content");
  }
  /// A set of the kind and length expected; H5T_NO_CLASS and `any` for any.
  hid_t open(const std::string& name, H5T_class_t kind, std::size_t length) const {
    const hid_t set = H5Dopen2(*file, name.c_str(), H5P_DEFAULT);
    if (set < 0) fail(fmt::format("it lacks '{}'", name));
    const Handle type(H5Dget_type(set), H5Tclose, name), space(H5Dget_space(set), H5Sclose, name);
    const auto found = index_of(H5Sget_simple_extent_npoints(space));
    const bool fits = kind == H5T_NO_CLASS || H5Tget_class(type) == kind;
    if (fits && (length == any || found == length)) return set;
    H5Dclose(set);
    throw IoError(!fits ? fmt::format("'{}' is of another type than expected", name)
                        : fmt::format("'{}' has {} values, expected {}", name, found, length));
  }
  static constexpr std::size_t any = static_cast<std::size_t>(-1);
};

CheckpointReader::CheckpointReader(std::string_view content)
    : file_(std::make_unique<File>(checked_body(content))) {}
CheckpointReader::~CheckpointReader() = default;

std::size_t CheckpointReader::extent(const std::string& name) {
  const Handle set(file_->open(name, H5T_NO_CLASS, File::any), H5Dclose, name);
  const Handle space(H5Dget_space(set), H5Sclose, name);
  return index_of(H5Sget_simple_extent_npoints(space));
}

void CheckpointReader::carry(const std::string& name, const char*, std::span<double> values) {
  const Handle set(file_->open(name, H5T_FLOAT, values.size()), H5Dclose, name);
  check(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
}

void CheckpointReader::carry(const std::string& name, std::span<std::int64_t> values) {
  const Handle set(file_->open(name, H5T_INTEGER, values.size()), H5Dclose, name);
  check(H5Dread(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
}

void CheckpointReader::carry(const std::string& name, std::string& value) {
  const Handle set(file_->open(name, H5T_STRING, File::any), H5Dclose, name);
  const Handle type(H5Dget_type(set), H5Tclose, name);
  value.assign(H5Tget_size(type), '\0');
  check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), name);
  value.resize(value.find('\0'));
}

} // namespace cnem::results
