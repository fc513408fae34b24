#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "sweep/summary/summary.hpp"

namespace wormdrive {

/// The first columns of trials as CSV, by which such a table is known.
inline constexpr std::string_view trials_csv_mark = "index,status,reason,";
/// The header line of a summary as CSV.
inline constexpr std::string_view summary_csv_header = "table,name,metric,quantity,value,low,high,unit\n";

/// Hands the trials of a sweep that are there over as CSV, part by part, a row for each: index, status, reason, the
/// parameters in the units and under the paths of the study, the metrics in SI with their units in their names. A cell
/// is empty where there is no value; the last bit of a number is kept.
void write_trials_csv(const SweepReader& sweep, const std::function<void(std::string_view)>& put);

/// A summary as CSV, a row for each number: of which table (trials, metrics, thresholds, influences), of what, the
/// metric that it is about, its name, the value with its 95 % interval, if there is one, and the unit.
std::string summary_csv(const SweepReader& sweep, const SweepSummary& summary);

}  // namespace wormdrive
