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

/// "file:line:column", without what is unknown.
std::string to_string(const Location& where);

/// Something wrong with the input: where, and what with value, rule and cure.
struct Fault {
  Location where;
  std::string what;
};

/// Bad input: what() tells every fault in a line of its own, "file:line:column: error: what".
struct InputFault : std::runtime_error {
  explicit InputFault(std::vector<Fault> list);
  std::vector<Fault> faults;  ///< in the order in which they stand in the file
};

/// Throws InputFault with this one fault.
[[noreturn]] void reject(const Location& where, const std::string& what);

/// Collects faults so that all are told at once.
class Diagnostics {
 public:
  void add(const Location& where, std::string what);
  bool empty() const { return list_.empty(); }
  /// Throws InputFault with all faults; does nothing without faults.
  void raise() const;

 private:
  std::vector<Fault> list_;
};

}  // namespace wormdrive
