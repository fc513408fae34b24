#include <chrono>
#include <filesystem>
#include <thread>

#include "cli/bad_input.hpp"

// What the program prints to be typed again can be pasted into a shell, and files may be called anything.

namespace wormdrive::test::cli_shell_words {

namespace {

using namespace std::chrono_literals;

const std::string odd_names[] = {"two words", "it's $HOME", "a\"b;c&d\te", "-{a,b}!"};

/// Gives a line to a shell in a folder, with the program of this build for `wormdrive`.
Outcome typed(const Folder& folder, const std::string& line) {
  const std::string program = WORMDRIVE_PROGRAM;
  return Process({"/bin/sh", "-c", "wormdrive() { '" + program + "' \"$@\"; }; " + line}, folder.path()).wait();
}

/// What stands behind some words in a text, up to the end of the line.
std::string behind(const std::string& words, const std::string& text) {
  const std::size_t at = text.find(words);
  if (at == std::string::npos) return "";
  return text.substr(at + words.size(), text.find('\n', at) - at - words.size());
}

}  // namespace

TEST_CASE("the way to see a result can be pasted, whatever the result is called", "[slow]") {
  for (const std::string& name : odd_names) {
    const Folder folder;
    folder.write("s.toml", good_scenario);
    const Outcome run = folder.run({"run", "s.toml", "--output=" + name + ".h5"});
    INFO(run.out << run.err);
    REQUIRE(run.exit == 0);
    const Outcome seen = typed(folder, behind("see it: ", run.out));
    INFO(seen.err);
    CHECK(seen.exit == 0);
    CHECK(std::filesystem::exists(folder / (name + ".png")));
  }
}

TEST_CASE("a file named like an option is drawn after --, and so is its picture", "[slow]") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  REQUIRE(folder.run({"run", "s.toml", "-q", "--output=-x.h5"}).exit == 0);
  const Outcome plain = folder.run({"plot", "--", "-x.h5"});
  INFO(plain.err);
  CHECK(plain.exit == 0);
  CHECK(std::filesystem::exists(folder / "-x.png"));
  CHECK(folder.run({"plot", "--output=--over.png", "--over", "motor_torque", "--", "-x.h5", "-x.h5"}).exit == 0);
  CHECK(std::filesystem::exists(folder / "--over.png"));
  CHECK(folder.run({"report", "--", "-x.h5"}).exit == 0);
}

TEST_CASE("the command that continues a sweep can be pasted, whatever its files are called") {
  for (const std::string name : {"it's two words", "a\"b;c", "-x"}) {
    const Folder folder;
    folder.write("s.toml", good_scenario);
    folder.write(name + ".toml",
                 "scenario = \"s.toml\"\nset = [\"run.solver=taylor\"]\n"
                 "[sweep]\ndesign = \"monte_carlo\"\ntrials = 2000000\nseed = 1\n"
                 "[[parameter]]\npath = \"mesh.friction\"\ndistribution = \"uniform\"\nlow = 0.2\nhigh = 0.3\n");
    Process sweep({WORMDRIVE_PROGRAM, "sweep", "--output=" + name + ".h5", "--", name + ".toml"}, folder.path());
    for (int k = 0; k < 3000 && !std::filesystem::exists(folder / (name + ".h5.part")); ++k)
      std::this_thread::sleep_for(10ms);
    std::this_thread::sleep_for(200ms);
    sweep.kill(SIGINT);
    const Outcome stopped = sweep.wait();
    INFO(stopped.err);
    const std::string again = behind("continue with: wormdrive ", stopped.err);
    REQUIRE(!again.empty());
    CHECK(Process({"/bin/sh", "-c", "printf '%s\\n' " + again}, folder.path()).wait().out ==
          "sweep\n--output=" + name + ".h5\n--resume\n--\n" + name + ".toml\n");
  }
}

}  // namespace wormdrive::test::cli_shell_words
