#include "sweep/rare/rare_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "description/diagnostics.hpp"
#include "output/hdf5/read_ahead.hpp"
#include "output/hdf5/stored_table.hpp"
#include "sweep/file/origin.hpp"
#include "sweep/file/sweep_file.hpp"

namespace wormdrive {
namespace {

/// Those of the trials of a sweep, but for the reasons, of which there is no list.
std::vector<ColumnDescription> run_columns(const Study& study) {
  std::vector<ColumnDescription> columns = trial_columns(study);
  std::erase_if(columns, [](const ColumnDescription& c) { return c.name == "reason"; });
  return columns;
}

/// The values of a run in the order of its columns.
std::vector<double> row_of(const Trial& run) {
  std::vector<double> row{static_cast<double>(run.index)};
  row.insert(row.end(), run.parameters.begin(), run.parameters.end());
  row.insert(row.end(), run.metrics.begin(), run.metrics.end());
  row.push_back(static_cast<double>(run.status));
  return row;
}

/// What the runs of an estimate hang on beside their origin, as it is typed.
std::string words_of(const RareSettings& settings) {
  return fmt::format("--metric {} --per-level {} --samples {}", settings.metric, settings.per_level, settings.samples);
}

void write_origin(hid_t file, const Study& study, const std::string& settings, const std::string& command_line) {
  const Origin origin = origin_of(study);
  write_provenance(file, {"rare", study.title, origin.scenario, command_line});
  write_attribute(file, "study", origin.study);
  write_attribute(file, "build", origin.build);
  write_attribute(file, "settings", settings);
}

/// The runs that a file has of the same study, settings and program. Throws InputFault where it has others.
std::map<std::uint64_t, Trial> stored_runs(const std::string& path, const Study& study, const std::string& settings) {
  std::map<std::uint64_t, Trial> runs;
  try {
    read_ahead(path);
    const Hdf5Handle file = open_hdf5(path);
    if (read_text_attribute(file, "kind") != "rare") throw OutputFault("it is not the result of an estimate");
    const Origin origin{read_text_attribute(file, "study"), read_text_attribute(file, "scenario"),
                        read_text_attribute(file, "build")};
    std::string why = why_not_beside(origin, origin_of(study));
    if (const std::string there = read_text_attribute(file, "settings"); why.empty() && there != settings)
      why = fmt::format("it was made with {}, not {}", there, settings);
    if (!why.empty()) throw OutputFault(why + "; undo the change, or delete the file to start again");
    const StoredTable table(file, "runs");
    std::vector<std::vector<double>> columns;
    for (ColumnDescription column : run_columns(study)) {
      if (column.is_flag()) column.flag_values.push_back(0);  // of a run that was not made yet
      table.check(column, Range::any);
      columns.push_back(table.column(column.name).values());
    }
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const double status = columns.back()[row];
      if (status == 0.0) continue;
      if (columns.front()[row] != static_cast<double>(row))
        table.column("index").reject(fmt::format("contains {} in the row of run {}", columns.front()[row], row));
      Trial run{row, {}, {}, static_cast<TrialStatus>(status), {}};
      for (std::size_t k = 0; k < study.parameters.size(); ++k) {
        run.parameters.push_back(columns[1 + k][row]);
        if (!std::isfinite(run.parameters.back()))
          table.column(study.parameters[k].name)
              .reject(fmt::format("holds {} for run {}, which is not finite", run.parameters.back(), row));
      }
      for (std::size_t k = 1 + study.parameters.size(); k + 1 < columns.size(); ++k)
        run.metrics.push_back(columns[k][row]);
      runs.emplace(row, std::move(run));
    }
  } catch (const OutputFault& fault) {
    reject({path}, fmt::format("cannot be resumed: {}", fault.what()));
  } catch (const InputFault& fault) {  // of its study or scenario
    reject({path}, fmt::format("cannot be resumed: its study or scenario is damaged: {}", fault.faults.front().what));
  }
  return runs;
}

void write_runs(hid_t file, const Study& study, const std::map<std::uint64_t, Trial>& runs) {
  const std::vector<ColumnDescription> descriptions = run_columns(study);
  std::vector<std::vector<double>> columns(descriptions.size());
  for (const auto& [number, run] : runs) {
    const std::vector<double> row = row_of(run);
    for (std::size_t k = 0; k < row.size(); ++k) columns[k].push_back(row[k]);
  }
  GrowingTable(file, "runs", descriptions, runs.size()).append(columns);
}

void write_estimates(hid_t file, const RareEvent& event) {
  std::vector<std::vector<double>> columns(6);
  std::vector<std::string> methods;
  const auto add = [&](const std::string& method, const RareEstimate& p) {
    const double row[] = {static_cast<double>(methods.size()), p.probability, p.low, p.high, p.variation,
                          static_cast<double>(p.evaluations)};
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(row[k]);
    methods.push_back(method);
  };
  add("subset_simulation", event.subset.estimate);
  if (!event.median_misses) add("importance_sampling", event.importance);
  GrowingTable table(file, "estimates",
                     {{"index", "1", "number of the estimate"},
                      {"probability", "1", "with which the limit is missed"},
                      {"low", "1", "lower end of its 95 % interval"},
                      {"high", "1", "upper end of its 95 % interval"},
                      {"variation", "1", "coefficient of variation of the estimate"},
                      {"runs", "1", "how many it took"}});
  table.append(columns);
  write_texts(table.group(), "method", "how it was estimated", methods);
  write_attribute(table.group(), "metric", event.threshold.metric);
  write_attribute(table.group(), "limit", event.threshold.limit);
  write_attribute(table.group(), "above", std::int64_t{event.threshold.above});
}

void write_levels(hid_t file, const RareEvent& event, const std::string& unit) {
  std::vector<std::vector<double>> columns(5);
  for (const SubsetLevel& level : event.subset.levels) {
    const double row[] = {static_cast<double>(columns[0].size()), level.threshold, level.share, level.variation,
                          level.acceptance};
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(row[k]);
  }
  GrowingTable(file, "levels",
               {{"index", "1", "number of the level"},
                {"distance", unit, "of its end from the limit"},
                {"share", "1", "of its runs that come as near as its end"},
                {"variation", "1", "coefficient of variation of the share"},
                {"acceptance", "1", "share of the proposals that were taken"}})
      .append(columns);
}

void write_design_point(hid_t file, const RareEvent& event, const Study& study) {
  if (event.design.direction.empty()) return;
  std::vector<std::vector<double>> columns(3);
  std::vector<std::string> parameters, units;
  for (std::size_t k = 0; k < study.parameters.size(); ++k) {
    const double row[] = {static_cast<double>(k), event.likely.parameters[k],
                          event.design.direction[k] * event.design.direction[k]};
    for (std::size_t column = 0; column < columns.size(); ++column) columns[column].push_back(row[column]);
    parameters.push_back(study.parameters[k].name);
    units.push_back(std::string(study.parameters[k].si_unit.symbol));
  }
  GrowingTable table(file, "design_point",
                     {{"index", "1", "number of the parameter"},
                      {"value", "see unit", "of the drive that misses most likely"},
                      {"importance", "1", "share of the way to it"}});
  table.append(columns);
  write_texts(table.group(), "parameter", "name of the parameter", parameters);
  write_texts(table.group(), "unit", "its unit", units);
  write_attribute(table.group(), "beta", event.design.beta);
  write_attribute(table.group(), "converged", std::int64_t{event.design.converged});
}

}  // namespace

