#include <filesystem>

#include <fmt/format.h>

#include "cli/report/kinds.hpp"
#include "description/diagnostics.hpp"
#include "description/warnings.hpp"

namespace wormdrive {
namespace {

struct KindOfPage {
  std::string_view name;
  ReportPage (*page)(const ResultFile&);
};
constexpr KindOfPage pages[] = {{"run", report_of_run},
                                {"statics", report_of_statics},
                                {"steady", report_of_steady},
                                {"efficiency", report_of_efficiency},
                                {"sweep", report_of_sweep},
                                {"rare", report_of_rare},
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

ReportPage whole_page(const ResultFile& file) {
  ReportPage page = page_of(file);
  const Scenario scenario = file.scenario();
  page.title = file.attribute("/", "title");
  page.tables.push_back(table_of("Parameters", parameters(scenario)));
  if (const auto list = derived(scenario); !list.empty()) page.tables.push_back(table_of("Derived quantities", list));
  page.tables.push_back(provenance(file));
  page.texts.push_back({"Scenario", file.attribute("/", "scenario")});
  for (const std::string& warning : warnings(scenario)) page.remarks.push_back(warning);
  return page;
}

}  // namespace wormdrive
