#include "cli/commands/diff/compare_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "output/trajectory.hpp"
#include "sweep/study/load_study.hpp"

namespace wormdrive {
namespace {

std::string event_name(double kind) {
  const auto k = static_cast<std::size_t>(kind);
  return k < event_kind_count ? std::string(name(event_kinds[k])) : fmt::format("kind {}", kind);
}

/// What the rows of a table stand over.
std::string over_words(const ComparedTable& table) {
  std::vector<std::string> names = table.over;
  names.insert(names.end(), table.over_texts.begin(), table.over_texts.end());
  return names.empty() ? "row" : fmt::format("{}", fmt::join(names, ", "));
}

/// A number or a whole number; none if the object has no such attribute.
std::optional<double> number_of(const ResultFile& file, const std::string& object, const std::string& name) {
  try {
    return file.number(object, name);
  } catch (const ReadFault&) {
  }
  try {
    return static_cast<double>(file.integer(object, name));
  } catch (const ReadFault&) {
    return std::nullopt;
  }
}

std::map<std::string, double> numbers_of(const ResultFile& file, const ComparedAttributes& attributes) {
  std::map<std::string, double> numbers;
  for (const std::string& name : attributes.numbers)
    if (const auto value = number_of(file, attributes.object, name)) numbers.emplace(name, *value);
  if (!attributes.numbers.empty()) return numbers;  // a file may have others, of whoever keeps it
  for (const auto& [name, value] : file.numbers(attributes.object))
    if (!is_detail(name)) numbers.emplace(name, value);
  return numbers;
}

class ResultComparer {
 public:
  ResultComparer(const ResultFile& a, const ResultFile& b, const DiffOptions& allowed)
      : a_(a), b_(b), allowed_(allowed) {}

  ResultComparison operator()() {
    tell_origins();
    if (a_.has("events") && b_.has("events")) compare_events();
    for (const ComparedTable& table : compared_tables) {
      if (a_.has(table.name) && b_.has(table.name))
        compare_table(table);
      else if (a_.has(table.name) || b_.has(table.name))
        tell_lacking(table.name, a_.has(table.name));
    }
    compare_attributes();
    return std::move(result_);
  }

 private:
  void tell_lacking(const std::string& what, bool first_has) {
    result_.faults.push_back(fmt::format("{}: in {} only", what, (first_has ? a_ : b_).path()));
  }

  /// Of what was estimated, which is no difference as long as the numbers agree.
  void tell_origins() {
    for (const char* const name : {"study", "settings"}) {
      const std::string in_a = a_.attribute("/", name), in_b = b_.attribute("/", name);
      if (in_a == in_b) continue;
      if (name != std::string("study"))
        result_.notes.push_back(fmt::format("the {} differ: {}, then {}", name, in_a, in_b));
      else if (const auto other = difference(in_a, in_b))
        result_.notes.push_back("the study differs in " + *other);
    }
  }

  /// One by one up to the first that is another one; what follows it is another course.
  void compare_events() {
    ComparedRows rows;
    rows.places.numbers = {a_.column("events/time")};
    const std::vector<double>& times = rows.places.numbers.front();
    const std::vector<double> others = b_.column("events/time");
    const std::vector<double> kinds = a_.column("events/kind"), other_kinds = b_.column("events/kind");
    if (times.size() != others.size())
      result_.faults.push_back(
          fmt::format("events: {} in the first result, {} in the second", times.size(), others.size()));
    for (std::size_t k = 0; k < std::min(times.size(), others.size()); ++k) {
      if (kinds[k] != other_kinds[k]) {
        result_.faults.push_back(
            fmt::format("event {}: {} at {:.9g} s in the first result, {} at {:.9g} s in the second", k + 1,
                        event_name(kinds[k]), times[k], event_name(other_kinds[k]), others[k]));
        break;
      }
      rows.pairs.emplace_back(k, k);
    }
    result_.events = rows.pairs.size();
    result_.signals.push_back(signal_difference("events/time", times, others, rows, allowed_));
    result_.signals.back().allowed = allowed_.time;
    const double late = result_.signals.back().largest;
    compare_columns("events", {"time", "kind"}, rows);
    if (late > 0.0 && late <= allowed_.time)
      for (SignalDifference& s : result_.signals) s.allowed += change_of(s.signal, late);
    event_times_ = times;
    event_times_.insert(event_times_.end(), others.begin(), others.end());
    std::sort(event_times_.begin(), event_times_.end());
  }

