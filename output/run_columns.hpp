#pragma once
#include <functional>
#include <string>
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

/// The columns of a run's tables, with those of elastic teeth and of a motor's winding behind them.
const std::vector<RunColumn<Row>>& trajectory_columns(bool elastic, bool winding);
const std::vector<RunColumn<Event>>& event_columns(bool elastic);
const std::vector<RunColumn<ControlRecord>>& controller_columns();

}  // namespace wormdrive
