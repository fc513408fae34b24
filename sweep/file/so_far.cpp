#include "sweep/file/so_far.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdlib.h>

#include <fmt/format.h>

#include "description/diagnostics.hpp"
#include "sweep/file/pieces.hpp"
#include "sweep/ranks/rank_files.hpp"

namespace wormdrive {
namespace {

namespace fs = std::filesystem;

/// The files in which an unfinished sweep stands; none if it is finished, or there is nothing.
std::vector<std::string> parts_of(const std::string& path) {
  std::error_code none;
  if (fs::exists(path, none)) return is_being_written(path) ? std::vector{path} : std::vector<std::string>{};
  std::vector<std::string> parts = rank_parts(path);
  if (const std::string part = path + ".part"; fs::exists(part, none)) parts.push_back(part);
  return parts;
}

/// The file is not locked in the moment between its making and its opening; the right to write it is held all along.
bool is_running(const std::string& path, const std::vector<std::string>& parts) {
  const bool is_part = fs::path(path).extension() == ".part";
  return is_being_written(path + (is_part ? ".lock" : ".part.lock")) ||
         std::any_of(parts.begin(), parts.end(), is_being_written);
}

fs::path folder_of_its_own() {
  std::string name = (fs::temp_directory_path() / "wormdrive_XXXXXX").string();
  if (!mkdtemp(name.data())) throw OutputFault(fmt::format("cannot create {}: {}", name, std::strerror(errno)));
  return name;
}

void copy(const SweepPieces& pieces, const std::string& path) {
  const SweepReader& first = *pieces.files.front();
  for (const auto& file : pieces.files)
    if (const std::string why = file->why_not_of(first); !why.empty())
      reject({file->path()}, fmt::format("is not of the same sweep as {}: {}", first.path(), why));
  const TrialRange range = pieces.files.size() == 1 ? first.range() : TrialRange{0, first.study().trials()};
  SweepFile::create(path, first.study(), range, first.command_line());
  SweepFile file(path, first.study(), range);
  std::uint64_t next = range.first;
  std::vector<SweepPiece> once;
  for (const auto& [have, in] : pieces.in_order) {  // twice while the ranks' files are put together
    if (have.end > next) once.push_back({{std::max(have.first, next), have.end}, in});
    next = std::max(next, have.end);
  }
  file.copy(once);
}

}  // namespace

SweepSoFar::SweepSoFar(const std::string& path) : path_(path) {
  for (std::vector<std::string> parts = parts_of(path); !parts.empty();) {
    try {
      copy_of(parts, path);
      return;
    } catch (const InputFault&) {
      if (parts_of(path) == parts) throw;  // else it has become NAME meanwhile
      parts = parts_of(path);
    }
  }
  running_ = false;
}

void SweepSoFar::copy_of(const std::vector<std::string>& parts, const std::string& path) {
  running_ = is_running(path, parts);
  const SweepPieces pieces(parts, true);
  folder_ = folder_of_its_own();
  const fs::path name = fs::path(path).filename();
  const std::string copied = (folder_ / (name.extension() == ".part" ? name.stem() : name)).string();
  try {
    copy(pieces, copied);
  } catch (...) {
    fs::remove_all(folder_);
    throw;
  }
  path_ = copied + ".part";
}

SweepSoFar::~SweepSoFar() {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

}  // namespace wormdrive
