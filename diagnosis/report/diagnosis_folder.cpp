#include "diagnosis/report/diagnosis_folder.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "description/toml/write_scenario.hpp"
#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/report/diagnosis_file.hpp"
#include "diagnosis/report/uncertainty_study.hpp"
#include "output/text_file.hpp"
#include "simulation/overwriting.hpp"

namespace wormdrive {
namespace {

/// The ids of effects, "none" without one.
std::string ids(const std::vector<EstimatedEffect>& effects) {
  std::vector<std::string> names;
  for (const EstimatedEffect& effect : effects)
    if (effect.remedy.empty()) names.push_back(effect.effect);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

namespace {
/// diagnosis.h5 is the first: it tells that the others are of a diagnosis too.
constexpr const char* file_names[] = {"diagnosis.h5",     "extended.toml", "fitted_to_earlier.toml", "experiment.toml",
                                      "uncertainty.toml", draws_file,      "diagnosis.json"};
}  // namespace

std::string extended_file(const Diagnosis& d) {
  std::string text = fmt::format("# A scenario that wormdrive diagnose has extended; causes: {}.\n", ids(d.causes));
  for (const EstimatedEffect& cause : d.causes)
    if (!cause.remedy.empty())
      text += fmt::format("# A fault of the recording and not of the drive: {}. {}\n", cause.effect, cause.remedy);
  for (const std::vector<std::string>& members : d.classes)
    text += fmt::format("# The data cannot tell the causes of this class apart: {}.\n", fmt::join(members, ", "));
  std::vector<EstimatedEffect> moved;
  for (const EstimatedEffect& e : d.calibration)
    if (field_of(d.extended.effects, e.effect, e.parameters.front().field).on) moved.push_back(e);
  if (!moved.empty()) text += fmt::format("# Stated values that moved within their tolerances: {}.\n", ids(moved));
  return text + to_toml(d.extended);
}

DiagnosisFolder::DiagnosisFolder(const std::string& path, const std::vector<std::string>& inputs, Replace replace)
    : path_((std::filesystem::path(path) / "").parent_path().string()), replace_(replace) {
  for (const std::string& input : inputs)
    for (const char* const name : file_names) reject_overwriting(inside(name), input);
  reject_replacing(followed(inside("diagnosis.h5")), "diagnosis", replace);
  if (replace == Replace::anything || std::filesystem::exists(inside("diagnosis.h5"))) return;
  for (const char* const name : file_names)
    if (std::filesystem::exists(inside(name)))
      throw OutputFault(
          fmt::format("cannot write {}: it exists and is not of a diagnosis; choose another folder, or "
                      "replace it with --force",
                      inside(name)));
}

std::vector<std::string> DiagnosisFolder::write(const Diagnosis& found, const nlohmann::json& json,
                                                const std::string& title, const std::string& command_line,
                                                const std::function<std::vector<std::string>()>& pictures) const {
  make_folder(path_);
  std::vector<std::string> written{inside("extended.toml"), inside("diagnosis.h5")};
  write_diagnosis(written[1], found, {"diagnosis", title, to_toml(found.extended), command_line}, replace_);
  write_text_file(written[0], extended_file(found));
  const auto write_or_remove = [&](const char* name, const std::string& text) {
    if (text.empty()) {  // one of an earlier diagnosis would be taken for one of this
      std::filesystem::remove(inside(name));
      return;
    }
    written.push_back(inside(name));
    write_text_file(written.back(), text);
  };
  write_or_remove("fitted_to_earlier.toml", found.since ? to_toml(found.since->scenario) : "");
  write_or_remove("experiment.toml", found.experiment ? to_toml(*found.experiment) : "");
  write_or_remove(draws_file, uncertainty_draws(found));
  write_or_remove("uncertainty.toml", uncertainty_study(found));
  for (const std::string& picture : pictures()) written.push_back(picture);
  written.push_back(inside("diagnosis.json"));
  write_text_file(written.back(), json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  return written;
}

}  // namespace wormdrive
