// One target under libFuzzer, which the environment names: WORMDRIVE_FUZZ_TARGET=scenario fuzz_libfuzzer CORPUS
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "fuzz/targets.hpp"

namespace {
const wormdrive::fuzz::Target* chosen = nullptr;
}

/// Finds the target, and puts its seeds into the first folder of the command line.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const char* const name = std::getenv("WORMDRIVE_FUZZ_TARGET");
  for (const auto& target : wormdrive::fuzz::targets())
    if (name && target.name == name) chosen = &target;
  std::filesystem::path corpus;
  for (int k = 1; k < *argc && corpus.empty(); ++k)
    if (std::filesystem::is_directory((*argv)[k])) corpus = (*argv)[k];
  if (!chosen || corpus.empty()) {
    std::fprintf(stderr, "WORMDRIVE_FUZZ_TARGET must be a target, and the first argument a folder\n");
    std::exit(2);
  }
  std::string folder = (std::filesystem::temp_directory_path() / "wormdrive_fuzz_XXXXXX").string();
  if (!mkdtemp(folder.data())) std::exit(2);
  int number = 0;
  for (const auto& seed : chosen->seeds(folder))
    std::ofstream(corpus / ("seed_" + std::to_string(number++)), std::ios::binary)
        .write(reinterpret_cast<const char*>(seed.data()), static_cast<std::streamsize>(seed.size()));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen->take(data, size);
  return 0;
}
