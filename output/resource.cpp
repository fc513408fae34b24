#include "output/resource.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "output/hdf5/hdf5.hpp"

namespace wormdrive {

namespace fs = std::filesystem;

std::string resource(const std::string& path) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) throw OutputFault(fmt::format("cannot find {}: reading /proc/self/exe: {}", path, error.message()));
  const fs::path folder = program.parent_path();
  for (const fs::path& root : {folder, folder.parent_path()})
    if (fs::path found = fs::canonical(root / path, error); !error) return found.string();
  throw OutputFault(fmt::format("cannot find {} in {} or in {}; install wormdrive again", path, folder.string(),
                                folder.parent_path().string()));
}

std::string documentation_page(const std::string& path) {
  try {
    return resource("share/doc/wormdrive/docs/" + path);
  } catch (const OutputFault&) {
    return "docs/" + path;
  }
}

}  // namespace wormdrive
