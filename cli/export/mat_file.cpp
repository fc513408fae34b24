#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>

#include <fmt/format.h>
#include <matio.h>

#include "cli/export/exported_table.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/hdf5/part_file.hpp"
#include "output/replacing.hpp"

namespace wormdrive {
namespace {

using MatVariable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;
using MatHandle = std::unique_ptr<mat_t, decltype(&Mat_Close)>;

MatVariable checked(matvar_t* variable) {
  if (!variable) throw std::bad_alloc();
  return {variable, Mat_VarFree};
}

MatVariable mat_numbers(const std::vector<double>& values) {
  std::array<std::size_t, 2> size{values.size(), 1};
  return checked(
      Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), const_cast<double*>(values.data()), 0));
}
MatVariable mat_characters(const char* name, const std::string& text) {
  std::array<std::size_t, 2> size{text.empty() ? 0u : 1u, text.size()};
  return checked(Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, size.data(), const_cast<char*>(text.data()), 0));
}
MatVariable mat_structure(const char* name, const std::vector<std::string>& fields) {
  std::vector<const char*> names;
  for (const std::string& field : fields) names.push_back(field.c_str());
  std::array<std::size_t, 2> size{1, 1};
  return checked(Mat_VarCreateStruct(name, 2, size.data(), names.data(), static_cast<unsigned>(names.size())));
}
/// A struct takes over its field.
void set_field(const MatVariable& in, const std::string& field, MatVariable value) {
  Mat_VarSetStructFieldByName(in.get(), field.c_str(), 0, value.release());
}

std::vector<std::string> names_of(const ExportedTable& table) {
  std::vector<std::string> names;
  for (const ExportedColumn& column : table.columns) names.push_back(column.name);
  return names;
}

std::size_t bytes_of(const std::vector<ExportedTable>& tables) {
  std::size_t bytes = 0;
  for (const ExportedTable& table : tables)
    bytes += table.columns.size() * table.columns.front().values.size() * sizeof(double);
  return bytes;
}

/// Whether a table can be read from the file as it is.
bool readable(mat_t* file, const ExportedTable& table) {
  const MatVariable found(Mat_VarRead(file, table.name.c_str()), Mat_VarFree);
  return found && std::all_of(table.columns.begin(), table.columns.end(), [&](const ExportedColumn& column) {
           const matvar_t* const field = Mat_VarGetStructFieldByName(found.get(), column.name.c_str(), 0);
           if (!field || !field->data || field->nbytes != column.values.size() * sizeof(double)) return false;
           const auto* const values = static_cast<const double*>(field->data);
           return std::equal(column.values.begin(), column.values.end(), values);
         });
}

bool write_variables(mat_t* file, const std::vector<ExportedTable>& tables,
                     const std::vector<std::pair<std::string, std::string>>& texts) {
  const auto put = [file](const MatVariable& v) { return Mat_VarWrite(file, v.get(), MAT_COMPRESSION_NONE) == 0; };
  bool written = true;
  for (const auto& [name, text] : texts) written = put(mat_characters(name.c_str(), text)) && written;
  std::vector<std::string> tables_by_name;
  for (const ExportedTable& table : tables) tables_by_name.push_back(table.name);
  for (const bool of_units : {true, false}) {
    const MatVariable all = mat_structure(of_units ? "units" : "meanings", tables_by_name);
    for (const ExportedTable& table : tables) {
      MatVariable one = mat_structure(nullptr, names_of(table));
      for (const ExportedColumn& column : table.columns)
        set_field(one, column.name, mat_characters(nullptr, of_units ? column.units : column.meaning));
      set_field(all, table.name, std::move(one));
    }
    written = put(all) && written;
  }
  for (const ExportedTable& table : tables) {
    const MatVariable one = mat_structure(table.name.c_str(), names_of(table));
    for (const ExportedColumn& column : table.columns) set_field(one, column.name, mat_numbers(column.values));
    written = put(one) && written;
  }
  return written;
}

}  // namespace

void write_mat(const std::string& link, const std::vector<ExportedTable>& tables,
               const std::vector<std::pair<std::string, std::string>>& texts) {
  for (const ExportedTable& table : tables) {
    const std::size_t bytes = table.columns.size() * table.columns.front().values.size() * sizeof(double);
    if (bytes > std::size_t(std::numeric_limits<std::int32_t>::max()))  // of a variable, in MATLAB's version 5
      throw OutputFault(
          fmt::format("cannot write {}: {} has {} bytes, a MAT-file holds 2147483647; export it as CSV, or "
                      "read the .h5 with h5read",
                      link, table.name, bytes));
  }
  const std::string path = followed(link), part = path + ".part";
  reject_unless_plain_file(part);
  try {
    MatHandle file(Mat_CreateVer(part.c_str(), mat_mark, MAT_FT_MAT5), Mat_Close);
    bool whole = file && write_variables(file.get(), tables, texts);
    if (whole) {
      file.reset();  // matio does not tell whether the last bytes were written
      // and crashes on a file that ends early
      if (std::filesystem::file_size(part) > bytes_of(tables)) file.reset(Mat_Open(part.c_str(), MAT_ACC_RDONLY));
      whole = file && std::all_of(tables.begin(), tables.end(), [&](const auto& t) { return readable(file.get(), t); });
    }
    if (!whole)
      throw OutputFault(fmt::format("cannot write {}: matio could not write all of it; is the disk full?", path));
    synchronise(part);
    std::filesystem::rename(part, path);
  } catch (...) {
    std::remove(part.c_str());
    throw;
  }
}

}  // namespace wormdrive
