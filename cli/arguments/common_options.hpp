#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/scenario_options.hpp"
#include "output/replacing.hpp"
#include "statistics/threads.hpp"

namespace wormdrive {

/// A finite number that is greater than 0, or at least 0; CLI::PositiveNumber prints the largest double in full.
inline CLI::Validator finite_number(bool zero_too) {
  const std::string rule = zero_too ? "of at least 0" : "greater than 0";
  return CLI::Validator(
      [zero_too, rule](const std::string& text) {
        double value = 0.0;
        const bool read = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
        return read && (value > 0.0 || (zero_too && value == 0.0)) ? "" : "'" + text + "' is not a number " + rule;
      },
      zero_too ? "NOT NEGATIVE" : "POSITIVE");
}

/// An option that may be given several times, one value each.
inline void add_repeated(CLI::App& command, const std::string& name, std::vector<std::string>& values,
                         const std::string& type, const std::string& what) {
  command.add_option(name, values, what)->type_name(type)->take_all()->allow_extra_args(false);
}

inline void add_force(CLI::App& command, Replace& replace) {
  command.add_flag_callback(
      "--force", [&replace] { replace = Replace::anything; },
      "replace an existing file, even one that is not an older result of the same kind");
}

inline void add_quiet(CLI::App& command, bool& quiet) { command.add_flag("-q,--quiet", quiet, "print errors only"); }

inline void add_json(CLI::App& command, bool& json) { command.add_flag("--json", json, "print the result as JSON"); }

inline void add_threads(CLI::App& command, unsigned& threads) {
  command.add_option("--threads", threads, "number of threads; default: all cores")
      ->check(CLI::Range(1U, most_threads));
}

inline void add_scenario_options(CLI::App& command, ScenarioOptions& options) {
  command.add_option("scenario", options.file, "scenario (.toml), or a result that contains one (.h5)")->required();
  add_repeated(command, "--set", options.overrides, "KEY=VALUE",
               "override a key: --set motor.torque.amplitude_Nm=0.06; in one of several tables: --set "
               "motor.torque[1].amplitude_Nm=0.06; may be repeated");
  add_quiet(command, options.quiet);
  add_json(command, options.json);
}

/// Of a command that prints what it finds.
inline void add_optional_output(CLI::App& command, std::string& output) {
  command.add_option("-o,--output", output, "result file; default: none is written");
}

inline void add_max_load(CLI::App& command, std::optional<double>& max_load) {
  command
      .add_option("--max-load", max_load,
                  "largest load torque [N m]; default: 1.5 times that of the gravity arm or of the scenario's run")
      ->check(finite_number(false));
}

}  // namespace wormdrive
