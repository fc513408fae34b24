#pragma once
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace wormdrive {

/// Numbers the kinds of reasons for which trials are not done, as they occur; few enough to be kept in memory.
class ReasonTable {
 public:
  static constexpr std::size_t most = 100;
  static constexpr std::uint64_t no_trial = std::numeric_limits<std::uint64_t>::max();

  struct Entry {
    std::string example;  ///< the reason of the first trial of its kind
    std::uint64_t count = 0;
    std::uint64_t first = no_trial;  ///< that trial
  };

  ReasonTable() = default;
  /// Goes on with kinds that have their numbers already.
  explicit ReasonTable(std::vector<Entry> entries);

  /// Counts the reason of a trial, and of others after it, and returns its number, 0 for a trial that is done; kinds
  /// beyond the last number share it.
  std::size_t code(const std::string& reason, std::uint64_t trial, std::uint64_t trials = 1);
  /// Every kind, number 1 first.
  const std::vector<Entry>& entries() const { return entries_; }
  /// How many trials are not done.
  std::uint64_t total() const;

  /// Whether kinds have the numbers that they get when trials are told one after the other, and each has a trial.
  bool in_order() const;
  /// Gives kinds these numbers; returns the new ones of the old ones, 0 for 0.
  std::vector<std::size_t> put_in_order();

 private:
  std::vector<std::size_t> order() const;

  std::map<std::string, std::size_t> codes_;  ///< by kind
  std::vector<Entry> entries_;
};

/// Reasons that differ in their numbers alone are one kind: the numbers replaced, what led up to a halt cut off.
std::string kind_of_reason(const std::string& reason);

}  // namespace wormdrive
