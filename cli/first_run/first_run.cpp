#include <iostream>

#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/shell_words.hpp"

// `wormdrive run SCENARIO --audit -o RESULT` and nothing else: quickstart.sh builds it before the program, so that the
// first picture need not wait for sweeps and diagnosis.

int main(int argc, char** argv) {
  using namespace wormdrive;
  if (argc != 3) {
    std::cerr << "first_run: error: a scenario and the name of its result are required\n";
    return bad_input;
  }
  RunOptions options;
  options.scenario.file = argv[1];
  options.scenario.command_line =
      fmt::format("wormdrive run {} --audit -o {}", shell_word(argv[1]), shell_word(argv[2]));
  options.output = argv[2];
  options.audit = true;
  return if_printed(guarded([&] { return run_command(options); }));
}
