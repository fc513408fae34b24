#include "sweep/file/resume.hpp"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "description/diagnostics.hpp"

namespace wormdrive {
namespace {

/// What an interrupted sweep has left; nothing if that is no trial, as after a kill in its first moments.
std::optional<SweepReader> trials_left(const std::string& part_path, bool resume) {
  if (!std::filesystem::exists(part_path)) return std::nullopt;
  reject_if_being_written(part_path);
  try {
    SweepReader part(part_path);
    if (part.trials() == 0) return std::nullopt;
    return part;
  } catch (const InputFault& fault) {
    if (!resume) return std::nullopt;  // what another command left, or nothing that could be read
    std::vector<Fault> faults = fault.faults;
    faults.front().what = fmt::format("cannot be resumed: {}; delete the file to start again", faults.front().what);
    throw InputFault(faults);
  }
}

}  // namespace

void reject_another_sweep(const SweepReader& there, const Study& study, TrialRange range) {
  if (const std::string why = there.why_not_of(study); !why.empty())
    reject({there.path()},
           fmt::format("cannot be resumed: {}; undo the change, or delete the file to start again", why));
  if (there.range().first != range.first || there.range().end != range.end)
    reject({there.path()},
           fmt::format("cannot be resumed: it contains trials {} to {}, not {} to {}; repeat its --shard",
                       there.range().first, there.range().end - 1, range.first, range.end - 1));
}

void reject_restart(const SweepReader& there) {
  reject(
      {there.path()},
      fmt::format(
          "contains {} of {} trials of an interrupted sweep; add --resume to continue it, or delete it to start again",
          there.trials(), there.range().size()));
}

OpenSweep open_sweep(const std::string& path, OutputLock lock, const Study& study, TrialRange range,
                     const std::string& command_line, bool resume, Replace replace) {
  const std::string part_path = path + ".part";
  ReasonTable reasons;
  std::vector<TrialRange> present;
  const bool anew = !resume && replace == Replace::anything;
  if (const auto part = anew ? std::nullopt : trials_left(part_path, resume)) {
    if (!resume) reject_restart(*part);
    reject_another_sweep(*part, study, range);
    reasons = part->counted_reasons();
    present = part->present();
  } else {
    if (resume && std::filesystem::exists(path)) {
      const SweepReader done(path);
      reject_another_sweep(done, study, study.may_end_early() ? done.range() : range);
      return {};
    }
    SweepFile::create(path, study, range, command_line, replace);
  }
  const std::uint64_t failed = reasons.total();
  return {std::move(lock), std::make_unique<SweepFile>(path, study, range, std::move(reasons), replace),
          outside(present, range), failed};
}

}  // namespace wormdrive
