#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "catch.hpp"
#include "judge/judge.hpp"
#include "judge/shadow.hpp"
#include "near_ties/generator.hpp"
#include "near_ties/verdict.hpp"

// Drives in which something just touches something else, or misses it by a rounding: every solver finds the same
// events, and arithmetic in 128 bits contradicts none of them. `near_ties_campaign` runs them by the hundred thousand.

namespace wormdrive::test::property_near_ties {

using namespace near_ties;

TEST_CASE("near ties: 300 random drives at the edge of an event end as they must, by every solver", "[slow]") {
  std::map<Verdict, int> verdicts;
  std::string faults;
  for (std::uint64_t index = 0; index < 300; ++index) {
    const Case tie = make_case(1, index);
    const Judgement found = judgement(tie, index % 3 == 0);
    ++verdicts[found.verdict];
    if (found.reason.empty()) continue;
    faults += "case " + std::to_string(index) + ", " + tie.tie + ": " + found.reason + "\n";
  }
  INFO(faults);
  CHECK(verdicts[Verdict::silent] == 0);
  CHECK(verdicts[Verdict::halt] == 0);
  CHECK(verdicts[Verdict::undecided] == 0);
  CHECK(verdicts[Verdict::rounding] <= 30);
}

TEST_CASE("near ties: what starts by less than its rounding starts, and goes on") {
  for (const std::uint64_t index : {5736, 7227}) {  // elastic teeth under a load at its crest, with and without a gap
    const Judgement found = judgement(make_case(78, index), false);
    INFO("case " << index << ": " << found.reason);
    CHECK((found.verdict == Verdict::agree || found.verdict == Verdict::rounding));
  }
  // friction that falls so fast that a rounding grows within nanoseconds
  const ProgramRun fast = near_ties::run(make_case(92, 6202), near_ties::By::taylor);
  CHECK(fast.halt.empty());
  CHECK(fast.omega < -1e6);
}

TEST_CASE(
    "a bearing that pushes alike in both directions is a constant torque, with elastic teeth and with rigid ones") {
  int moved = 0;
  for (std::uint64_t index = 0; index < 60; ++index) {
    Case bearing = make_case(101, index);
    if (!bearing.drive.teeth) continue;
    bearing.drive.worm_coulomb.reset();
    bearing.drive.torque_gain.reset();
    double size = 0.0;
    for (const judge::Term& term : bearing.drive.motor)
      if (term.kind != judge::Term::Kind::ramp) size += 0.5 * std::abs(term.size);
    Case constant = bearing;
    bearing.drive.bearing_asymmetry = judge::BearingAsymmetry{index % 2 == 0 ? size : -size, 0.0};
    constant.drive.bearing_asymmetry.reset();
    constant.drive.motor.push_back(judge::constant(-bearing.drive.bearing_asymmetry->torque));

    const ProgramRun pushed = near_ties::run(bearing, near_ties::By::bdf);
    const ProgramRun shifted = near_ties::run(constant, near_ties::By::bdf);
    INFO("case " << index << (bearing.elastic ? ", elastic" : ", rigid") << ": " << pushed.halt << shifted.halt);
    REQUIRE(pushed.reports.size() == shifted.reports.size());
    double way = 0.0, apart = 0.0;
    for (std::size_t row = 0; row < pushed.reports.size(); ++row) {
      const std::size_t gear = pushed.reports[row].size() - 2;
      way = std::max(way, std::abs(shifted.reports[row][gear] - shifted.reports[0][gear]));
      apart = std::max(apart, std::abs(pushed.reports[row][gear] - shifted.reports[row][gear]));
    }
    moved += way > 1e-6;
    CHECK(apart <= 1e-5 * way + 1e-12);
  }
  CHECK(moved >= 30);
}

TEST_CASE("the judge of near ties has the events of fig. 9 to the last digit, and objects to a missed or a late one") {
  judge::Drive drive;
  drive.lambda = 4 * (std::numbers::pi / 180);
  drive.phi_n = 20 * (std::numbers::pi / 180);
  drive.lw = 0.011;
  drive.lg = 0.045;
  drive.mu = 0.25;
  drive.Jw = 2.53e-5;
  drive.Jg = 7.39e-4;
  drive.arm = judge::GravityArm{0.0196, 0.0, 0.0};
  drive.motor = {judge::sinusoid(0.05, 1.5, 90 * (std::numbers::pi / 180))};
  drive.end = 2.0;
  judge::Judge<judge::Quad> judge(drive);
  REQUIRE(judge.run().size() == 12);
  REQUIRE(judge.events[0].t == 0.0034812139114724669);
  REQUIRE(judge.events[11].t == 1.9383624501092305);
  REQUIRE(static_cast<double>(judge.course().theta) == -5.4068889175374455);

  std::vector<judge::Event> events(judge.events.begin(), judge.events.end());
  REQUIRE(judge::Shadow(drive, {}).contradiction(judge.start, events).empty());
  const auto complaint = [&](const std::vector<judge::Event>& wrong) {
    return judge::Shadow(drive, {}).contradiction(judge.start, wrong);
  };
  for (std::size_t k = 0; k < events.size(); ++k) {  // one is missed, with the other that it belongs to
    auto missed = events;
    missed.resize(k);
    REQUIRE_FALSE(complaint(missed).empty());
    auto late = events;
    late[k].t += 1e-6;
    REQUIRE_FALSE(complaint(late).empty());
  }
}

}  // namespace wormdrive::test::property_near_ties
