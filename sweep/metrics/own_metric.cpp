#include "sweep/metrics/own_metric.hpp"

#include <algorithm>
#include <limits>

#include "output/run_columns.hpp"
#include "simulation/write_run.hpp"

namespace wormdrive {
namespace {

double value_of(const ValueAt& metric, const Course& course) { return course.at(metric.time); }
double value_of(const Minimum&, const Course& course) { return course.least(); }
double value_of(const Maximum&, const Course& course) { return course.greatest(); }
double value_of(const PeakToPeak&, const Course& course) { return course.greatest() - course.least(); }
double value_of(const Mean&, const Course& course) { return course.mean(); }
double value_of(const RootMeanSquare&, const Course& course) { return course.root_mean_square(); }
double value_of(const Integral&, const Course& course) { return course.integral(); }
double value_of(const TimeQuantile& metric, const Course& course) { return course.quantile(metric.share); }
double value_of(const CrossingTime& metric, const Course& course) {
  return course.crossing(metric.level, metric.rising, metric.falling, metric.number);
}
double value_of(const SettlingTime& metric, const Course& course) {
  return course.settling(metric.target.value_or(course.points.back().y), metric.band);
}

template <class Source>
std::function<double(const Source&)> column(const std::vector<RunColumn<Source>>& columns, const std::string& name) {
  return std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.description.name == name; })->value;
}

}  // namespace

double OwnMetric::of(const Course& whole) const {
  const Course course = whole.between(from, to);
  if (course.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::visit([&](const auto& what) { return value_of(what, course); }, kind);
}

OwnMeters::OwnMeters(const std::vector<OwnMetric>& metrics, const Scenario& scenario)
    : metrics_(metrics),
      duration_(scenario.run.duration),
      of_row_(metrics.size()),
      of_sample_(metrics.size()),
      courses_(metrics.size()) {
  const std::vector<RunColumn<Row>> columns = trajectory_columns(contents_of(scenario));
  for (std::size_t k = 0; k < metrics.size(); ++k)
    if (metrics[k].of_controller)
      of_sample_[k] = column(controller_columns(), metrics[k].column);
    else
      of_row_[k] = column(columns, metrics[k].column);
}

RunListeners OwnMeters::listeners() {
  return {.rows = [this](const Trajectory& part) { take(part); },
          .samples = [this](const std::vector<ControlRecord>& samples) { take(samples); }};
}

std::vector<double> OwnMeters::values() const {
  std::vector<double> all;
  for (std::size_t k = 0; k < metrics_.size(); ++k) {
    Course course = courses_[k];
    if (metrics_[k].of_controller && !course.empty()) course.points.push_back({duration_, course.points.back().y});
    all.push_back(metrics_[k].of(course));
  }
  return all;
}

void OwnMeters::take(const Trajectory& part) {
  events_.insert(events_.end(), part.events.begin(), part.events.end());
  auto event = events_.begin();
  for (const Row& row : part.rows) {
    event = std::find_if(event, events_.end(), [&](const Event& e) { return e.t >= row.t; });
    const bool jumps = event != events_.end() && event->t == row.t;
    for (std::size_t k = 0; k < courses_.size(); ++k) {
      if (!of_row_[k]) continue;
      if (jumps && !courses_[k].empty()) courses_[k].points.push_back({row.t, of_row_[k](Row{row.t, event->before})});
      courses_[k].points.push_back({row.t, of_row_[k](row)});
    }
  }
  if (!part.rows.empty()) std::erase_if(events_, [&](const Event& e) { return e.t <= part.rows.back().t; });
}

void OwnMeters::take(const std::vector<ControlRecord>& samples) {
  for (std::size_t k = 0; k < courses_.size(); ++k) {
    if (!of_sample_[k]) continue;
    std::vector<Course::Point>& points = courses_[k].points;
    for (const ControlRecord& sample : samples) {
      if (!points.empty()) points.push_back({sample.measured.t, points.back().y});
      points.push_back({sample.measured.t, of_sample_[k](sample)});
    }
  }
}

}  // namespace wormdrive
