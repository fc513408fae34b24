#pragma once
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "diagnosis/diagnosis.hpp"

namespace wormdrive {

/// "named"
std::string name(Verdict verdict);

/// A diagnosis as docs/diagnosis_json.md describes it, in SI; what is not a finite number is null.
nlohmann::json as_json(const Diagnosis& diagnosis, const std::string& data_kind, const std::vector<std::string>& files);

}  // namespace wormdrive
