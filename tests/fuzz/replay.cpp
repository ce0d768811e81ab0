// Feeds a fuzz target without a fuzzer: every file of folders, so that what once went wrong stays right, or
// random bytes, which any compiler can look for what goes wrong with.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr const char* usage =
    "usage: %s FOLDER...\n"
    "       %s --random SEED COUNT [FOLDER]\n"
    "COUNT inputs of random bytes, of the seeds SEED, SEED + 1, ...; each is told before "
    "it is tried, and the\nlast one is the culprit. FOLDER: the bytes of each go there, in "
    "a file of the name of its seed.\n";

int replay(int count, char** folders) {
  int files = 0;
  for (int k = 0; k < count; ++k)
    for (const auto& entry : std::filesystem::directory_iterator(folders[k])) {
      if (!entry.is_regular_file()) continue;
      std::ifstream stream(entry.path(), std::ios::binary);
      const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), {});
      std::fprintf(stderr, "%s\n", entry.path().c_str()); // the last one printed is the culprit
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
      ++files;
    }
  std::printf("%d files\n", files);
  return files > 0 ? 0 : 1;
}

/// The same bytes of a seed on any machine.
std::vector<std::uint8_t> bytes_of(std::uint64_t seed) {
  constexpr std::uint64_t longest = 128;
  std::mt19937_64 random(seed);
  std::vector<std::uint8_t> bytes(random() % longest + 1);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 256);
  return bytes;
}

int try_random(std::uint64_t seed, std::uint64_t count, const char* folder) {
  for (std::uint64_t end = seed + count; seed != end; ++seed) {
    const std::vector<std::uint8_t> bytes = bytes_of(seed);
    std::fprintf(stderr, "seed %llu\n", static_cast<unsigned long long>(seed));
    if (folder != nullptr) {
      std::ofstream file(std::filesystem::path(folder) / std::to_string(seed), std::ios::binary);
      file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      if (!file.flush()) {
        std::fprintf(stderr, "cannot write to %s\n", folder);
        return 1;
      }
    }
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  const bool random = argc > 1 && std::strcmp(argv[1], "--random") == 0;
  if (argc < 2 || (random && argc != 4 && argc != 5)) {
    std::fprintf(stderr, usage, argv[0], argv[0]);
    return 2;
  }
  if (random)
    return try_random(std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10),
                      argc == 5 ? argv[4] : nullptr);
  return replay(argc - 1, argv + 1);
}
