#include "cli/describe/drive.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/elastic/elastic_teeth.hpp"
#include "core/energy.hpp"
#include "description/build.hpp"
#include "description/diagnostics.hpp"
#include "events/simulation_failure.hpp"

namespace wormdrive {
namespace {

std::string plural(long count, const std::string& singular) {
  return fmt::format("{} {}{}", count, singular, count == 1 ? "" : "s");
}

}  // namespace

std::string name(LockingRegime regime) {
  switch (regime) {
    case LockingRegime::back_drivable: return "back-drivable";
    case LockingRegime::gear_self_locking: return "gear self-locking";
    case LockingRegime::worm_self_locking: return "worm self-locking";
  }
  return "";
}

std::string describe_mesh(const Scenario& scenario) {
  const GearMesh<double> mesh = make_mesh(scenario);
  if (!mesh.has_teeth) return "";
  const double slope = scenario.effects.least_slope();
  const double surface = mesh.Jw * mesh.i * slope * slope / greatest_gear_inertia(scenario);
  std::string motion = fmt::format("eq. 17 holds by a factor of {:.3g}", surface / -mesh.C1());
  if (mesh.C1() >= 0.0) motion = "eq. 17 holds (C1 >= 0)";
  if (mesh.C1() <= -surface)
    motion = fmt::format("eq. 17 is violated: the drive {} jam", has_elastic_teeth(scenario.effects) ? "can" : "would");
  if (mesh.regime() == LockingRegime::worm_self_locking) motion = "no motion without load";
  return fmt::format("{}; C1 {:.4f}, C2 {:.4f}, H {:.4f}; {}", name(mesh.regime()), mesh.C1(), mesh.C2(), mesh.H(),
                     motion);
}

std::string describe_events(const RunSummary& summary) {
  if (summary.total_events() == 0) return "no events";
  std::vector<std::string> parts;
  for (const auto& [kind, singular] : {std::pair{EventKind::break_away, "break-away"},
                                       {EventKind::flank_change, "flank change"},
                                       {EventKind::reversal, "reversal"},
                                       {EventKind::stop, "stop"},
                                       {EventKind::impact, "impact"},
                                       {EventKind::opening, "opening"},
                                       {EventKind::gear_break_away, "gear break-away"},
                                       {EventKind::gear_reversal, "gear reversal"},
                                       {EventKind::gear_stop, "gear stop"}})
    if (const long count = summary.events[static_cast<std::size_t>(kind)]; count > 0)
      parts.push_back(plural(count, singular));
  return fmt::format("{}: {}", plural(summary.total_events(), "event"), fmt::join(parts, ", "));
}

std::string describe_audit(const AuditReport& report, const Scenario& scenario) {
  const bool linear = scenario.axis == Axis::linear;
  std::string text = fmt::format("{}, {}, {} missed", plural(report.guards, "guard"),
                                 plural(report.events, "guard event"), report.missed());
  for (const AuditFinding& finding : report.findings)
    text += fmt::format("; {} at {:.9g} s: {}, {}", finding.missed ? "missed" : "not confirmed", finding.t,
                        finding.guard, describe(finding.mode));
  if (const auto speed = report.closest.find(has_elastic_teeth(scenario.effects) ? "worm speed" : "gear speed");
      speed != report.closest.end())
    text += fmt::format("; closest graze {:.3g} {} at {:.5g} s", speed->second.distance, linear ? "m/s" : "rad/s",
                        speed->second.t);
  else
    text += "; no graze";
  text += fmt::format("; event times agree within {:.1e} s, segments within {:.1e} {}", report.largest_time_error,
                      report.largest_angle_error, linear ? "m" : "rad");
  if (report.work > 0.0 && std::abs(closing_error(make_mesh(scenario))) < 1e-9)
    text += fmt::format("; the energy balance closes within {:.1e} of the work done",
                        std::abs(report.energy_error) / report.work);
  return text;
}

void print_item(const std::string& label, const std::string& text) { fmt::print("  {:<8} {}\n", label, text); }

std::string default_output(const std::string& scenario_file, const std::string& suffix) {
  std::filesystem::path file(scenario_file);
  if (file.extension() == ".part") file.replace_extension();
  const bool stored = file.extension() == ".h5";
  return file.stem().string() + (stored ? "_again" : "") + suffix;
}

void print_json(const nlohmann::json& json) {
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace wormdrive
