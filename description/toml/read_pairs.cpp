#include "description/toml/read_pairs.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "description/toml/csv.hpp"

namespace wormdrive {
namespace {

std::string spelled(const ColumnName& name, Axis axis) { return spellings(name.stem, name.unit, axis).front().key; }

std::string count(std::size_t number, const std::string& things) {
  return fmt::format("{} {}{}", number, things, number == 1 ? "" : "s");
}

Pairs from_file(TableReader& table, const TableColumns& columns, std::size_t at_least, const std::string& file,
                const std::string& folder) {
  const std::string x_column = table.text("x_column").value_or(spelled(columns.point_column, table.axis()));
  const std::string y_column = table.text("y_column").value_or(spelled(columns.value_column, table.axis()));
  for (const ColumnName& name : {columns.points, columns.values})
    if (const auto both = table.stated(name.stem, name.unit))
      table.fault(both->key, fmt::format("{} is stated along with 'file'; keep one", table.path_of(both->key)));
  Pairs pairs;
  tell_faults_of_file(table, "file", file, [&] {
    const Csv csv = read_csv((std::filesystem::path(folder) / file).string());
    Pairs found{csv.numbers(x_column), csv.numbers(y_column)};
    require_increasing(csv, x_column, found.x);
    if (found.x.size() >= at_least)
      pairs = std::move(found);
    else
      table.fault("file", fmt::format("{} = \"{}\" has {} below its header line; at least {} are needed",
                                      table.path_of("file"), file, count(found.x.size(), "row"), at_least));
  });
  return pairs;
}

Pairs inline_pairs(TableReader& table, const TableColumns& columns, std::size_t at_least) {
  const auto x_key = table.stated(columns.points.stem, columns.points.unit),
             y_key = table.stated(columns.values.stem, columns.values.unit);
  if (!x_key || !y_key) {
    table.lacks(fmt::format("'file' (a CSV file), or '{}' and '{}'", spelled(columns.points, table.axis()),
                            spelled(columns.values, table.axis())));
    return {};
  }
  const auto x = table.numbers(*x_key), y = table.numbers(*y_key);
  if (!x || !y) return {};
  const std::string path = table.path_of(x_key->key);
  if (x->size() != y->size()) {
    table.fault(x_key->key, fmt::format("{} has {} but {} has {}", path, count(x->size(), "value"), y_key->key,
                                        count(y->size(), "value")));
    return {};
  }
  if (x->size() < at_least) {
    table.fault(x_key->key,
                fmt::format("{} has {}; at least {} are needed", path, count(x->size(), "value"), at_least));
    return {};
  }
  for (std::size_t k = 1; k < x->size(); ++k) {
    if ((*x)[k] > (*x)[k - 1]) continue;
    const double si = x_key->unit.si;
    table.fault(x_key->key, fmt::format("{}[{}] = {:.12g} does not increase after {:.12g}", path, k, (*x)[k] / si,
                                        (*x)[k - 1] / si));
    return {};
  }
  return {*x, *y};
}

}  // namespace

void tell_faults_of_file(TableReader& table, const std::string& key, const std::string& file,
                         const std::function<void()>& read) {
  try {
    read();
  } catch (const InputFault& fault) {
    // A wrong line is put right in the file, a wrong name where it is stated.
    for (const Fault& f : fault.faults)
      if (f.where.line > 0)
        table.faults().add(f.where,
                           fmt::format("{} ({} at {})", f.what, table.path_of(key), to_string(table.where(key))));
      else
        table.fault(key, fmt::format("{} = \"{}\" {}", table.path_of(key), file, f.what));
  }
}

Pairs read_pairs(TableReader& table, const TableColumns& columns, std::size_t at_least, const std::string& folder) {
  if (!table.has("file")) return inline_pairs(table, columns, at_least);
  const auto file = table.text("file");
  return file ? from_file(table, columns, at_least, *file, folder) : Pairs{};
}

}  // namespace wormdrive
