#include <iostream>

#include <fmt/format.h>

#include "cli/exit_code.hpp"
#include "cli/run_and_write.hpp"
#include "cli/shell_words.hpp"
#include "simulation/load_scenario.hpp"

// `wormdrive run SCENARIO --audit -o RESULT` and nothing else: quickstart.sh builds it before the program, so that the
// first picture need not wait for sweeps and diagnosis.

int main(int argc, char** argv) {
  using namespace wormdrive;
  if (argc != 3) {
    std::cerr << "first_run: error: a scenario and the name of its result are required\n";
    return bad_input;
  }
  RunOptions options{.scenario = {}, .output = argv[2], .audit = true};
  options.scenario.command_line =
      fmt::format("wormdrive run {} --audit -o {}", shell_word(argv[1]), shell_word(argv[2]));
  return if_printed(guarded([&] {
    run_and_write(load_scenario(argv[1], {}, Purpose::run), options.output, options);
    return 0;
  }));
}