RareFile::RareFile(const std::string& path, const Study& study, const RareSettings& settings,
                   const std::string& command_line, bool resume, Replace replace)
    : study_(study), settings_(words_of(settings)), command_line_(command_line), lock_(path) {
  const std::string part = path + ".part";
  const bool goes_on = std::filesystem::exists(part) && (resume || replace != Replace::anything);
  if (goes_on) {
    reject_if_being_written(part);
    made_ = stored_runs(part, study, settings_);
    if (!resume && !made_.empty())
      reject({part}, fmt::format("contains {} runs of an interrupted estimate; add --resume to continue it, or delete "
                                 "it to start again",
                                 made_.size()));
  } else if (resume && std::filesystem::exists(path)) {
    made_ = stored_runs(path, study, settings_);
  }
  from_before_ = made_.size();
  if (!goes_on && from_before_ > 0) return;
  if (!goes_on) {
    reject_replacing(path, "rare", replace);
    PartFile file(part, OutputLock(), "rare", replace);  // so that it is whole from its first moment on
    write_origin(file.file(), study, settings_, command_line);
    FixedTable::create(file.file(), "runs", run_columns(study), most_runs(study, settings));
    file.finish();
  }
  file_.reset(new PartFile(PartFile::reopened(path, "rare", replace)));
  table_.emplace(file_->file(), "runs", run_columns(study));
  keeper_ = std::jthread([this](const std::stop_token& stop) { keep_safe(stop); });
}

