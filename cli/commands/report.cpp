#include <filesystem>

#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/describe/drive.hpp"
#include "cli/report/kinds.hpp"
#include "description/diagnostics.hpp"
#include "output/replacing.hpp"
#include "output/text_file.hpp"
#include "simulation/load_scenario.hpp"
#include "sweep/file/so_far.hpp"

namespace wormdrive {
namespace {

/// What tells a page of this program, in cli/report/page.html.
constexpr std::string_view page_mark = R"(<meta name="generator" content="wormdrive">)";

struct KindOfPage {
  std::string_view name;
  ReportPage (*page)(const ResultFile&);
};
constexpr KindOfPage pages[] = {{"run", report_of_run},
                                {"statics", report_of_statics},
                                {"steady", report_of_steady},
                                {"sweep", report_of_sweep},
                                {"diagnosis", report_of_diagnosis}};

ReportPage page_of(const ResultFile& file) {
  const std::string kind = file.attribute("/", "kind");
  for (const KindOfPage& known : pages)
    if (known.name == kind) return known.page(file);
  reject({file.path()}, fmt::format("is a result of '{}', for which there is no report", kind));
}

ReportTable provenance(const ResultFile& file) {
  ReportTable table{"Provenance", {{"what"}, {"which"}}, {}};
  table.rows.push_back({"file", std::filesystem::path(file.path()).filename().string()});
  for (const std::string name :
       {"command_line", "wormdrive_version", "commit", "sources", "libraries", "created", "solver"})
    if (const std::string text = file.attribute("/", name); !text.empty()) table.rows.push_back({words(name), text});
  return table;
}

}  // namespace

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

  ReportPage page = page_of(file);
  const Scenario scenario = load_scenario(file.path(), {}, Purpose::show);
  page.title = file.attribute("/", "title");
  page.tables.push_back(table_of("Parameters", parameters(scenario)));
  if (const auto list = derived(scenario); !list.empty()) page.tables.push_back(table_of("Derived quantities", list));
  page.tables.push_back(provenance(file));
  page.texts.push_back({"Scenario", file.attribute("/", "scenario")});
  for (const std::string& warning : warnings(scenario)) page.remarks.push_back(warning);
  reject_replacing_unmarked(followed(output), page_mark, options.replace);
  write_text_file(output, to_html(page));
  print_item("wrote", fmt::format("{}    open it in a browser", output));
  return 0;
}

}  // namespace wormdrive
