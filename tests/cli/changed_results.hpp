#pragma once
// What the tests of `diff` share: results, changed copies of them, and what is said of both.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/program.hpp"

namespace wormdrive::test {

/// A folder with s.toml, results of it, and changed copies of them.
struct ResultFolder : Folder {
  ResultFolder() { write("s.toml", good_scenario); }

  void make(std::vector<std::string> words) const {
    const Outcome outcome = run(words);
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
  }
  Outcome diff(const std::string& a, const std::string& b, const std::vector<std::string>& options = {}) const {
    std::vector<std::string> words{"diff", a, b};
    words.insert(words.end(), options.begin(), options.end());
    return run(words);
  }
  void copy(const std::string& from, const std::string& to) const {
    std::filesystem::copy_file(*this / from, *this / to, std::filesystem::copy_options::overwrite_existing);
  }
  double value(const std::string& file, const std::string& column, std::size_t row) const {
    return read_column(open_hdf5(*this / file), column)[row];
  }
  /// Changes one value of a column of numbers or flags.
  void change(const std::string& file, const std::string& column, std::size_t row, double value) const {
    const Hdf5Handle result = reopen_hdf5(*this / file);
    std::vector<double> all = read_column(result, column);
    all[row] = value;
    check_hdf5(H5Dwrite(open_object(result, column), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()),
               "cannot change");
  }
  template <class Value>
  void change_attribute(const std::string& file, const std::string& object, const std::string& name,
                        Value value) const {
    const Hdf5Handle result = reopen_hdf5(*this / file), changed = open_object(result, object);
    check_hdf5(H5Adelete(changed, name.c_str()), "cannot change");
    write_attribute(changed, name, value);
  }
};

/// The line of what was printed that begins with a text.
inline std::string line_of(const std::string& out, const std::string& begin) {
  const std::size_t at = out.find("  " + begin + " ");
  return at == std::string::npos ? "" : out.substr(at, out.find('\n', at) - at);
}
inline bool tells(const Outcome& outcome, const std::string& line) {
  return outcome.out.find("  " + line + "\n") != std::string::npos;
}

inline nlohmann::json signal_in(const Outcome& json, const std::string& name) {
  const nlohmann::json told = nlohmann::json::parse(json.out);
  for (const nlohmann::json& signal : told.at("signals"))
    if (signal.at("signal") == name) return signal;
  FAIL("no signal '" << name << "'");
  return {};
}

/// Every column of numbers of a result in turn: its first value is another one, and diff says so.
inline void check_every_column(const ResultFolder& folder, const std::string& result,
                               const std::vector<std::string>& tables) {
  for (const std::string& table : tables) {
    std::vector<std::string> columns;
    {
      const Hdf5Handle file = open_hdf5(folder / result);
      for (const std::string& name : members(open_object(file, table))) {
        const Hdf5Handle column = open_object(file, table + "/" + name);
        const Hdf5Handle type(H5Dget_type(column), H5Tclose, "no type");
        if (H5Tget_class(type) == H5T_FLOAT) columns.push_back(table + "/" + name);
      }
    }
    CHECK(columns.size() >= 2);
    for (const std::string& column : columns) {
      const std::vector<double> values = read_column(open_hdf5(folder / result), column);
      REQUIRE_FALSE(values.empty());
      double size = 1.0;
      for (const double value : values)
        if (std::isfinite(value)) size = std::max(size, std::abs(value));
      folder.copy(result, "changed.h5");
      folder.change("changed.h5", column, 0, std::isfinite(values[0]) ? values[0] - 1e-3 * size : 1.0);
      const Outcome outcome = folder.diff(result, "changed.h5");
      INFO(column << "\n" << outcome.out << outcome.err);
      CHECK(outcome.exit == 1);
    }
  }
}

}  // namespace wormdrive::test
