#include "output/text_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "output/hdf5/hdf5.hpp"
#include "output/hdf5/part_file.hpp"
#include "output/replacing.hpp"

namespace wormdrive {

void write_text_file(const std::string& path, const std::string& text) {
  write_text_file(path, [&](const auto& put) { put(text); });
}

void write_text_file(const std::string& link,
                     const std::function<void(const std::function<void(std::string_view)>&)>& write) {
  const std::string path = followed(link), part = path + ".part";
  reject_unless_plain_file(path);
  reject_unless_plain_file(part);
  errno = 0;
  std::FILE* const file = std::fopen(part.c_str(), "wb");
  bool written = file != nullptr;
  int reason = errno;
  const auto put = [&](std::string_view text) {
    if (!written || std::fwrite(text.data(), 1, text.size(), file) == text.size()) return;
    written = false;
    reason = errno;
  };
  try {
    if (file) write(put);
  } catch (...) {
    std::fclose(file);
    std::remove(part.c_str());
    throw;
  }
  if (file && std::fclose(file) != 0 && written) {
    written = false;
    reason = errno;
  }
  try {
    if (written) synchronise(part);
  } catch (const OutputFault&) {
    std::remove(part.c_str());
    throw;
  }
  if (written && std::rename(part.c_str(), path.c_str()) == 0) return;
  const int last = written ? errno : reason;
  if (file) std::remove(part.c_str());
  throw OutputFault(fmt::format("cannot write {}: {}", path, std::strerror(last)));
}

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!std::filesystem::is_directory(path))
    throw OutputFault(fmt::format("cannot make the folder {}: {}", path,
                                  error ? error.message() : "something of another kind has that name"));
}

}  // namespace wormdrive
