#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "control/closed_loop.hpp"
#include "output/run_file.hpp"
#include "output/trajectory.hpp"

namespace wormdrive {

/// A column and where its value comes from.
template <class Source>
struct RunColumn {
  ColumnDescription description;
  std::function<double(const Source&)> value;
};

template <class Source>
std::vector<ColumnDescription> descriptions(const std::vector<RunColumn<Source>>& columns, Axis axis) {
  std::vector<ColumnDescription> list;
  for (const auto& column : columns) {
    list.push_back(column.description);
    list.back().units = units_on(axis, list.back().units);
  }
  return list;
}

template <class Source>
std::vector<std::vector<double>> values(const std::vector<RunColumn<Source>>& columns,
                                        const std::vector<Source>& rows) {
  std::vector<std::vector<double>> table;
  for (const auto& column : columns) {
    std::vector<double>& list = table.emplace_back();
    list.reserve(rows.size());
    for (const Source& row : rows) list.push_back(column.value(row));
  }
  return table;
}

/// The column of a state of an effect; place: among the states of all.
StateColumn state_column(std::string_view id, const EffectState& state, std::size_t place);

/// Whether a run can have events of a kind.
bool can_happen(EventKind kind, const RunContents& contents);

/// The columns of a run's tables, with those of elastic teeth, of a motor's winding and of states of effects behind
/// them.
std::vector<RunColumn<Row>> trajectory_columns(const RunContents& contents);
const std::vector<RunColumn<Event>>& event_columns(const RunContents& contents);
const std::vector<RunColumn<ControlRecord>>& controller_columns();

}  // namespace wormdrive
