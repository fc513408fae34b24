#include "events/timetable.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "catch.hpp"
#include "support.hpp"

namespace wormdrive::test::events_timetable {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

struct Due {
  double t;
  Reason reason;
};

/// Everything a timetable calls for up to its end, when each knot schedules the next of the given ones.
std::vector<Due> all_of(Timetable timetable, std::vector<double> knots = {}) {
  std::vector<Due> calls;
  while (true) {
    const double t = timetable.next_time();
    const Reason reason = timetable.pop();
    calls.push_back({t, reason});
    if (reason == Reason::end) return calls;
    if (reason == Reason::knot && !knots.empty()) {
      timetable.schedule_knot(knots.front());
      knots.erase(knots.begin());
    }
  }
}

std::vector<double> reports_of(const Timetable& timetable) {
  std::vector<double> times;
  for (const Due& due : all_of(timetable))
    if (due.reason == Reason::report) times.push_back(due.t);
  return times;
}

}  // namespace

TEST_CASE("a run begins with a knot, so that the inputs are taken up before anything moves") {
  Timetable timetable(-1.5, 2.0, 0.5);
  REQUIRE(timetable.next_time() == -1.5);
  REQUIRE(timetable.pop() == Reason::knot);
}

TEST_CASE("of what is due at one time a knot comes first, then the report, and the end swallows both") {
  const auto calls = all_of(Timetable(0.0, 1.0, 0.5), {0.5, 1.0});
  REQUIRE(calls.size() == 4);
  REQUIRE((calls[1].t == 0.5 && calls[1].reason == Reason::knot));
  REQUIRE((calls[2].t == 0.5 && calls[2].reason == Reason::report));
  REQUIRE((calls[3].t == 1.0 && calls[3].reason == Reason::end));
}

TEST_CASE("a sample comes after the knot it coincides with and before the report, and none is taken at the end") {
  const auto calls = all_of(Timetable(0.0, 1.0, 0.5, {.period = 0.5, .offset = 0.0}), {0.5});
  const std::vector<Reason> order{Reason::knot,   Reason::sample, Reason::knot,
                                  Reason::sample, Reason::report, Reason::end};
  REQUIRE(calls.size() == order.size());
  for (std::size_t k = 0; k < order.size(); ++k) REQUIRE(calls[k].reason == order[k]);
  REQUIRE((calls[3].t == 0.5 && calls[4].t == 0.5));
}

TEST_CASE("no solver may look past the next knot or the end, but past reports it may") {
  Timetable timetable(0.0, 1.0, 0.1);
  timetable.pop();
  REQUIRE(timetable.next_stop() == 1.0);
  timetable.schedule_knot(0.35);
  REQUIRE(timetable.next_time() == 0.1);
  REQUIRE(timetable.next_stop() == 0.35);
}

TEST_CASE("the k-th report is at begin + k interval, counted and not accumulated") {
  const auto times = reports_of(Timetable(0.25, 1000.25, 0.1));
  REQUIRE(times.size() == 9999);
  int wrong = 0;
  for (std::size_t k = 0; k < times.size(); ++k)
    if (times[k] != 0.25 + static_cast<double>(k + 1) * 0.1) ++wrong;
  REQUIRE(wrong == 0);
}

TEST_CASE("a report that rounding puts just before the end is the end's own row and not given twice") {
  // 3 * 0.7 is 2.0999999999999996; 3 * 0.1 is beyond 0.3
  REQUIRE(3 * 0.7 < 2.1);
  REQUIRE(reports_of(Timetable(0.0, 2.1, 0.7)).size() == 2);
  REQUIRE(3 * 0.1 > 0.3);
  REQUIRE(reports_of(Timetable(0.0, 0.3, 0.1)).size() == 2);
  for (int n = 1; n <= 2000; ++n)
    for (double interval : {0.1, 0.7, 1e-3, 1.0 / 3.0})
      REQUIRE(reports_of(Timetable(0.0, n * interval, interval)).size() == static_cast<std::size_t>(n - 1));
}

TEST_CASE("a run without reports has its end, and a report interval beyond the end changes nothing") {
  REQUIRE(all_of(Timetable(0.0, 1.0, never)).size() == 2);
  REQUIRE(all_of(Timetable(0.0, 1.0, 5.0)).size() == 2);
  REQUIRE(all_of(Timetable(-3.0, -2.0, never)).back().t == -2.0);
}

TEST_CASE("two times are one as far as 2 ulp, and no further") {
  const double eps = std::numeric_limits<double>::epsilon();
  REQUIRE(already_there(1.0, 1.0));
  REQUIRE(already_there(1.0, 1.0 + eps));
  REQUIRE(already_there(1.0, 1.0 + 2 * eps));
  REQUIRE_FALSE(already_there(1.0, 1.0 + 3 * eps));
  REQUIRE(already_there(1.0, 0.5));
  REQUIRE(already_there(1e6, 1e6 * (1 + eps)));
  REQUIRE_FALSE(already_there(0.0, 1e-300));
  REQUIRE(already_there(-1.0, -1.0 + eps));
  REQUIRE(already_there(0.3, 3 * 0.1));
}

TEST_CASE("a run reports each of its times once, though steps of the torque fall on them or an ulp beside") {
  const Signal motor{{Staircase{.rise = 0.01, .interval = 0.3, .start = 0.0}}};
  const auto r = run(drive(table1(), constant(0.02), motor), Timetable(0, 3, 0.1), {});
  std::vector<double> times;
  for (const auto& row : r.rows)
    if (times.empty() || row.now.t != times.back()) times.push_back(row.now.t);
  for (std::size_t k = 1; k < times.size(); ++k) REQUIRE(times[k] > times[k - 1]);
  for (int k = 1; k < 30; ++k) REQUIRE(std::count(times.begin(), times.end(), k * 0.1) == 1);
  REQUIRE(times.back() == 3.0);
}

TEST_CASE("a report that rounding keeps from a sample is on it") {
  const double period = 1e-3;
  const std::vector<double> reports = reports_of(Timetable(0.0, 2.0, 0.01, {period, 0.0}));
  REQUIRE(reports.size() == 199);
  for (std::size_t k = 0; k < reports.size(); ++k) REQUIRE(reports[k] == static_cast<double>(10 * (k + 1)) * period);
}

TEST_CASE("a timetable that skips to a sample goes on as the one that went there") {
  const Timetable whole(0.5, 3.0, 0.07, {0.03, 0.01});
  for (long sample : {0, 1, 29, 70}) {
    std::vector<Due> rest = all_of(whole);
    long taken = -1;
    while (taken < sample) {
      taken += rest.front().reason == Reason::sample;
      rest.erase(rest.begin());
    }
    Timetable skipped = whole;
    skipped.pop();
    skipped.skip_to_sample(sample);
    const auto calls = all_of(skipped);
    REQUIRE(calls.size() == rest.size());
    for (std::size_t k = 0; k < calls.size(); ++k)
      REQUIRE((calls[k].t == rest[k].t && calls[k].reason == rest[k].reason));
  }
}

}  // namespace wormdrive::test::events_timetable
