#include "sweep/file/merge.hpp"

#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/describe/drive.hpp"
#include "cli/replay_trial.hpp"
#include "cli/shell_words.hpp"

namespace wormdrive {

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

}  // namespace wormdrive
