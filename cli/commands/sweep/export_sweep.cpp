#include "cli/commands/sweep/export_sweep.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "cli/describe/drive.hpp"
#include "description/diagnostics.hpp"
#include "output/replacing.hpp"
#include "output/text_file.hpp"
#include "simulation/overwriting.hpp"
#include "sweep/file/so_far.hpp"
#include "sweep/summary/csv_tables.hpp"

namespace wormdrive {

int export_sweep(const ExportOptions& options) {
  if (options.mat) reject({options.file}, "is a result of a sweep, which is exported as CSV");
  if (!options.output.empty()) reject_overwriting(options.output, options.file);
  const SweepSoFar so_far(options.file);
  const SweepReader sweep(so_far.path());
  const auto write = [&](const std::function<void(std::string_view)>& put) {
    if (options.what == "trials")
      write_trials_csv(sweep, put);
    else
      put(summary_csv(sweep, summary_of(sweep, {.ranked_by = options.metric, .done_only = options.done_only})));
  };
  if (options.output.empty()) {
    write([](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); });
    return 0;
  }
  reject_replacing_unmarked(followed(options.output), options.what == "trials" ? trials_csv_mark : summary_csv_header,
                            options.replace);
  write_text_file(options.output, write);
  if (!options.quiet)
    print_item("wrote", fmt::format("{}    {} of {} trials", options.output, sweep.trials(), sweep.range().size()));
  return 0;
}

}  // namespace wormdrive
