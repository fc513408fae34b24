#include <filesystem>

#include <fmt/format.h>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "cli/report/kinds.hpp"
#include "description/diagnostics.hpp"
#include "output/replacing.hpp"
#include "output/text_file.hpp"
#include "sweep/file/so_far.hpp"

namespace wormdrive {
namespace {

struct ReportOptions {
  std::string file;
  std::string output;  ///< empty: named after the file
  Replace replace = Replace::same_kind;
};

/// What tells a page of this program, in cli/report/page.html.
constexpr std::string_view page_mark = R"(<meta name="generator" content="wormdrive">)";

int report_command(const ReportOptions& options) {
  const bool folder = std::filesystem::is_directory(options.file);
  const std::filesystem::path path =
      folder ? std::filesystem::path(options.file) / "diagnosis.h5" : std::filesystem::path(options.file);
  if (folder && !std::filesystem::exists(path))
    reject({options.file}, "contains no diagnosis.h5; wormdrive diagnose -o writes one");
  const SweepSoFar so_far(path.string());
  const ResultFile file(so_far.path());
  std::string output = options.output;
  if (output.empty() && folder) output = (std::filesystem::path(options.file) / "report.html").string();
  if (output.empty()) output = std::filesystem::path(path).replace_extension(".html").filename().string();
  reject_overwriting(output, path.string());

  reject_replacing_unmarked(followed(output), page_mark, options.replace);
  write_text_file(output, to_html(whole_page(file)));
  print_item("wrote", fmt::format("{}    open it in a browser", output));
  return 0;
}

}  // namespace

void add_report(CommandSet& commands) {
  auto [command, options] = commands.add("report", "write a result as one HTML page", report_command);
  command.add_option("file", options.file, "result (.h5), or the folder of a diagnosis")->required();
  command.add_option("-o,--output", options.output, "page; default: the result's name with .html");
  add_force(command, options.replace);
}

}  // namespace wormdrive
