#pragma once
#include <string>

#include "diagnosis/diagnosis.hpp"

namespace wormdrive {

/// A study as TOML whose parameters have the joint distribution that the data of a diagnosis leave, of its extended
/// scenario or of any other one of this drive; empty where nothing was fitted. Where there are draws, their rows are
/// drawn.
std::string uncertainty_study(const Diagnosis& diagnosis);

/// The name of the draws beside the study.
inline constexpr const char* draws_file = "draws.csv";
/// The draws as CSV, with a column for each parameter of the study; empty where there are none.
std::string uncertainty_draws(const Diagnosis& diagnosis);

}  // namespace wormdrive
