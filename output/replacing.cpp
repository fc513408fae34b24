#include "output/replacing.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "output/hdf5/hdf5.hpp"
#include "output/hdf5/read_ahead.hpp"

namespace wormdrive {
namespace {

namespace fs = std::filesystem;

constexpr const char* cure = "choose another name, or replace it with --force";

[[noreturn]] void reject_place(const std::string& path, const std::string& why) {
  throw OutputFault(fmt::format("cannot write {}: {}", path, why));
}

std::string beginning(const std::string& path) {
  std::string text(4096, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

/// The kind of a result of this program; nothing if it is somebody else's, or cannot be read.
std::optional<std::string> kind_of(const std::string& path) {
  try {
    read_ahead(path);
    const Hdf5Handle file = open_hdf5(path);
    read_text_attribute(file, "wormdrive_version");
    return read_text_attribute(file, "kind");
  } catch (const OutputFault&) {
    return std::nullopt;
  }
}

bool opens(const std::string& path) {
  try {
    open_hdf5(path);
    return true;
  } catch (const OutputFault&) {
    return false;
  }
}

/// "a run", "a statics map"
std::string described(const std::string& kind) {
  if (kind == "rare") return "an estimate of rare misses";
  return kind == "run" || kind == "sweep" || kind == "diagnosis" ? fmt::format("a {}", kind)
                                                                 : fmt::format("a result of {}", kind);
}

void reject_another_kind(const std::string& path, std::string_view kind) {
  const std::optional<std::string> there = kind_of(path);
  if (!there) reject_place(path, fmt::format("it exists and is not a wormdrive result; {}", cure));
  if (*there != kind) reject_place(path, fmt::format("it holds {}; {}", described(*there), cure));
}

}  // namespace

std::string followed(const std::string& path) {
  fs::path at = path;
  std::error_code none;
  constexpr int most = 40;  // as the kernel follows
  for (int links = 0; fs::is_symlink(fs::symlink_status(at, none)); ++links) {
    if (links == most) reject_place(path, std::strerror(ELOOP));
    at = at.parent_path() / fs::read_symlink(at, none);  // an absolute target stands for itself
  }
  return at.string();
}

void reject_unless_plain_file(const std::string& path) {
  std::error_code none;
  if (fs::exists(path, none) && !fs::is_regular_file(path, none)) reject_place(path, "it is not a plain file");
}

void reject_replacing_part(const std::string& part_path, std::string_view kind, Replace replace) {
  std::error_code none;
  if (fs::is_symlink(fs::symlink_status(part_path, none))) reject_place(part_path, "it is a symbolic link");
  if (replace == Replace::anything || !fs::is_regular_file(part_path, none)) return;
  // what was torn in its first moments has zeros where a signature belongs, or does not open
  const std::string begin = beginning(part_path).substr(0, 8);
  if (std::all_of(begin.begin(), begin.end(), [](char c) { return c == '\0'; })) return;
  if (!is_hdf5(part_path)) reject_place(part_path, fmt::format("it exists and is not an HDF5 file; {}", cure));
  if (opens(part_path)) reject_another_kind(part_path, kind);
}

void reject_replacing(const std::string& path, std::string_view kind, Replace replace) {
  reject_unless_plain_file(path);
  reject_replacing_part(path + ".part", kind, replace);
  std::error_code none;
  if (replace == Replace::anything || !fs::exists(path, none) || fs::file_size(path, none) == 0) return;
  if (!is_hdf5(path)) reject_place(path, fmt::format("it exists and is not an HDF5 file; {}", cure));
  reject_another_kind(path, kind);
  if (kind == "sweep" || kind == "rare")  // which may have taken hours
    reject_place(path, fmt::format("it holds a finished {}; {}", kind == "sweep" ? "sweep" : "estimate", cure));
}

void reject_replacing_unmarked(const std::string& path, std::string_view mark, Replace replace) {
  reject_unless_plain_file(path);
  std::error_code none;
  for (const std::string& at : {path, path + ".part"}) {
    if (at != path && fs::is_symlink(fs::symlink_status(at, none))) reject_place(at, "it is a symbolic link");
    if (replace == Replace::anything || !fs::is_regular_file(at, none) || fs::file_size(at, none) == 0) continue;
    if (beginning(at).find(mark) == std::string::npos)
      reject_place(at, fmt::format("it exists and was not written by wormdrive; {}", cure));
  }
}

}  // namespace wormdrive
