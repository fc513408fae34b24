#pragma once
#include "cli/report/page.hpp"
#include "cli/report/result_file.hpp"

namespace wormdrive {

// One page for each kind of result.

ReportPage report_of_run(const ResultFile& file);
ReportPage report_of_statics(const ResultFile& file);
ReportPage report_of_steady(const ResultFile& file);
ReportPage report_of_efficiency(const ResultFile& file);
ReportPage report_of_sweep(const ResultFile& file);
ReportPage report_of_rare(const ResultFile& file);
/// diagnosis.json is looked for beside the file.
ReportPage report_of_diagnosis(const ResultFile& file);

/// The page of a result of any kind, with what the kinds have in common: parameters, provenance, scenario, warnings.
/// Throws InputFault where there is no page for the kind.
ReportPage whole_page(const ResultFile& file);

}  // namespace wormdrive
