#pragma once
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "description/warnings.hpp"
#include "output/trajectory.hpp"
#include "simulation/overwriting.hpp"
#include "simulation/run_scenario.hpp"
#include "simulation/write_run.hpp"

namespace wormdrive {

/// "gear self-locking"
std::string name(LockingRegime regime);

/// "gear self-locking; C1 -0.0471, C2 0.0837, H 3.4957; eq. 17 holds by a factor of 44"; empty without a mesh.
std::string describe_mesh(const Scenario& scenario);

/// "12 events: 1 break-away, 6 flank changes, 5 reversals"
std::string describe_events(const RunSummary& summary);

/// "26 guards, 12 events, 0 missed; closest graze 0.03 rad/s at 1.413 s"
std::string describe_audit(const AuditReport& report, const Scenario& scenario);

/// Prints "  label    text", wrapped text indented under itself.
void print_item(const std::string& label, const std::string& text);

/// NAME.h5 beside the current directory for a scenario NAME.toml; never the scenario file itself.
std::string default_output(const std::string& scenario_file, const std::string& suffix);

/// Prints JSON; bytes of a file name that are no UTF-8 are replaced.
void print_json(const nlohmann::json& json);

}  // namespace wormdrive
