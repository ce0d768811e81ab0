#pragma once
// Instruction sets for which the vector kernels (*_kernel.cpp) are compiled, and the one in use.
#include <optional>
#include <string_view>

namespace cnem {

enum class Isa { baseline, avx2, avx512 };

/// "baseline", "avx2" or "avx512".
std::string_view isa_name(Isa isa);

/// Whether this machine can run kernels of the set.
bool isa_supported(Isa isa);

/// The set that the environment variable CNEM_ISA asks for; none when it is not there. Throws InputError when
/// it is not a name or the machine lacks the set.
std::optional<Isa> wanted_isa();

/// The set in use: the best supported one, or that of the environment variable CNEM_ISA (read once), or the
/// last set_isa(). Throws InputError as wanted_isa() does.
Isa active_isa();

/// Forces a set; not to be called while kernels run. Throws InputError when the machine lacks it.
void set_isa(Isa isa);

/// Returns what the entry of the set in use returns: CNEM_ON_ACTIVE_ISA(kernel(a, b)) calls avx2::kernel(a,
/// b) or another.
#define CNEM_ON_ACTIVE_ISA(...)                                                                              \
  switch (active_isa()) {                                                                                    \
  case Isa::avx512:                                                                                          \
    return avx512::__VA_ARGS__;                                                                              \
  case Isa::avx2:                                                                                            \
    return avx2::__VA_ARGS__;                                                                                \
  case Isa::baseline:                                                                                        \
    break;                                                                                                   \
  }                                                                                                          \
  return baseline::__VA_ARGS__

} // namespace cnem
