#include "core/machine/isa.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <string>

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

constexpr std::array all_sets{Isa::baseline, Isa::avx2, Isa::avx512};

Isa best_isa() {
  for (const Isa isa : {Isa::avx512, Isa::avx2})
    if (isa_supported(isa)) return isa;
  return Isa::baseline;
}

std::string available_sets() {
  std::string names;
  for (const Isa isa : all_sets)
    if (isa_supported(isa)) names += fmt::format("{}{}", names.empty() ? "" : ", ", isa_name(isa));
  return names;
}

Isa& current() {
  static Isa isa = wanted_isa().value_or(best_isa());
  return isa;
}

} // namespace

std::optional<Isa> wanted_isa() {
  const char* name = std::getenv("CNEM_ISA");
  if (!name) return {};
  for (const Isa isa : all_sets)
    if (name == isa_name(isa) && isa_supported(isa)) return isa;
  throw InputError(fmt::format(
      "environment variable CNEM_ISA = \"{}\": expected an instruction set that this machine has: {}", name,
      available_sets()));
}

Isa active_isa() { return current(); }

void set_isa(Isa isa) {
  if (!isa_supported(isa))
    throw InputError(fmt::format("instruction set {}: expected one that this machine has: {}", isa_name(isa),
                                 available_sets()));
  current() = isa;
}

} // namespace cnem
