#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/describe/drive.hpp"
#include "cli/report/kinds.hpp"
#include "cli/report/thinning.hpp"

namespace wormdrive {

ReportPage report_of_efficiency(const ResultFile& file) {
  const std::string table = "efficiency";
  const auto column = [&](const std::string& name) { return file.column(table + "/" + name); };
  const std::vector<double> speed = column("worm_speed"), load = column("load_torque"), share = column("efficiency"),
                            torque = column("motor_torque");
  // speed by speed, with the same loads at each
  const std::size_t loads = static_cast<std::size_t>(
      std::find_if(speed.begin(), speed.end(), [&](double s) { return s != speed.front(); }) - speed.begin());
  const std::size_t speeds = loads > 0 ? speed.size() / loads : 0;
  ReportPanel curves{{load.begin(), load.begin() + static_cast<std::ptrdiff_t>(loads)}, {}};
  ReportTable best{"At each speed",
                   {{"worm speed [rad/s]", true},
                    {"best efficiency [%]", true},
                    {"at a load torque of [N m]", true},
                    {"motor torque [N m]", true}},
                   {}};
  for (const std::size_t s : even_rows(speeds, 8)) {
    const auto begin = static_cast<std::ptrdiff_t>(s * loads), end = begin + static_cast<std::ptrdiff_t>(loads);
    curves.series.push_back({fmt::format("{:.4g} rad/s", speed[s * loads]),
                             "1",
                             "efficiency at this worm speed",
                             {share.begin() + begin, share.begin() + end}});
    const auto highest = std::max_element(share.begin() + begin, share.begin() + end, [](double a, double b) {
      return std::isnan(a) ? !std::isnan(b) : a < b;  // what is no number comes before all
    });
    const auto at = static_cast<std::size_t>(highest - share.begin());
    best.rows.push_back({speed[at], 100.0 * share[at], load[at], torque[at]});
  }
  ReportPage page;
  page.summary = describe_mesh(file.scenario());
  page.verdict =
      "What comes out over what goes in. Where load torque and speed have unlike signs the motor drives the "
      "load; elsewhere the load drives, and 0 means that the motor has to help it along.";
  page.groups.push_back({"", "load torque", "N m", {std::move(curves)}});
  page.tables.push_back(std::move(best));
  return page;
}

}  // namespace wormdrive
