#pragma once
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "diagnosis/diagnosis.hpp"
#include "output/replacing.hpp"

namespace wormdrive {

/// The extended scenario as a TOML file that says of itself what was added and why.
std::string extended_file(const Diagnosis& found);

/// The folder in which a diagnosis is kept, docs/diagnosis_json.md, whoever asks for it.
class DiagnosisFolder {
 public:
  /// Throws InputFault if what is written would destroy one of the files that are read, OutputFault if it would destroy
  /// files of a folder that no diagnosis has written.
  DiagnosisFolder(const std::string& path, const std::vector<std::string>& inputs,
                  Replace replace = Replace::same_kind);

  const std::string& path() const { return path_; }
  std::string inside(const std::string& name) const { return path_ + "/" + name; }

  /// Writes all files but the pictures, which pictures() draws from diagnosis.h5 and names; returns what was written,
  /// diagnosis.json the last: where it is, the rest is too. Throws OutputFault.
  std::vector<std::string> write(const Diagnosis& found, const nlohmann::json& json, const std::string& title,
                                 const std::string& command_line,
                                 const std::function<std::vector<std::string>()>& pictures) const;

 private:
  std::string path_;
  Replace replace_;
};

}  // namespace wormdrive
