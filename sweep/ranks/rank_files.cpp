#include "sweep/ranks/rank_files.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "output/hdf5/part_file.hpp"
#include "sweep/file/resume.hpp"

namespace wormdrive {
namespace {

std::string prefix(const std::string& name) { return name + ".rank_"; }

std::uint64_t generation_of(const std::string& part, const std::string& name) {
  std::uint64_t generation = 0;
  const std::size_t begin = prefix(name).size();
  std::from_chars(part.data() + begin, part.data() + part.size(), generation);
  return generation;
}

bool ranges_rise(const TrialRange& a, const TrialRange& b) { return a.first < b.first; }

}  // namespace

std::string rank_file(const std::string& name, std::uint64_t generation, int rank) {
  return fmt::format("{}{}_{}", prefix(name), generation, rank);
}

std::vector<std::string> rank_parts(const std::string& name) {
  const std::filesystem::path path(name), folder = path.has_parent_path() ? path.parent_path() : ".";
  const std::string begin = prefix(path.filename().string());
  std::vector<std::string> parts;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (const std::string file = entry.path().filename().string(); file.starts_with(begin) && file.ends_with(".part"))
      parts.push_back((path.parent_path() / file).string());
  std::sort(parts.begin(), parts.end());
  return parts;
}

RankPlan plan_ranks(const std::string& name, const Study& study, bool resume, Replace replace) {
  const TrialRange all{0, study.trials()};
  RankPlan plan;
  std::vector<std::string> parts = rank_parts(name);
  for (const std::string& part : parts) plan.generation = std::max(plan.generation, generation_of(part, name));
  if (std::filesystem::exists(name + ".part")) parts.push_back(name + ".part");
  std::vector<TrialRange> present;
  for (const std::string& part : parts) {
    reject_if_being_written(part);
    const SweepReader there(part);
    if (there.trials() == 0) {
      std::filesystem::remove(part);
      continue;
    }
    if (!resume) reject_restart(there);
    reject_another_sweep(there, study, all);
    plan.failed += there.counted_reasons().total();
    present.insert(present.end(), there.present().begin(), there.present().end());
  }
  if (std::filesystem::exists(name + ".part"))  // of a single process: as if a rank had made it
    std::filesystem::rename(name + ".part", rank_file(name, ++plan.generation, 0) + ".part");
  ++plan.generation;
  if (resume && present.empty() && std::filesystem::exists(name)) {
    const SweepReader done(name);
    reject_another_sweep(done, study, study.may_end_early() ? done.range() : all);
    plan.complete = true;
    return plan;
  }
  reject_replacing(name, "sweep", replace);
  std::sort(present.begin(), present.end(), ranges_rise);
  plan.missing = outside(present, all);
  return plan;
}

}  // namespace wormdrive
