#pragma once
// Bad input as a table: what is wrong, and word for word what the program says about it.
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

/// Runs every case in the folder and checks message, exit code, and that no file came or went.
inline void refuse_all(const Folder& folder, const std::vector<BadInput>& cases) {
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
