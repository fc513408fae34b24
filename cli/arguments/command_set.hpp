#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/commands.hpp"

namespace wormdrive {

/// The commands of the program: what each is called, what it takes, and what runs if it was typed.
class CommandSet {
 public:
  /// typed: the whole command line, which result files carry.
  CommandSet(CLI::App& app, std::string typed) : app_(app), typed_(std::move(typed)) {}

  /// Commands added from now on are listed under a heading of the help.
  void begin_group(const std::string& heading) { heading_ = heading; }

  CLI::App& add(const std::string& name, const std::string& what, std::function<int()> action) {
    CLI::App& command = *app_.add_subcommand(name, what)->group(heading_);
    commands_.emplace_back(&command, std::move(action));
    return command;
  }
  /// A command with its options, which live as long as the program needs them.
  template <class Options>
  std::pair<CLI::App&, Options&> add(const std::string& name, const std::string& what, int (*action)(const Options&)) {
    auto options = std::make_shared<Options>();
    Options& filled = *options;
    if constexpr (requires { filled.command_line; }) filled.command_line = typed_;
    if constexpr (requires { filled.scenario.command_line; }) filled.scenario.command_line = typed_;
    return {add(name, what, [options = std::move(options), action] { return action(*options); }), filled};
  }

  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& [command, action] : commands_) list.push_back(command->get_name());
    return list;
  }
  /// The exit code of the command that was typed.
  int run() const {
    for (const auto& [command, action] : commands_)
      if (command->parsed()) return action();
    return 0;
  }

 private:
  CLI::App& app_;
  std::string typed_, heading_;
  std::vector<std::pair<CLI::App*, std::function<int()>>> commands_;
};

}  // namespace wormdrive
