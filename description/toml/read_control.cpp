#include "description/toml/read_control.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "description/rejection.hpp"
#include "description/toml/read_reference.hpp"
#include "description/toml/read_signal.hpp"
#include "description/variant_kinds.hpp"

namespace wormdrive {
namespace {

template <class Parameters>
void read_law(TableReader& table, Parameters& parameters, const std::string&) {
  table.read_fields(parameters);
}
void read_law(TableReader& table, OpenLoopParameters& parameters, const std::string& folder) {
  const auto tables = table.tables("torque");
  if (!table.has("torque")) table.lacks("'torque' (the torque over time that is to be held)");
  parameters.torque = read_signal(tables, "controller.torque", table, folder);
}

class ControlReader {
 public:
  ControlReader(TableReader& root, Scenario& scenario, std::string folder)
      : root_(root), scenario_(scenario), folder_(std::move(folder)) {}

  void read() {
    ControlScenario& control = scenario_.control.emplace();
    root_.section("controller", [&](TableReader& controller) { read_controller(controller, control); });
    control.reference = read_reference(root_, folder_);
    root_.section("sensor", [&](TableReader& sensor) {
      sensor.read_fields(control.sensor);
      if (control.sensor.on_worm && std::holds_alternative<SingleInertia<double>>(scenario_.mesh))
        sensor.fault("shaft", "sensor.shaft = \"worm\" needs a worm, but mesh.kind is \"none\"");
      for (const ControllerRejection& refusal : sensor_rejections(scenario_)) sensor.fault(refusal.key, refusal.what);
    });
    if (root_.has("disturbance"))
      root_.section("disturbance", [&](TableReader& table) { table.read_fields(control.disturbance); });
    root_.section("metrics", [&](TableReader& metrics) { read_window(metrics, control.window); });
  }

 private:
  void read_controller(TableReader& table, ControlScenario& control) {
    table.read_fields(control.sampling);
    for (const ControllerRejection& refusal : sampling_rejections(scenario_)) table.fault(refusal.key, refusal.what);
    table.section("nominal", [&](TableReader& nominal) { nominal.read_fields(control.nominal); });
    table.section("variation", [&](TableReader& variation) {
      variation.read_fields(control.variations);
      if (const auto refusal = variation_rejection(scenario_)) variation.fault(refusal->key, refusal->what);
    });
    const auto kind = table.choice("kind", kinds_of<ControllerParameters>(), Presence::required);
    if (!kind) table.ignore_unknown();  // which keys it may have hangs on its kind
    if (!kind) return;
    control.law = make_kind<ControllerParameters>(*kind);
    std::visit([&](auto& law) { read_law(table, law, folder_); }, control.law);
    if (winds_up(control.law)) {
      read_anti_windup(table, control);
    } else if (table.has("anti_windup")) {
      table.text("anti_windup");
      table.fault("anti_windup",
                  fmt::format("controller.anti_windup needs a law with an integral, and \"{}\" has none", *kind));
    }
    const bool follows = !std::holds_alternative<OpenLoopParameters>(control.law);
    if (follows && !root_.has("reference")) table.lacks("a [reference] to follow");
    if (root_.faults().empty())
      for (const ControllerRejection& refusal : controller_rejections(scenario_))
        table.fault(refusal.key, refusal.what);
  }

  static void read_anti_windup(TableReader& table, ControlScenario& control) {
    AntiWindupSettings& settings = control.anti_windup;
    table.read_fields(settings);
    const auto [choice] = AntiWindupSettings::choices();
    const std::string method(choice.word(settings)), key(choice.key);
    if (table.has(key) && table.peek(key) != method) return;  // not one of its words, which was told
    if (settings.tracking_time && !AntiWindupSettings::tracks(settings.method))
      table.fault("tracking_time_s",
                  fmt::format("controller.tracking_time_s has no effect with anti_windup = \"{}\"; remove it, or use "
                              "\"back_calculation\" or \"model_recovery\"",
                              method));
  }

  void read_window(TableReader& metrics, MetricsWindow& window) {
    metrics.read_fields(window);
    if (const auto refusal = window_rejection(scenario_)) metrics.fault(refusal->key, refusal->what);
  }

  TableReader& root_;
  Scenario& scenario_;
  std::string folder_;
};

}  // namespace

void read_control(TableReader& root, Scenario& scenario, const std::string& folder) {
  if (root.has("controller")) {
    if (!scenario.motor.terms.empty())
      root.fault("motor",
                 "[motor.torque] is stated along with [controller]; keep one: kind = \"open_loop\" holds a torque over "
                 "time between samples");
    if (scenario.axis == Axis::linear)
      root.fault("controller", "[controller] needs a rotary axis; mesh.axis is \"linear\"");
    ControlReader(root, scenario, folder).read();
    return;
  }
  root.table("controller");
  for (const char* key : {"reference", "sensor", "disturbance", "metrics"})
    if (root.has(key)) {
      root.tables(key);
      root.fault(key, fmt::format("[{}] needs a [controller], but there is none", key));
    }
}

}  // namespace wormdrive
