#pragma once
// Whether there is memory for what is about to be done.
#include <cstddef>
#include <new>

namespace cnem {

/// Throws std::bad_alloc when so many bytes cannot be had. For the moments before a library is called that
/// does not outlive a lack of memory.
inline void try_memory(std::size_t bytes) { ::operator delete(::operator new(bytes)); }

} // namespace cnem
