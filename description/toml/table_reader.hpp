#pragma once
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <toml++/toml.h>

#include "core/field.hpp"
#include "description/diagnostics.hpp"
#include "description/keys.hpp"

namespace wormdrive {

/// Reads one table of a document, notes every fault and remembers which keys may stand in it and which must.
class TableReader {
 public:
  /// table: null for one that is not there. path: how it is called in messages, "mesh"; empty for the root.
  /// missing_at: where faults stand of a table that is not there.
  TableReader(const toml::table* table, std::string path, Axis axis, Diagnostics& faults, Location missing_at);

  /// What messages call the whole file, "the scenario" unless it is said otherwise.
  void set_whole(std::string whole) { whole_ = std::move(whole); }
  /// From here on keys are spelled for this axis.
  void set_axis(Axis axis) { axis_ = axis; }

  /// Reads all fields and choices of a parameter struct; missing ones keep their value, faulty ones too.
  template <class Parameters>
  void read_fields(Parameters& parameters) {
    read_choices(parameters);
    for_each_field<Parameters>([&](const auto& field) {
      if (const auto value = number(field.name, field.unit, field.bounds, field.presence, field.meaning))
        parameters.*field.member = *value;
    });
  }

  template <class Parameters>
  void read_choices(Parameters& parameters) {
    for_each_choice<Parameters>([&](const auto& one) {
      if (const auto word = choice(std::string(one.key), {one.words.begin(), one.words.end()}, Presence::optional))
        one.set(parameters, *word);
    });
  }

  /// A number in SI, from any of its spellings.
  std::optional<double> number(std::string_view name, const Unit& unit, const Bounds& bounds, Presence presence,
                               std::string_view meaning);
  /// The spelling under which a name is stated, if it is.
  std::optional<Spelling> stated(std::string_view name, const Unit& unit);
  /// A list of numbers in SI.
  std::optional<std::vector<double>> numbers(const Spelling& spelling);
  std::optional<std::string> text(const std::string& key);
  /// A text that must not be missing.
  std::optional<std::string> required_text(const std::string& key, std::string_view meaning);
  /// A text that may stand in every kind of file: one line of characters that can be shown.
  std::optional<std::string> line(const std::string& key);
  /// A list of strings; empty if it is not there.
  std::vector<std::string> texts(const std::string& key);
  std::optional<bool> truth(const std::string& key);
  /// One of several words; the first is the default, or, if required, there is none.
  std::optional<std::string> choice(const std::string& key, const std::vector<std::string>& words, Presence presence);
  /// A sub-table, or null; another type is a fault.
  const toml::table* table(const std::string& key);
  /// The tables of an array of tables, or the one table; another type is a fault.
  std::vector<const toml::table*> tables(const std::string& key);

  /// Reads a sub-table with read(reader); one that is not there may still be told to be required.
  template <class Read>
  void section(const std::string& key, Read&& read) {
    const toml::table* const sub = table(key);
    if (has(key) && !sub) return;  // of another type, which was told
    TableReader reader(sub, path_of(key), axis_, faults_, here_);
    read(reader);
    reader.finish();
  }

  /// The text of a key that another call will read and check.
  std::optional<std::string> peek(const std::string& key) const { return table_[key].value<std::string>(); }
  bool has(const std::string& key) const { return table_.contains(key); }
  /// Where the value of a key stands; the table itself if it is absent.
  Location where(const std::string& key) const;
  Location where() const { return here_; }
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  /// Notes a fault at a key.
  void fault(const std::string& key, std::string what) { faults_.add(where(key), std::move(what)); }
  /// Notes what the table as a whole lacks.
  void lacks(const std::string& what);
  /// Which keys may stand here is not known: none is unknown.
  void ignore_unknown() { knows_all_ = false; }
  /// Notes every key that no call has asked for, and every one that had to be there and is not.
  void finish();

  Axis axis() const { return axis_; }
  Diagnostics& faults() { return faults_; }

 private:
  const toml::node* find(const std::string& key);
  void wrong_type(const std::string& key, const toml::node& node, std::string_view wanted);
  std::string table_name() const;

  /// A required key that is not there.
  struct Missing {
    std::string key, meaning;
  };
  std::optional<double> number(const Spelling& spelling, const Bounds& bounds);

  const bool present_;
  const toml::table& table_;
  std::string path_;
  std::string whole_ = "the scenario";
  Axis axis_;
  Diagnostics& faults_;
  Location here_;
  bool knows_all_ = true;
  std::vector<std::string> valid_;
  std::vector<Missing> missing_;
};

inline constexpr std::string_view must_be_whole = "must be a whole number";
/// "must be greater than 0 kg m^2": the rule that a field's bounds state, in its unit.
std::string rule(const Bounds& bounds, const Unit& unit);
/// "0.25 N m", a pure number without its unit.
std::string quantity(double si, const Unit& unit);

}  // namespace wormdrive
