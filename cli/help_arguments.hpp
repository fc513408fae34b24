#pragma once
#include <optional>

#include <CLI/CLI.hpp>

#include "cli/help_commands.hpp"

namespace wormdrive {

/// The option that every command with an output has.
inline void add_force(CLI::App& command, Replace& replace) {
  command.add_flag_callback(
      "--force", [&replace] { replace = Replace::anything; },
      "replace what is there, even if it is no older result of the same kind");
}

/// The commands that help with scenarios and results, as the command line states them.
class HelpArguments {
 public:
  /// not_negative: what a tolerance must be.
  HelpArguments(CLI::App& app, const CLI::Validator& not_negative) {
    schema_app_ = app.add_subcommand("schema", "print the JSON schema of scenarios, for editors");

    new_.kind = new_kinds().front();
    new_app_ = app.add_subcommand("new", "write a commented scenario, or a study for a sweep, to start from");
    new_app_->add_option("file", new_.file, "scenario or study to write (.toml)")->required();
    new_app_->add_option("--kind", new_.kind, "what it is about")
        ->check(CLI::IsMember(new_kinds()))
        ->capture_default_str();

    diff_app_ = app.add_subcommand(
        "diff", "compare two results by signal and event; exit code 0 if they agree, 1 if they differ");
    diff_app_->add_option("first", diff_.first, "result file (.h5)")->required();
    diff_app_->add_option("second", diff_.second, "result file (.h5)")->required();
    diff_app_
        ->add_option("--relative", diff_.relative, "difference allowed, as a share of the signal's largest magnitude")
        ->check(not_negative)
        ->capture_default_str();
    diff_app_->add_option("--absolute", diff_.absolute, "difference allowed beside, in the signal's units")
        ->check(not_negative)
        ->capture_default_str();
    diff_app_->add_option("--time", diff_.time, "difference allowed between the times of an event [s]")
        ->check(not_negative)
        ->capture_default_str();
    diff_app_->add_flag("-q,--quiet", diff_.quiet, "tell by the exit code only");
    diff_app_->add_flag("--json", diff_.json, "print the result as JSON");

    report_app_ = app.add_subcommand("report", "make one HTML page of a result, which needs no network");
    report_app_->add_option("file", report_.file, "result (.h5), or the folder of a diagnosis")->required();
    report_app_->add_option("-o,--output", report_.output, "page; default: the file's name with .html");
    add_force(*report_app_, report_.replace);
  }

  /// The exit code of the one that was typed; nothing if it was another.
  std::optional<int> run() const {
    if (schema_app_->parsed()) return schema_command();
    if (new_app_->parsed()) return new_command(new_);
    if (diff_app_->parsed()) return diff_command(diff_);
    if (report_app_->parsed()) return report_command(report_);
    return std::nullopt;
  }

 private:
  NewOptions new_;
  DiffOptions diff_;
  ReportOptions report_;
  CLI::App *schema_app_, *new_app_, *diff_app_, *report_app_;
};

}  // namespace wormdrive
