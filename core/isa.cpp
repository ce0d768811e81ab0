#include "core/isa.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace cnem {

std::string_view isa_name(Isa isa) {
  switch (isa) {
  case Isa::avx2:
    return "avx2";
  case Isa::avx512:
    return "avx512";
  case Isa::baseline:
    break;
  }
  return "baseline";
}

bool isa_supported(Isa isa) {
  switch (isa) {
  case Isa::avx2:
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  case Isa::avx512:
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("fma");
  case Isa::baseline:
    break;
  }
  return true;
}

namespace {

Isa checked(Isa isa) {
  if (!isa_supported(isa))
    throw InputError(fmt::format("instruction set {}: this machine does not have it", isa_name(isa)));
  return isa;
}

Isa initial_isa() {
  if (const char* name = std::getenv("CNEM_ISA")) {
    for (Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512})
      if (name == isa_name(isa)) return checked(isa);
    throw InputError(
        fmt::format("environment variable CNEM_ISA = \"{}\": expected baseline, avx2 or avx512", name));
  }
  for (Isa isa : {Isa::avx512, Isa::avx2})
    if (isa_supported(isa)) return isa;
  return Isa::baseline;
}

Isa& current() {
  static Isa isa = initial_isa();
  return isa;
}

} // namespace

Isa active_isa() { return current(); }
void set_isa(Isa isa) { current() = checked(isa); }

} // namespace cnem
