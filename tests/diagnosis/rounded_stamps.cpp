#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <fmt/format.h>

#include "catch.hpp"
#include "diagnosis/data/sample_times.hpp"
#include "recovery/campaign.hpp"

// Stamps of an even clock that are written with few digits: what is left of them is no jitter.

namespace wormdrive::test::diagnosis_rounded_stamps {

namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
double by_ratio(Random& random, double low, double high) {
  return low * std::pow(high / low, between(random, 0.0, 1.0));
}

RecordedTable table_of(std::vector<double> stamps) {
  RecordedTable table;
  table.path = "log.csv";
  table.time = {"time_s", 1.0, std::move(stamps)};
  return table;
}

/// As a program writes a number that has so many digits for it: significant ones, or behind the point.
double written(double t, int digits, bool significant) {
  return std::stod(significant ? fmt::format("{:.{}g}", t, digits) : fmt::format("{:.{}f}", t, digits));
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

}  // namespace

TEST_CASE("stamps of any even clock come back from few digits, from single precision, and beside missing rows") {
  Random random(7);
  int rounded = 0, fine = 0, incomplete = 0;
  for (int k = 0; k < 400; ++k) {
    const double period = by_ratio(random, 1e-4, 2e-2), start = k % 2 == 0 ? 0.0 : by_ratio(random, 0.1, 1e4);
    const auto rows = static_cast<std::size_t>(by_ratio(random, 1500, 20000));
    const int kind = k % 3, digits = std::uniform_int_distribution<int>(kind == 0 ? 4 : 2, 7)(random);
    const double lost = k % 4 == 3 ? 0.01 : 0.0;
    std::vector<double> clock, stamps;
    for (std::size_t row = 0; row < rows; ++row) {
      if (row > 0 && between(random, 0.0, 1.0) < lost) continue;
      clock.push_back(start + static_cast<double>(row) * period);
      stamps.push_back(kind == 2 ? static_cast<double>(static_cast<float>(clock.back()))
                                 : written(clock.back(), digits, kind == 0));
    }
    const double off = largest_difference(clock, stamps);
    if (off > 0.3 * period && lost > 0.0) continue;  // where a row is missing cannot be told
    if (off > 20.0 * period) continue;               // as many rows have one stamp
    INFO(fmt::format("{} rows of {:.6g} s from {:.6g} s, off by {:.3g} s, kind {}, {} digits", clock.size(), period,
                     start, off, kind, digits));
    RecordedTable table = table_of(stamps);
    const auto remark = even_out_rounded_stamps(table);
    if (remark) {
      REQUIRE(remark->ends_with("taken for even"));
      REQUIRE(largest_difference(clock, table.time.values) <= 0.8 * off);
      const double step = (table.time.values.back() - table.time.values.front()) / (clock.back() - clock.front());
      REQUIRE(std::abs(step - 1.0) * static_cast<double>(rows) * period < 1.2 * off);
      ++rounded;
      incomplete += lost > 0.0 ? 1 : 0;
    } else {
      REQUIRE(off <= 0.0201 * period);
      REQUIRE(table.time.values == stamps);
      ++fine;
    }
  }
  CHECK(rounded > 80);
  CHECK(incomplete > 10);
  CHECK(fine > 80);
}

TEST_CASE("stamps that are late by more than their digits are no rounded ones") {
  Random random(8);
  for (int k = 0; k < 100; ++k) {
    const double period = by_ratio(random, 1e-4, 2e-2), jitter = by_ratio(random, 0.05, 0.2);
    const int digits = static_cast<int>(std::ceil(-std::log10(0.1 * jitter * period)));
    std::vector<double> stamps;
    for (int row = 0; row < 3000; ++row)
      stamps.push_back(written((static_cast<double>(row) + between(random, 0.0, jitter)) * period, digits, false));
    RecordedTable table = table_of(stamps);
    REQUIRE(!even_out_rounded_stamps(table));
    REQUIRE(table.time.values == stamps);
  }
}

TEST_CASE("a recording at 4 kHz whose times have four decimals is one at 4 kHz") {
  const recovery::Case drawn{recovery::Kind::nothing, recovery::conditions("realistic"), 29, {}, 12.0, 2.5e-4};
  const Recording r = recovery::record(drawn).recording;
  CHECK(r.times.empty());
  CHECK(std::abs(r.period - 2.5e-4) < 1e-10);
  REQUIRE(r.remarks.size() == 1);
  CHECK(r.remarks[0] == "the sample times are rounded to 0.0001 s, of steps of 0.00025 s; taken for even");
}

}  // namespace wormdrive::test::diagnosis_rounded_stamps
