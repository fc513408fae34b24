#pragma once
#include "cli/report/page.hpp"
#include "cli/report/result_file.hpp"

namespace wormdrive {

// One page for each kind of result; what the kinds have in common (parameters, provenance) is added by the command.

ReportPage report_of_run(const ResultFile& file);
ReportPage report_of_statics(const ResultFile& file);
ReportPage report_of_steady(const ResultFile& file);
ReportPage report_of_sweep(const ResultFile& file);
/// diagnosis.json is looked for beside the file.
ReportPage report_of_diagnosis(const ResultFile& file);

}  // namespace wormdrive
