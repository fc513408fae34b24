// Trials that run several at once are the trials that run alone.
#include <algorithm>
#include <cstring>
#include <map>

#include "catch.hpp"
#include "sweep/studies.hpp"
#include "sweep/study/load_study.hpp"
#include "sweep/trial.hpp"

namespace wormdrive::test::sweep_lanes {

TEST_CASE("rows are the same in lanes of any width and for each trial alone", "[sweep]") {
  const StudyFolder folder(lanes_study);
  const Study study = load_study(folder / "study.toml");
  Trials alone(study);
  REQUIRE(alone.together() > 1);
  std::map<TrialStatus, int> ended;
  for (const LaneKind kind : lane_kinds) {
    if (!is_available(kind)) continue;
    Trials trials(study, kind);
    const std::vector<Trial> rows = trials({0, 200});
    REQUIRE(rows.size() == 200);
    for (const Trial& row : rows) {
      const Trial one = alone(row.index);
      INFO("lanes " << lanes_of(kind) << ", trial " << row.index);
      REQUIRE(one.index == row.index);
      REQUIRE(one.status == row.status);
      REQUIRE(one.reason == row.reason);
      REQUIRE(one.parameters == row.parameters);
      REQUIRE(std::memcmp(one.metrics.data(), row.metrics.data(), one.metrics.size() * sizeof(double)) == 0);
      ++ended[row.status];
    }
  }
  CHECK(ended[TrialStatus::done] > 0);
  CHECK(ended[TrialStatus::refused] > 0);
  // what stands in the file are these rows
  REQUIRE(folder.sweep({"-o", "o.h5"}).exit == 0);
  const std::vector<double> rms = folder.column("o.h5", "error_rms");
  const std::size_t k = static_cast<std::size_t>(
      std::find_if(study.metrics.begin(), study.metrics.end(), [](const Metric& m) { return m.name == "error_rms"; }) -
      study.metrics.begin());
  for (const Trial& row : alone({0, 200}))
    if (row.status == TrialStatus::done) REQUIRE(row.metrics[k] == rms[row.index]);
}

}  // namespace wormdrive::test::sweep_lanes
