#include "cli/describe/drive.hpp"
#include "cli/report/kinds.hpp"
#include "cli/report/thinning.hpp"

namespace wormdrive {

ReportPage report_of_statics(const ResultFile& file) {
  const Scenario scenario = file.scenario();
  const std::string table = "statics";
  const std::vector<double> load = file.column(table + "/load_torque");
  ReportPanel map{load, {}, ReportPanel::Style::lines, true};
  const bool wedge = file.attribute("/", "regime") == "worm self-locking";
  ReportTable torques{"Break-in torques",
                      {{"load torque [N m]", true},
                       {wedge ? "moves above [N m]" : "starts backward below [N m]", true},
                       {wedge ? "moves below [N m]" : "starts forward above [N m]", true},
                       {"flank changes at [N m]", true}},
                      {}};
  for (const std::string name : {"stick_low", "stick_high", "static_surface"}) {
    const std::string at = table + "/" + name;
    map.series.push_back({name, file.attribute(at, "units"), file.attribute(at, "long_name"), file.column(at)});
  }
  for (const std::size_t k : even_rows(load.size(), 11))
    torques.rows.push_back({load[k], map.series[0].values[k], map.series[1].values[k], map.series[2].values[k]});
  ReportPage page;
  page.summary = describe_mesh(scenario);
  page.verdict = wedge ? "Worm self-locking: between the two limits the load moves the gear, outside it is stuck."
                       : "Between the two limits (filled) the gear is stuck; a motor torque above them starts it "
                         "forward, one below them backward.";
  page.groups.push_back({"", "load torque", "N m", {std::move(map)}});
  page.tables.push_back(std::move(torques));
  return page;
}

}  // namespace wormdrive
