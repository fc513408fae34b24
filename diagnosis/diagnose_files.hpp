#pragma once
#include <map>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/diagnosis_settings.hpp"

namespace wormdrive {

/// What files of measured data hold.
enum class DataKind {
  recording,             ///< torque and angle over time
  speed_torque_records,  ///< torque at constant speeds
  break_in_table         ///< torque at which the gear starts to turn
};

/// "a recording over time"
std::string name(DataKind kind);

/// The kind of all files, by their columns. Throws InputFault for a file of no kind, and for files of different kinds.
DataKind kind_of_data(const std::vector<std::string>& files, const Scenario& scenario);

/// Reads the files and diagnoses them together. loads: of recordings over time, by file, that had another load
/// than the scenario's. Throws InputFault.
Diagnosis diagnose_files(const Scenario& scenario, DataKind kind, const std::vector<std::string>& files,
                         const DiagnosisSettings& settings, const std::map<std::string, LoadParameters>& loads = {});

/// Diagnoses the earlier files, then the later ones, of a kind, against the drive as it was then, and tells what
/// changed. Throws InputFault.
Diagnosis diagnose_since(const Scenario& scenario, const std::vector<std::string>& earlier, DataKind kind,
                         const std::vector<std::string>& later, const DiagnosisSettings& settings,
                         const std::map<std::string, LoadParameters>& loads = {});

}  // namespace wormdrive
