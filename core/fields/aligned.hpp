#pragma once
// Storage for fields: 64-byte aligned, so that a kernel may load whole cache lines and vectors, and shared
// with whoever looks at it from outside the program.
#include <array>
#include <atomic>
#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace cnem {

/// Stands before the elements of a block and counts who holds them: the vector, and views of them.
struct alignas(64) BlockHead {
  std::atomic<std::size_t> holders{1};

  static BlockHead* of(void* elements) { return static_cast<BlockHead*>(elements) - 1; }
  void hold() { holders.fetch_add(1, std::memory_order_relaxed); }
  void let_go() {
    if (holders.fetch_sub(1, std::memory_order_acq_rel) == 1)
      ::operator delete (this, std::align_val_t{alignof(BlockHead)});
  }
};

template<class T> struct AlignedAllocator {
  using value_type = T;
  static_assert(alignof(T) <= alignof(BlockHead));

  AlignedAllocator() = default;
  template<class U> AlignedAllocator(const AlignedAllocator<U>&) {}

  T* allocate(std::size_t n) {
    void* const block =
        ::operator new (sizeof(BlockHead) + n * sizeof(T), std::align_val_t{alignof(BlockHead)});
    return static_cast<T*>(static_cast<void*>(new (block) BlockHead + 1));
  }
  void deallocate(T* p, std::size_t) { BlockHead::of(p)->let_go(); }
  template<class U> bool operator==(const AlignedAllocator<U>&) const { return true; }
};

template<class T> using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// One scalar per node or stress point.
using Field = AlignedVector<double>;

/// Keeps the elements that a field has now, also after the field has taken others or is gone. What the field
/// does with them meanwhile shows.
class KeptField {
public:
  explicit KeptField(const Field& field)
      : data_(field.data()), size_(field.size()),
        head_(field.capacity() ? BlockHead::of(const_cast<double*>(data_)) : nullptr) {
    if (head_) head_->hold();
  }
  ~KeptField() {
    if (head_) head_->let_go();
  }
  KeptField(KeptField&& other) noexcept
      : data_(other.data_), size_(other.size_), head_(std::exchange(other.head_, nullptr)) {}
  KeptField(const KeptField&) = delete;
  KeptField& operator=(const KeptField&) = delete;

  const double* data() const { return data_; }
  std::size_t size() const { return size_; }
  /// Whether they are those of `field` as it is now.
  bool is_of(const Field& field) const { return field.data() == data_ && field.size() == size_; }

private:
  const double* data_;
  std::size_t size_;
  BlockHead* head_; ///< null: there are no elements
};

/// n scalars per node or stress point, structure of arrays: field[component][index].
template<int n> using Fields = std::array<Field, n>;

template<std::size_t n> void resize_all(std::array<Field, n>& fields, std::size_t size, double value = 0.0) {
  for (Field& f : fields) f.assign(size, value);
}

template<std::size_t n> std::array<double*, n> pointers(std::array<Field, n>& fields) {
  std::array<double*, n> p;
  for (std::size_t k = 0; k < n; ++k) p[k] = fields[k].data();
  return p;
}

template<std::size_t n> std::array<const double*, n> pointers(const std::array<Field, n>& fields) {
  std::array<const double*, n> p;
  for (std::size_t k = 0; k < n; ++k) p[k] = fields[k].data();
  return p;
}

} // namespace cnem
