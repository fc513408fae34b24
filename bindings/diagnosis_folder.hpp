#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "diagnosis/diagnose_files.hpp"
#include "diagnosis/diagnosis_file.hpp"
#include "diagnosis/diagnosis_json.hpp"
#include "output/text_file.hpp"
#include "scenarios/overwriting.hpp"
#include "scenarios/write_scenario.hpp"

namespace wormdrive {

/// The folder in which a diagnosis is kept, docs/diagnosis_json.md, whoever asks for it.
class DiagnosisFolder {
 public:
  /// Throws InputFault if what is written would destroy one of the files that are read.
  DiagnosisFolder(const std::string& path, const std::vector<std::string>& inputs)
      : path_((std::filesystem::path(path) / "").parent_path().string()) {
    for (const std::string& input : inputs)
      for (const char* const name : {"diagnosis.json", "extended.toml", "experiment.toml", "diagnosis.h5"})
        refuse_to_overwrite(inside(name), input);
  }

  std::string inside(const std::string& name) const { return path_ + "/" + name; }

  /// Writes all files but the pictures, which pictures() draws from diagnosis.h5 and names; returns what was written,
  /// diagnosis.json the last: where it is, the rest is too. Throws OutputFault.
  template <class Pictures>
  std::vector<std::string> write(const Diagnosis& found, const nlohmann::json& json, const std::string& title,
                                 const std::string& command_line, Pictures&& pictures) const {
    make_folder(path_);
    std::vector<std::string> written{inside("extended.toml"), inside("diagnosis.h5")};
    const std::string extended = to_toml(found.extended);
    write_text_file(written[0], extended);
    if (found.experiment) {
      written.push_back(inside("experiment.toml"));
      write_text_file(written.back(), to_toml(*found.experiment));
    }
    write_diagnosis(written[1], found, {"diagnosis", title, extended, command_line});
    for (const std::string& picture : pictures()) written.push_back(picture);
    written.push_back(inside("diagnosis.json"));
    write_text_file(written.back(), json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    return written;
  }

 private:
  std::string path_;
};

}  // namespace wormdrive
