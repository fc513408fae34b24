#include "sweep/resume.hpp"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "scenarios/faults.hpp"

namespace wormdrive {
namespace {

/// The rows of an interrupted sweep; nothing if there are none, as after a kill in its first second.
std::unique_ptr<SweepReader> read_part(const std::string& path) {
  if (!std::filesystem::exists(path)) return nullptr;
  try {
    auto part = std::make_unique<SweepReader>(path);
    return part->rows() > 0 ? std::move(part) : nullptr;
  } catch (const InputFault&) {
    return nullptr;
  }
}

void refuse_another(const SweepReader& part, const Study& study, TrialRange range) {
  if (const std::string why = part.why_not_of(study); !why.empty())
    refuse({part.path()}, fmt::format("cannot be resumed: {}; undo the change, or delete the file to begin anew", why));
  if (part.range().first != range.first || part.range().end != range.end)
    refuse({part.path()},
           fmt::format("cannot be resumed: it holds trials {} to {}, and {} to {} are wanted; give its --shard again",
                       part.range().first, part.range().end - 1, range.first, range.end - 1));
}

}  // namespace

std::unique_ptr<SweepFile> open_sweep(const std::string& path, const Study& study, TrialRange range,
                                      const std::string& command_line, bool resume) {
  // What a killed resume had copied is not worth a look: the original stays until the copy is safe.
  const std::string part_path = path + ".part", before = path + ".part.before";
  const bool copying = std::filesystem::exists(before);
  std::unique_ptr<SweepReader> part = read_part(copying ? before : part_path);
  if (part && !resume)
    refuse({part->path()},
           fmt::format("holds {} of {} trials of an interrupted sweep; add --resume to go on, or delete "
                       "it to begin anew",
                       part->rows(), part->range().size()));
  if (part) {
    refuse_another(*part, study, range);
    if (!copying) std::filesystem::rename(part_path, before);
  }
  auto file = std::make_unique<SweepFile>(path, study, range, command_line);
  if (part) {
    copy_rows(*part, *file);
    part.reset();
    std::filesystem::remove(before);
  }
  return file;
}

}  // namespace wormdrive