  /// What a column of /events may differ by because events are late, from the signal in /trajectory that it is of.
  double change_of(const std::string& path, double late) const {
    std::string name = path.substr(path.find('/') + 1);
    for (const std::string end : {"_before", "_after"})
      if (name.ends_with(end)) name.resize(name.size() - end.size());
    if (name == "acceleration") name = "gear_acceleration";
    for (const char* const none : {"time", "motion", "gear_motion", "flank"})  // flags do not change gradually
      if (name == none) return 0.0;
    const std::vector<std::string> there = a_.columns("trajectory");
    if (std::find(there.begin(), there.end(), name) == there.end()) return 0.0;
    return largest_change(a_.column("trajectory/time"), a_.column("trajectory/" + name), late);
  }

  /// An event may be late by less than is allowed: for so long the one result is before it and the other behind it.
  bool near_event(double time) const {
    const auto event = std::lower_bound(event_times_.begin(), event_times_.end(), time - allowed_.time);
    return event != event_times_.end() && *event <= time + allowed_.time;
  }

  void compare_table(const ComparedTable& table) {
    ComparedRows rows;
    rows.places = row_places(a_, table);
    const RowPlaces places = row_places(b_, table);
    PairedRows paired = paired_rows(rows.places, places);
    rows.pairs = std::move(paired.common);
    result_.tables.push_back({table.name, rows.pairs.size(), paired.first_only, paired.second_only});
    if (paired.first_only + paired.second_only > 0) {
      if (rows.pairs.empty())
        result_.faults.push_back(fmt::format("{}: no {} in common", table.name, over_words(table)));
      (table.over_time() ? result_.notes : result_.faults)
          .push_back(fmt::format("{}: {} row{} compared; {} in {} only, {} in {} only", table.name, rows.pairs.size(),
                                 rows.pairs.size() == 1 ? "" : "s", paired.first_only, a_.path(), paired.second_only,
                                 b_.path()));
    }
    if (table.over_time() && !rows.pairs.empty()) {
      const std::vector<double>& times = rows.places.numbers.front();
      if (const double end_a = times.back(), end_b = places.numbers.front().back();
          !(std::abs(end_a - end_b) <= allowed_.time))
        result_.faults.push_back(
            fmt::format("{}: ends at {:.9g} s in the first result, {:.9g} s in the second", table.name, end_a, end_b));
      for (const auto& [i, j] : rows.pairs) rows.left_out.push_back(near_event(times[i]));
    }
    compare_columns(table.name, {table.over.begin(), table.over.end()}, rows);
    for (const std::string& name : table.texts) compare_texts(table.name + "/" + name, rows);
  }

  /// The columns of numbers that are in both, but for those that say where a row stands.
  void compare_columns(const std::string& table, const std::set<std::string>& places, const ComparedRows& rows) {
    const std::vector<std::string> of_a = a_.columns(table), of_b = b_.columns(table);
    const auto has = [](const std::vector<std::string>& names, const std::string& name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const std::string& name : of_a) {
      const std::string path = table + "/" + name;
      if (!has(of_b, name)) {
        tell_lacking(path, true);
        continue;
      }
      if (const std::string in_a = a_.attribute(path, "units"), in_b = b_.attribute(path, "units"); in_a != in_b)
        result_.faults.push_back(
            fmt::format("{}: in '{}' in the first result, in '{}' in the second", path, in_a, in_b));
      if (!places.contains(name))
        result_.signals.push_back(signal_difference(path, a_.column(path), b_.column(path), rows, allowed_));
    }
    for (const std::string& name : of_b)
      if (!has(of_a, name)) tell_lacking(table + "/" + name, false);
  }