RareFile::~RareFile() {
  keeper_.request_stop();
  if (keeper_.joinable()) keeper_.join();
}

KeptRuns RareFile::runs() {
  return {[this](std::uint64_t number) {
            const auto there = made_.find(number);
            return there == made_.end() ? std::nullopt : std::optional(there->second);
          },
          [this](Trial trial) { keep(std::move(trial)); }};
}

void RareFile::keep(Trial trial) {
  const std::lock_guard lock(mutex_);
  if (fault_) std::rethrow_exception(fault_);
  waiting_.push_back(std::move(trial));
}

void RareFile::flush() {
  if (waiting_.empty()) return;
  std::vector<std::vector<double>> rows;
  for (const Trial& run : waiting_) rows.push_back(row_of(run));
  const std::size_t last = rows.front().size() - 1;
  const auto write = [&](std::size_t first, std::size_t end) {
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::size_t k = first; k < end; ++k) table_->write(k, waiting_[row].index, {rows[row][k]});
    file_->flush();
  };
  // a run is there only once it has a status, and it has one only when all else is on the disk
  write(0, last);
  synchronise(file_->part_path());
  write(last, last + 1);
  std::move(waiting_.begin(), waiting_.end(), std::back_inserter(written_));
  waiting_.clear();
}

void RareFile::finish(const RareEvent& event) {
  keeper_ = {};  // ends, and waits for it
  if (fault_) std::rethrow_exception(fault_);
  if (!file_) return;
  flush();
  std::map<std::uint64_t, Trial> all = made_;
  for (const Trial& run : written_) all.emplace(run.index, run);
  const std::string path = file_->path() + ".whole";
  PartFile whole(path, OutputLock(), "rare", Replace::same_kind);
  write_origin(whole.file(), study_, settings_, command_line_);
  write_runs(whole.file(), study_, all);
  write_estimates(whole.file(), event);
  write_levels(whole.file(), event, std::string(study_.metric(event.threshold.metric).unit.symbol));
  if (!event.median_misses) write_design_point(whole.file(), event, study_);
  whole.finish();
  table_.reset();
  file_->give_way_to(path);
}

void RareFile::give_up() {
  keeper_ = {};
  table_.reset();
  if (file_ && from_before_ == 0) file_->give_up();
}

void RareFile::keep_safe(const std::stop_token& stop) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // every thread has its own: faults are told once, by the exception
  std::unique_lock lock(mutex_);
  for (bool last = false; !last && !fault_;) {
    wakes_.wait_for(lock, stop, longest_wait, [] { return false; });
    last = stop.stop_requested();
    try {
      flush();
    } catch (...) {
      fault_ = std::current_exception();
    }
  }
}

}  // namespace wormdrive
