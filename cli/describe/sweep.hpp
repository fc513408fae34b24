#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sweep/file/sweep_file.hpp"
#include "sweep/summary/statistics.hpp"

namespace wormdrive {

/// " N m"; nothing for a plain number.
std::string in_unit(const Unit& unit);

/// An estimate and its interval, if it has one, times a scale: "0.12 [0.11, 0.13]".
std::string with_interval(const SampleEstimate& e, double scale = 1.0);
/// The same, "unknown" if there is none.
std::string with_interval(const std::optional<SampleEstimate>& e);

/// "error_max 0.002 rad", or "without error_max" where the value is not a number.
std::string with_value(const Metric& metric, double value);

/// A trial's value of a metric, or why it has none: "error_max 0.002 rad", "halted: cannot go on at t = 0.3 s: ...".
std::string how_it_ended(const Study& study, const std::string& metric, const Trial& trial);

/// Prints what a study asks for.
void print_study(const Study& study, TrialRange range);

/// Prints how many trials are not done, and why.
void print_failures(const ReasonTable& reasons);
/// What ends a sweep of which more trials are not done than at most: of how many, and the reason that most of them
/// have.
std::string too_many_failed(const ReasonTable& reasons, std::uint64_t trials, std::uint64_t most);

/// What the gear's angles are called on an axis.
inline std::string_view angles_on(Axis axis) { return axis == Axis::linear ? "positions" : "angles"; }

/// Prints how far CVODE is from the trials that it has judged, and with which it disagrees.
void print_verdicts(const std::vector<RefereeVerdict>& verdicts, const Study& study);

}  // namespace wormdrive
