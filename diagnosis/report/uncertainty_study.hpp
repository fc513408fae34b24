#pragma once
#include <string>

#include "diagnosis/diagnosis.hpp"

namespace wormdrive {

/// A study as TOML whose parameters have the joint distribution that the data of a diagnosis leave, of its extended
/// scenario or of any other one of this drive; empty where nothing was fitted.
std::string uncertainty_study(const Diagnosis& diagnosis);

}  // namespace wormdrive
