#include <filesystem>

#include <fmt/format.h>

#include "cli/commands.hpp"
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

}  // namespace

int export_command(const ExportOptions& options) {
  const SweepSoFar so_far(options.file);
  const ResultFile result(so_far.path());
  const std::string kind = result.attribute("/", "kind");
  if (kind == "run") return export_run(result, options);
  if (kind == "sweep") return export_sweep(options);
  reject({options.file}, fmt::format("is a result of '{}'; wormdrive export takes that of a run or of a sweep", kind));
}

}  // namespace wormdrive
