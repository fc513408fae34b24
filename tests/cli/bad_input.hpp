#pragma once
// Bad input as a table: what is wrong, and word for word what the program says about it.
#include <cstdlib>
#include <iterator>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/program.hpp"

namespace wormdrive::test {

struct BadInput {
  std::string name;
  std::string scenario;  ///< written to s.toml; nothing is written if empty
  std::string message;   ///< all of stderr without its last line break; "*" at its end stands for any words
  std::vector<std::string> words = {};  ///< of the command after `wormdrive run s.toml`, or all of them with `alone`
  bool alone = false;
  int exit = 2;
};

/// Whether a message is the expected one; a "*" at its end stands for some more words on the same line.
inline bool says(const std::string& expected, const std::string& message) {
  if (!expected.ends_with('*')) return message == expected + "\n";
  const std::string start = expected.substr(0, expected.size() - 1);
  return message.starts_with(start) && message.size() > start.size() + 1 && message.find('\n') == message.size() - 1;
}

/// Bytes as hexadecimal digits: scenarios here need not be UTF-8.
inline std::string hexadecimal(const std::string& bytes) {
  std::string text;
  for (const unsigned char byte : bytes) text += {"0123456789abcdef"[byte >> 4], "0123456789abcdef"[byte & 15]};
  return text;
}

/// Appends the cases that are `wormdrive run s.toml` to a file, one JSON object a line, with the other files of the
/// folder: the tests of the Python module ask the same of it.
inline void list_cases(const std::string& file, const Folder& folder, const std::vector<BadInput>& cases) {
  nlohmann::json beside = nlohmann::json::object();
  for (const std::string& name : folder.names())
    if (std::filesystem::is_regular_file(folder / name)) beside[name] = hexadecimal(folder.read(name));
  std::ofstream out(file, std::ios::app);
  for (const BadInput& bad : cases)
    if (!bad.alone && bad.words.empty() && bad.exit == 2 && !bad.scenario.empty())
      out << nlohmann::json{{"name", bad.name},
                            {"scenario", hexadecimal(bad.scenario)},
                            {"message", bad.message},
                            {"beside", beside}}
          << '\n';
}

/// Runs every case in the folder and checks message, exit code, and that no file came or went.
inline void check_rejected(const Folder& folder, const std::vector<BadInput>& cases) {
  if (const char* file = std::getenv("WORMDRIVE_LIST_CASES")) return list_cases(file, folder, cases);
  for (const BadInput& bad : cases) {
    if (!bad.scenario.empty()) folder.write("s.toml", bad.scenario);
    std::vector<std::string> words = bad.words;
    if (!bad.alone) words.insert(words.begin(), {"run", "s.toml"});
    const std::set<std::string> before = folder.names();
    const Outcome outcome = folder.run(words);
    INFO("case: " << bad.name << "\nexpected:\n" << bad.message << "\nfound:\n" << outcome.err);
    CHECK(says(bad.message, outcome.err));
    CHECK(outcome.exit == bad.exit);
    CHECK(folder.names() == before);
  }
}

}  // namespace wormdrive::test
