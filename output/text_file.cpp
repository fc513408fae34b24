#include "output/text_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "output/hdf5.hpp"
#include "output/part_file.hpp"

namespace wormdrive {

void write_text_file(const std::string& path, const std::string& text) {
  const std::string part = path + ".part";
  std::error_code none;
  if (std::filesystem::exists(path, none) && !std::filesystem::is_regular_file(path, none))
    throw OutputFault(fmt::format("cannot write {}: it is not a plain file", path));
  errno = 0;
  std::FILE* const file = std::fopen(part.c_str(), "wb");
  bool written = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (file) written = std::fclose(file) == 0 && written;
  const int reason = errno;
  if (written) synchronise(part);
  if (written && std::rename(part.c_str(), path.c_str()) == 0) return;
  if (file) std::filesystem::remove(part, none);
  throw OutputFault(fmt::format("cannot write {}: {}", path, std::strerror(written ? errno : reason)));
}

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!std::filesystem::is_directory(path))
    throw OutputFault(fmt::format("cannot make the folder {}: {}", path,
                                  error ? error.message() : "something of another kind has that name"));
}

}  // namespace wormdrive