  void compare_texts(const std::string& path, const ComparedRows& rows) {
    const std::vector<std::string> of_a = a_.texts(path), of_b = b_.texts(path);
    std::vector<std::pair<std::size_t, std::size_t>> others;
    for (const auto& [i, j] : rows.pairs)
      if (of_a[i] != of_b[j]) others.emplace_back(i, j);
    if (others.empty()) return;
    const auto [i, j] = others.front();
    result_.faults.push_back(fmt::format("{}: {} text{} differ{}; at {}: '{}' in the first result, '{}' in the second",
                                         path, others.size(), others.size() == 1 ? "" : "s",
                                         others.size() == 1 ? "s" : "", in_words(rows.places[i]), of_a[i], of_b[j]));
  }

  void compare_attributes() {
    for (const ComparedAttributes& attributes : compared_attributes) {
      const std::string& object = attributes.object;
      if (object != "/" && !(a_.has(object) && b_.has(object))) continue;
      for (const std::string& name : attributes.texts)
        if (const std::string in_a = a_.attribute(object, name), in_b = b_.attribute(object, name); in_a != in_b)
          result_.faults.push_back(fmt::format("{}: '{}' in the first result, '{}' in the second",
                                               attribute_name(object, name), in_a, in_b));
      compare_numbers(attributes);
    }
  }

  void compare_numbers(const ComparedAttributes& attributes) {
    const std::string& object = attributes.object;
    const std::map<std::string, double> of_a = numbers_of(a_, attributes), of_b = numbers_of(b_, attributes);
    for (const auto& [name, value] : of_a) {
      const std::string attribute = attribute_name(object, name);
      const auto other = of_b.find(name);
      if (other == of_b.end()) {
        tell_lacking(attribute, true);
        continue;
      }
      SignalDifference found = signal_difference(attribute, {value}, {other->second}, {{}, {{0, 0}}}, allowed_);
      found.attribute = true;
      found.allowed = std::min(found.allowed + allowed_beside_size(name), std::numeric_limits<double>::max());
      result_.signals.push_back(found);
    }
    for (const auto& [name, value] : of_b)
      if (!of_a.contains(name)) tell_lacking(attribute_name(object, name), false);
  }

  /// Of a number that follows from others.
  double allowed_beside_size(const std::string& name) const {
    if (name.starts_with("time_"))  // a sum of times between events, each of which may be late
      return allowed_.time * static_cast<double>(result_.events);
    double size = 0.0;
    for (const auto& [begin, column] : following_numbers)
      if (name.starts_with(begin))
        for (const ResultFile* file : {&a_, &b_})
          for (const double value : file->column(column))
            if (std::isfinite(value)) size = std::max(size, std::abs(value));
    return allowed_.relative * size;
  }

  static std::string attribute_name(const std::string& object, const std::string& name) {
    return object == "/" ? name : fmt::format("{} of {}", name, object);
  }

  const ResultFile &a_, &b_;
  const DiffOptions& allowed_;
  std::vector<double> event_times_;  ///< of both results, in order
  ResultComparison result_;
};

}  // namespace

std::size_t ResultComparison::rows() const {
  return std::accumulate(tables.begin(), tables.end(), std::size_t{0},
                         [](std::size_t sum, const TableRows& table) { return sum + table.common; });
}

bool ResultComparison::differs() const {
  return !faults.empty() || std::any_of(signals.begin(), signals.end(), [](const auto& s) { return s.too_large(); });
}

ResultComparison compare_results(const ResultFile& a, const ResultFile& b, const DiffOptions& allowed) {
  return ResultComparer(a, b, allowed)();
}

}  // namespace wormdrive
