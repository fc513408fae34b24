#include <filesystem>

#include <fmt/format.h>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/commands/sweep/export_sweep.hpp"
#include "cli/describe/drive.hpp"
#include "cli/export/exported_table.hpp"
#include "description/diagnostics.hpp"
#include "output/replacing.hpp"
#include "output/text_file.hpp"
#include "sweep/file/so_far.hpp"

namespace wormdrive {
namespace {

/// "run.csv" for the trajectory, "run_events.csv" for the events.
std::string csv_file(const std::filesystem::path& output, const std::string& table) {
  if (table == "trajectory") return output.string();
  const std::string name = fmt::format("{}_{}{}", output.stem().string(), table, output.extension().string());
  return (output.parent_path() / name).string();
}

int export_run(const ResultFile& run, const ExportOptions& options) {
  if (!options.csv && !options.mat)
    reject({options.file}, "is a result of a run; --csv or --mat says how to export it");
  const std::filesystem::path beside(options.file);
  const std::string output =
      options.output.empty() ? std::filesystem::path(beside).replace_extension(options.mat ? ".mat" : ".csv").string()
                             : options.output;
  const std::vector<ExportedTable> tables = exported_tables(run);
  if (options.mat) {
    reject_replacing_unmarked(followed(output), mat_mark, options.replace);
    write_mat(output, tables, {{"title", run.attribute("/", "title")}, {"scenario", run.attribute("/", "scenario")}});
    print_item("wrote", output);
    return 0;
  }
  std::vector<std::pair<std::string, std::string>> files;
  for (const ExportedTable& table : tables) {
    files.emplace_back(csv_file(output, table.name), csv_of(table));
    const std::string& text = files.back().second;  // an older export begins with the same header
    reject_replacing_unmarked(followed(files.back().first), text.substr(0, text.find('\n')), options.replace);
  }
  for (const auto& [file, text] : files) {
    write_text_file(file, text);
    print_item("wrote", file);
  }
  return 0;
}

int export_command(const ExportOptions& options) {
  const SweepSoFar so_far(options.file);
  const ResultFile result(so_far.path());
  const std::string kind = result.attribute("/", "kind");
  if (kind == "run") return export_run(result, options);
  if (kind == "sweep") return export_sweep(options);
  reject({options.file}, fmt::format("is a result of '{}'; wormdrive export takes that of a run or of a sweep", kind));
}

}  // namespace

void add_export(CommandSet& commands) {
  auto [command, options] =
      commands.add("export", "write a run as CSV or as a MAT-file, or a sweep as CSV", export_command);
  command.add_option("file", options.file, "result of a run or of a sweep (.h5)")->required();
  CLI::Option& csv = *command.add_flag(
      "--csv", options.csv,
      "one file per table: NAME.csv has the trajectory, NAME_events.csv the events, NAME_controller.csv the "
      "samples of a controller; of a sweep one table");
  command.add_flag("--mat", options.mat, "a run as one file (MAT, version 5) with a struct per table")->excludes(&csv);
  command.add_option("--what", options.what, "which table of a sweep")
      ->check(CLI::IsMember({"trials", "summary"}))
      ->capture_default_str();
  command.add_option("-o,--output", options.output,
                     "file; default: the run's name with .csv or .mat, of a sweep standard output");
  command.add_option("--metric", options.metric,
                     "metric that ranks the parameters of a summary; default: as in summary");
  command.add_flag("--done-only", options.done_only, "leave refused and halted trials out of a summary");
  add_quiet(command, options.quiet);
  add_force(command, options.replace);
}

}  // namespace wormdrive
