#include "output/hdf5/stored_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace wormdrive {
namespace {

constexpr std::uint64_t rows_at_once = 1 << 16;

void check_flags(const StoredColumn& column, const ColumnDescription& known) {
  for (std::uint64_t first = 0; first < column.rows(); first += rows_at_once)
    for (const double value : column.values(first, std::min(rows_at_once, column.rows() - first)))
      if (std::find(known.flag_values.begin(), known.flag_values.end(), value) == known.flag_values.end())
        column.reject(
            fmt::format("holds {}, which is none of its flags {}", value, fmt::join(known.flag_values, ", ")));
}

void check_numbers(const StoredColumn& column, Range range) {
  if (range == Range::any) return;
  double before = -std::numeric_limits<double>::infinity();
  for (std::uint64_t first = 0; first < column.rows(); first += rows_at_once) {
    std::uint64_t row = first;
    for (const double value : column.values(first, std::min(rows_at_once, column.rows() - first))) {
      if (!std::isfinite(value)) column.reject(fmt::format("holds {} in row {}, which is not finite", value, row));
      if (range == Range::rising ? value <= before : range == Range::ordered && value < before)
        column.reject(fmt::format("falls from {} to {} in row {}", before, value, row));
      before = value;
      ++row;
    }
  }
}

Hdf5Handle open_group(hid_t file, const std::string& path) {
  Hdf5Handle group = open_object(file, path);
  if (H5Iget_type(group) != H5I_GROUP) throw ReadFault(file_of(file), fmt::format("its '{}' is not a table", path));
  return group;
}

std::vector<std::string> members_of(hid_t group) {
  std::vector<std::string> names;
  const auto take = [](hid_t, const char* name, const H5L_info_t*, void* list) {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return herr_t{0};
  };
  if (H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, take, &names) < 0)
    throw ReadFault(file_of(group), "its contents cannot be read");
  return names;
}

}  // namespace

std::vector<std::string> members_of(hid_t file, const std::string& group) {
  return members_of(open_group(file, group));
}

bool has_member(hid_t file, const std::string& name) { return H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0; }

StoredTable::StoredTable(hid_t file, const std::string& name) : file_(file_of(file)), name_(name) {
  const Hdf5Handle group = open_group(file, name);
  names_ = members_of(group);
  columns_.reserve(names_.size());
  for (const std::string& member : names_) {
    columns_.emplace_back(group, member, fmt::format("{}/{}", name, member));
    if (columns_.back().rows() != rows())
      columns_.back().reject(
          fmt::format("has {} rows where '{}' has {}", columns_.back().rows(), columns_.front().path(), rows()));
  }
}

bool StoredTable::has(const std::string& name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

const StoredColumn& StoredTable::column(const std::string& name) const {
  const auto at = std::find(names_.begin(), names_.end(), name);
  if (at == names_.end()) throw ReadFault(file_, fmt::format("it has no column '{}/{}'", name_, name));
  return columns_[static_cast<std::size_t>(at - names_.begin())];
}

std::vector<std::string> StoredTable::numbers() const {
  std::vector<std::string> list;
  for (std::size_t k = 0; k < names_.size(); ++k)
    if (const auto type = columns_[k].type(); type == StoredColumn::Type::number || type == StoredColumn::Type::flag)
      list.push_back(names_[k]);
  return list;
}

void StoredTable::check(const ColumnDescription& known, Range range) const {
  const StoredColumn& stored = column(known.name);
  const auto wanted = known.is_flag() ? StoredColumn::Type::flag : StoredColumn::Type::number;
  if (stored.type() != wanted)
    stored.reject(known.is_flag() ? "does not hold flags of 8 bits" : "does not hold numbers of 64 bits");
  if (known.is_flag())
    check_flags(stored, known);
  else
    check_numbers(stored, range);
}

void StoredTable::check_texts(const std::string& name) const {
  const StoredColumn& stored = column(name);
  if (stored.type() != StoredColumn::Type::text && stored.type() != StoredColumn::Type::padded_text)
    stored.reject("does not hold texts");
}

}  // namespace wormdrive
