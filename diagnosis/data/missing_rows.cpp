#include "diagnosis/data/missing_rows.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/data/prepared_recording.hpp"
#include "diagnosis/data/sample_times.hpp"
#include "diagnosis/rules/recordings.hpp"

namespace wormdrive {
namespace {

using Times = std::vector<double>;

void refuse_disorder(const RecordedTable& table) {
  const Times& t = table.time.values;
  const std::string& name = table.time.name;
  if (t.front() < 0.0)
    reject(table.where(0), fmt::format("{} = {} is negative; count time from the first sample on", name, t.front()));
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (t[k] == t[k - 1]) reject(table.where(k), fmt::format("{} = {} stands twice in a row", name, t[k]));
    if (t[k] < t[k - 1]) reject(table.where(k), fmt::format("{} = {} is before {}", name, t[k], t[k - 1]));
  }
}

long periods(double step, double period) {
  constexpr double most = 1e9;  // more would be no number of rows
  return std::max(1L, std::lround(std::min(step / period, most)));
}

/// The mean of the steps over which no row is missing. Such a step is also the one that a quarter of all fall short of,
/// as long as no more is missing than there.
double usual_step(const Times& t) {
  Times steps;
  for (std::size_t k = 1; k < t.size(); ++k) steps.push_back(t[k] - t[k - 1]);
  const auto quarter = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 4);
  std::nth_element(steps.begin(), quarter, steps.end());
  double usual = *quarter;
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    double sum = 0.0, count = 0.0;
    for (const double step : steps)
      if (periods(step, usual) == 1) {
        sum += step;
        count += 1.0;
      }
    usual = sum / count;
  }
  return usual;
}

/// Of stamps at random, half of the steps lie within a quarter of a period of a whole number of them.
void refuse_no_rate(const RecordedTable& table, double usual) {
  const Times& t = table.time.values;
  double within = 0.0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double step = (t[k] - t[k - 1]) / usual;
    within += std::abs(step - static_cast<double>(periods(step, 1.0))) < rules::near_whole_step ? 1.0 : 0.0;
  }
  if (const double share = within / static_cast<double>(t.size() - 1); share < rules::least_whole_steps)
    reject(table.where(), fmt::format("{} shows no rate: only {:.0f} % of its steps are within a quarter of {:.3g} s "
                                      "or of a multiple of it",
                                      table.time.name, 100.0 * share, usual));
}

/// How many rows are missing, and since when.
struct Count {
  std::size_t bridged = 0, in_pauses = 0;
  std::size_t first = 0;  ///< row after the first of them, as the file counts; 0: none is missing

  std::size_t all() const { return bridged + in_pauses; }
};

std::string told(const RecordedTable& table, const Count& missing, double step) {
  const Times& t = table.time.values;
  if (missing.all() > t.size())
    reject(table.where(missing.first),
           fmt::format("{} rows of {:.3g} s are missing, more than the {} that are there; the first after {} = {:.9g}",
                       missing.all(), step, t.size(), table.time.name, t[missing.first - 1]));
  std::string text = fmt::format("{} of {} rows are missing, the first after {:.9g} s", missing.all(),
                                 missing.all() + t.size(), t[missing.first - 1]);
  if (table.has_lines) text += fmt::format(" (line {})", table.where(missing.first).line);
  if (missing.bridged > 0) text += fmt::format("; {} of them are bridged", missing.bridged);
  if (const std::size_t pauses = table.restarts.size(); pauses > 0)
    text += fmt::format("; the prediction starts anew after {} of them in {}", missing.in_pauses,
                        pauses == 1 ? "a pause" : fmt::format("{} pauses", pauses));
  return text;
}

}  // namespace

MissingRows bridge_missing_rows(RecordedTable& table) {
  const Times t = table.time.values;
  const std::string& name = table.time.name;
  if (t.size() < rules::least_samples)
    reject(table.where(), fmt::format("{} samples; a diagnosis needs at least {}", t.size(), rules::least_samples));
  refuse_disorder(table);
  MissingRows found{usual_step(t), {1}, {}};
  if (found.step > rules::longest_period * (1.0 + rules::even_enough))  // decimals of stamps round
    reject(table.where(), fmt::format("{} has steps of {:.3g} s; a diagnosis needs at most {} s (is {} in seconds?)",
                                      name, found.step, rules::longest_period, name));
  refuse_no_rate(table, found.step);

  // over this time the speed is taken for even as well; one row is bridged always
  const auto longest = std::max(1L, std::lround(rules::slope_half_width / found.step));
  std::vector<std::uint32_t> lines{table.where(0).line};
  Count missing;
  std::vector<RecordedValues*> columns;
  for (RecordedValues* c : {&table.time, &table.torque, &table.angle, &table.worm_angle, &table.speed})
    if (!c->values.empty()) columns.push_back(c);
  std::vector<std::vector<double>> filled;
  for (const RecordedValues* c : columns) filled.push_back({c->values.front()});
  for (std::size_t k = 1; k < t.size(); ++k) {
    const long all = periods(t[k] - t[k - 1], found.step);
    const bool bridges = all - 1 <= longest;
    if (all > 1 && missing.first == 0) missing.first = k;
    (bridges ? missing.bridged : missing.in_pauses) += static_cast<std::size_t>(all - 1);
    if (!bridges) table.restarts.push_back(lines.size());
    for (long j = bridges ? 1 : all; j <= all; ++j) {
      const double share = static_cast<double>(j) / static_cast<double>(all);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const double before = columns[c]->values[k - 1], after = columns[c]->values[k];
        filled[c].push_back(j == all ? after : before + share * (after - before));
      }
      lines.push_back(table.where(k).line);
      found.there.push_back(j == all ? 1 : 0);
    }
  }
  if (missing.first == 0) return found;
  found.remark = told(table, missing, found.step);
  for (std::size_t c = 0; c < columns.size(); ++c) columns[c]->values = std::move(filled[c]);
  table.lines = std::move(lines);
  return found;
}

}  // namespace wormdrive
