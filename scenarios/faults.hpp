#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace wormdrive {

/// Where a fault stands: a file (or "--set"), line and column counted from 1, 0 where unknown.
struct Location {
  std::string file;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

/// Bad input: every fault found, one line each, in the order in which they stand in the file.
struct InputFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Collects faults so that all are told at once.
class Faults {
 public:
  void add(const Location& where, std::string what);
  bool empty() const { return list_.empty(); }
  /// Throws InputFault with one line per fault, "file:line:column: error: what"; does nothing without faults.
  void raise() const;

 private:
  struct Fault {
    Location where;
    std::string what;
  };
  std::vector<Fault> list_;
};

/// "file:line:column", without what is unknown.
std::string to_string(const Location& where);

}  // namespace wormdrive
