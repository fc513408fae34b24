// The studies behind docs/robustness.md, each with a few of its drives.
#include <algorithm>

#include "catch.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_robustness {

namespace {

constexpr double guaranteed = 0.6 / 94.24777960769379, sharp = guaranteed / 2.718281828459045;  // 2 Phi/lambda_c [rad]

StudyFolder few_drives(const std::string& name) {
  std::ifstream file(shipped("studies/robustness_" + name + ".toml"));
  const std::string study((std::istreambuf_iterator<char>(file)), {});
  return StudyFolder(edited(edited(study, "trials = 100000", "trials = 64"), "../fig10", shipped("fig10")));
}

}  // namespace

TEST_CASE("under the paper's variations every drive keeps what Lemma 1 guarantees, the PID too", "[sweep]") {
  for (const char* name : {"sliding", "pid"}) {
    const StudyFolder folder = few_drives(name);
    const Outcome outcome = folder.sweep({"-o", "o.h5", "--referee", "1"});
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.exit == 0);
    for (const double status : folder.column("o.h5", "status")) CHECK(status == 1.0);
    for (const double error : folder.column("o.h5", "error_max")) CHECK(error < sharp);
  }
}

TEST_CASE("far beyond the paper's variations not every sliding controller keeps the guarantee", "[sweep]") {
  for (const std::string name : {"sliding_beyond", "pid_beyond"}) {
    const StudyFolder folder = few_drives(name);
    const Outcome outcome = folder.sweep({"-o", "o.h5", "--referee", "1"});
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.exit == 0);
    const std::vector<double> status = folder.column("o.h5", "status"), error = folder.column("o.h5", "error_max");
    long kept = 0;
    for (std::size_t k = 0; k < status.size(); ++k) kept += status[k] == 1.0 && error[k] <= guaranteed;
    CHECK(kept > 48);
    if (name == "sliding_beyond") CHECK(kept < 64);
  }
}

}  // namespace wormdrive::test::sweep_robustness
