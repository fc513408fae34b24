// Of recordings that are longer than a search for causes needs, it takes pieces from all of their time.
#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/recordings.hpp"
#include "diagnosis/representative_pieces.hpp"
#include "numbers.hpp"

namespace wormdrive::test::diagnosis_long_recordings {

namespace {

/// 200 s at 100 Hz that move between 33 s and 38 s, and from 120 s on.
Recording log_of_a_shift() {
  Recording r;
  r.name = "shift";
  r.start = 5.0;
  r.period = 0.01;
  for (int k = 0; k < 20000; ++k) {
    const double t = 0.01 * k;
    const bool moves = (t > 33.0 && t < 38.0) || t > 120.0;
    r.gear_angle.push_back(moves ? std::sin(t) : 0.0);
    r.motor_torque.push_back(0.001 * k);
    r.valid.push_back(k % 7 != 0);
  }
  r.restarts = {3500, 19990};
  return r;
}

/// Whether every sample of a piece is one of the whole.
void check_cut(const Recording& cut, const Recording& whole) {
  REQUIRE(cut.times.size() == cut.samples());
  REQUIRE(cut.valid.size() == cut.samples());
  for (std::size_t k = 0; k < cut.samples(); ++k) {
    const auto there = static_cast<std::size_t>(std::lround((cut.start + cut.time(k) - whole.start) / whole.period));
    REQUIRE(close(cut.start + cut.time(k), whole.start + whole.time(there), 1e-12));
    REQUIRE(cut.gear_angle[k] == whole.gear_angle[there]);
    REQUIRE(cut.motor_torque[k] == whole.motor_torque[there]);
    REQUIRE(cut.valid[k] == whole.valid[there]);
    const bool follows = k > 0 && cut.time(k) - cut.time(k - 1) < 1.5 * whole.period;
    const bool restarts = std::binary_search(cut.restarts.begin(), cut.restarts.end(), k);
    const bool restarted = std::binary_search(whole.restarts.begin(), whole.restarts.end(), there);
    REQUIRE(restarts == (k > 0 && (!follows || restarted)));
  }
}

}  // namespace

TEST_CASE("the pieces of a long recording are from all of its time, and where the gear moves") {
  const Recording whole = log_of_a_shift();
  const Recording cut = representative_pieces({whole}, 4000).front();
  CHECK(cut.samples() == 4000);
  CHECK(cut.name == "shift");
  CHECK(cut.period == 0.01);
  check_cut(cut, whole);
  std::vector<int> of_section(4);
  int moving = 0;
  for (std::size_t k = 0; k < cut.samples(); ++k) {
    const double t = cut.start + cut.time(k) - 5.0;
    ++of_section[static_cast<std::size_t>((t + 0.005) / 50.0)];
    moving += t > 33.005 && t < 37.995;
  }
  CHECK(of_section == std::vector<int>(4, 1000));
  CHECK(moving == 499);
}

TEST_CASE("recordings that a search can take are left as they are, several share what it takes") {
  const Recording whole = log_of_a_shift();
  CHECK(representative_pieces({whole}).front().times.empty());
  CHECK(representative_pieces({whole}, 20000).front().gear_angle == whole.gear_angle);
  Recording other = whole;
  other.gear_angle.resize(10000);
  other.motor_torque.resize(10000);
  other.valid.resize(10000);
  other.restarts = {3500};
  const std::vector<Recording> both = representative_pieces({whole, other}, 6000);
  CHECK(both[0].samples() == 4000);
  CHECK(both[1].samples() == 2000);
  check_cut(both[0], whole);
  check_cut(both[1], other);
}

TEST_CASE("pieces of a recording show what the whole of it shows", "[slow]") {
  Scenario drive = nominal_arm();
  set_field(drive.effects, {"worm_viscous", "coefficient", 1e-4});
  const Recording whole = record(drive, {.duration = 30.0});
  const Recording cut = representative_pieces({whole}, 10000).front();
  CHECK(cut.samples() == 10000);
  const Diagnosis d = diagnose(nominal_arm(), {cut});
  INFO(d.sentence);
  REQUIRE(d.causes.size() == 1);
  CHECK(d.causes.front().effect == "worm_viscous");
  CHECK(d.causes.front().parameters.front().low <= 1e-4);
  CHECK(d.causes.front().parameters.front().high >= 1e-4);
}

}  // namespace wormdrive::test::diagnosis_long_recordings
