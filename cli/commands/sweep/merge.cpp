#include "sweep/file/merge.hpp"

#include <fmt/format.h>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "cli/replay_trial.hpp"
#include "cli/shell_words.hpp"

namespace wormdrive {
namespace {

struct MergeOptions {
  std::vector<std::string> shards;
  std::string output;
  Replace replace = Replace::same_kind;
  bool quiet = false;
  std::string command_line;
};

int merge_command(const MergeOptions& options) {
  for (const std::string& shard : options.shards) reject_overwriting(options.output, shard);
  const std::string output = followed(options.output);
  const std::uint64_t trials =
      merge_shards(options.shards, output, OutputLock(output), options.command_line, options.replace);
  keep_trajectories(output, options.command_line, options.quiet, options.replace);
  if (options.quiet) return 0;
  print_item("merged", fmt::format("{} shards, {} trials", options.shards.size(), trials));
  print_item("wrote", fmt::format("{}    see it: wormdrive summary {}", options.output, shell_path(options.output)));
  return 0;
}

}  // namespace

void add_merge(CommandSet& commands) {
  auto [command, options] = commands.add("merge", "combine the shards of a sweep into one result", merge_command);
  command.add_option("shards", options.shards, "all shards of one sweep (.h5), in any order")->required();
  command.add_option("-o,--output", options.output, "result file")->required();
  add_quiet(command, options.quiet);
  add_force(command, options.replace);
}

}  // namespace wormdrive
