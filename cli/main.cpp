#include <algorithm>
#include <csignal>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/arguments/command_set.hpp"
#include "cli/exit_code.hpp"
#include "cli/shell_words.hpp"
#include "description/keys.hpp"
#include "output/program.hpp"
#include "output/resource.hpp"

namespace {

using namespace wormdrive;

/// "wormdrive run 'my arm.toml'", as one could type it again.
std::string command_line(int argc, char** argv) {
  std::vector<std::string> words{"wormdrive"};
  for (int k = 1; k < argc; ++k) words.push_back(shell_word(argv[k]));
  return fmt::format("{}", fmt::join(words, " "));
}

/// The page that shows a command in ten lines; of any other the one that begins with the first run.
std::string first_page(std::string_view command) {
  if (command == "sweep") return documentation_page("howto/first_sweep.md");
  if (command == "diagnose") return documentation_page("howto/first_diagnosis.md");
  return documentation_page("howto/first_simulation.md");
}

/// Why the first word is no command; CLI11 takes a misspelled one for a superfluous argument.
std::optional<std::string> no_command(const std::vector<std::string>& names, int argc, char** argv) {
  if (argc < 2) return "wormdrive: error: a command is required; see wormdrive --help or " + first_page("");
  const std::string first = argv[1];
  if (first.starts_with('-') || std::find(names.begin(), names.end(), first) != names.end()) return std::nullopt;
  if (const auto meant = probably_meant(first, names))
    return fmt::format("wormdrive: error: unknown command '{}'; did you mean '{}'?", first, *meant);
  return fmt::format("wormdrive: error: unknown command '{}'; the commands are {}", first, fmt::join(names, ", "));
}

/// Help and version as CLI11 prints them; a fault on one line, with the command whose help has the answer.
int told(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  std::string command = "wormdrive";
  std::string page;
  for (const CLI::App* parsed : app.get_subcommands()) {
    command += " " + parsed->get_name();
    for (const std::string_view shown : {"run", "sweep", "diagnose"})
      if (parsed->get_name() == shown) page = " or " + first_page(shown);
  }
  std::cerr << fmt::format("{}: error: {}; see {} --help{}\n", command, error.what(), command, page);
  return bad_input;
}

/// All commands, in the order and under the headings of the help.
void add_all(CommandSet& commands) {
  commands.begin_group("Describe a drive");
  for (const auto add : {add_new, add_list, add_check, add_schema}) add(commands);
  commands.begin_group("Simulate it");
  for (const auto add : {add_run, add_view, add_statics, add_steady, add_efficiency, add_fmu}) add(commands);
  commands.begin_group("Look at results");
  for (const auto add : {add_plot, add_report, add_diff, add_export}) add(commands);
  commands.begin_group("Vary uncertain parameters");
  for (const auto add : {add_sweep, add_summary, add_worst, add_rare, add_replay, add_merge}) add(commands);
  commands.begin_group("Explain measured data");
  for (const auto add : {add_diagnose}) add(commands);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error that write() tells, not a death

  CLI::App app{"wormdrive: simulate, sweep and diagnose worm-gear drives", "wormdrive"};
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  app.get_formatter()->label("Positionals", "Arguments");
  app.set_help_flag("-h,--help", "print this help");
  app.set_version_flag("--version", build_description(), "print the version");
  app.require_subcommand(1);
  app.footer("wormdrive COMMAND --help explains a command. To start: wormdrive new my_drive.toml, or read\n" +
             first_page(""));
  CommandSet commands(app, command_line(argc, argv));
  add_all(commands);

  if (const auto fault = no_command(commands.names(), argc, argv)) {
    std::cerr << *fault << '\n';
    return bad_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return told(app, error);
  }
  return if_printed(guarded([&] { return commands.run(); }));
}
