// One malformed input per line:
// clang-format off
#include <fcntl.h>
#include <sys/file.h>

#include "cli/bad_input.hpp"

// Results that cannot be written: exit code 4, one line, and no trace of the attempt.

namespace wormdrive::test::cli_bad_outputs {

namespace {

/// The commands that write results, without the name of the result.
const std::vector<std::vector<std::string>> writers{
    {"run", "s.toml", "-q"}, {"statics", "s.toml", "-q"}, {"steady", "s.toml", "-q"}};

BadInput into(const std::vector<std::string>& writer, const std::string& output, const std::string& message, int exit) {
  std::vector<std::string> words = writer;
  words.insert(words.end(), {"-o", output});
  return {writer.front() + " into " + output, "", message, words, true, exit};
}

}  // namespace

TEST_CASE("a place where no result can be written is reported, and nothing there is touched") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  folder.write("notes.csv", "a,b\n1,2\n");
  std::filesystem::create_directory(folder / "folder");
  std::filesystem::create_directory(folder / "taken.h5.part");
  const std::string long_name(300, 'a');
  for (const auto& writer : writers)
    check_rejected(folder, {
        into(writer, "no/r.h5", "wormdrive: cannot create no/r.h5.part: No such file or directory", 4),
        into(writer, "folder", "wormdrive: cannot write folder: it is not a plain file", 4),
        into(writer, "/dev/full", "wormdrive: cannot write /dev/full: it is not a plain file", 4),
        into(writer, "taken.h5", "wormdrive: cannot create taken.h5.part: Is a directory", 4),
        into(writer, long_name, "wormdrive: cannot create " + long_name + ".part: File name too long", 4),
        into(writer, "notes.csv", "wormdrive: cannot write notes.csv: it exists and is not an HDF5 file; choose another name, or replace it with --force", 4),
        into(writer, "./s.toml", "./s.toml: error: the result would overwrite s.toml; choose another --output", 2)});
  CHECK(folder.read("s.toml") == good_scenario);
  CHECK(folder.read("notes.csv") == "a,b\n1,2\n");
}

TEST_CASE("a run does not overwrite the result that it is read from, nor its part") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  REQUIRE(folder.run({"run", "s.toml", "-q"}).exit == 0);
  std::filesystem::copy(folder / "s.h5", folder / "t.h5.part");
  const std::string result = folder.read("s.h5");
  check_rejected(folder, {
      {"result", "", "s.h5: error: the result would overwrite s.h5; choose another --output", {"run", "s.h5", "-o", "s.h5"}, true},
      {"part", "", "t.h5: error: the result would overwrite t.h5.part; choose another --output", {"run", "t.h5.part", "-o", "t.h5"}, true}});
  CHECK(folder.read("s.h5") == result);
  CHECK(folder.read("t.h5.part") == result);
}

TEST_CASE("steady does not overwrite its data") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  const std::string data = "record,worm_speed_rad_per_s,motor_torque_Nm\na,1,0.01\n";
  folder.write("d.csv", data);
  check_rejected(folder, {{"data", "", "d.csv: error: the result would overwrite d.csv; choose another --output",
                       {"steady", "s.toml", "--data", "d.csv", "-o", "d.csv"}, true}});
  CHECK(folder.read("d.csv") == data);
}

TEST_CASE("a result that another program is writing is not touched") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  REQUIRE(folder.run({"run", "s.toml", "-q", "-o", "r.h5"}).exit == 0);
  std::filesystem::rename(folder / "r.h5", folder / "r.h5.part");
  const std::string part = folder.read("r.h5.part");
  const int other = open((folder / "r.h5.part").c_str(), O_RDWR);
  REQUIRE(flock(other, LOCK_EX) == 0);
  check_rejected(folder, {{"locked", "", "wormdrive: cannot write r.h5.part: another program is writing it", {"run", "s.toml", "-q", "-o", "r.h5"}, true, 4}});
  CHECK(folder.read("r.h5.part") == part);
  close(other);
  CHECK(folder.run({"run", "s.toml", "-q", "-o", "r.h5"}).exit == 0);  // a part that nobody writes is from a run that died
  CHECK(folder.names() == std::set<std::string>{"r.h5", "s.toml"});
}

TEST_CASE("an older result stays until a new one is complete") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  REQUIRE(folder.run({"run", "s.toml", "-q", "-o", "r.h5"}).exit == 0);
  const std::string older = folder.read("r.h5");
  CHECK(folder.run({"run", "s.toml", "-q", "-o", "r.h5"}, older.size() / 2).exit == 4);
  CHECK(folder.read("r.h5") == older);
  CHECK(folder.names() == std::set<std::string>{"r.h5", "s.toml"});
}

// A file may not grow beyond a limit, which HDF5 meets like the end of the disk: while it creates the file and its
// tables, while it appends rows, and when it closes the file.
TEST_CASE("a full disk at any moment is reported in one line, and nothing is left behind", "[slow]") {
  const Folder folder;
  folder.write("s.toml", edited(good_scenario, "duration_s = 0.01", "duration_s = 1\nreport_interval_s = 5e-5"));
  for (const auto& writer : writers) {
    std::vector<std::string> words = writer;
    words.insert(words.end(), {"-o", "r.h5"});
    REQUIRE(folder.run(words).exit == 0);
    const auto whole = static_cast<rlim_t>(std::filesystem::file_size(folder / "r.h5"));
    std::filesystem::remove(folder / "r.h5");
    std::vector<rlim_t> limits{1, 96, 800, 2048, 5000, 20000, 40000};
#ifndef __SANITIZE_THREAD__  // which writes a file of its own before the program begins
    limits.push_back(0);
#endif
    for (int k = 1; k < 8; ++k) limits.push_back(whole * static_cast<rlim_t>(k) / 8);
    for (const rlim_t missing : {4096, 1000, 100}) limits.push_back(whole - missing);
    for (const rlim_t limit : limits) {
      if (limit >= whole) continue;
      const Outcome outcome = folder.run(words, limit);
      INFO(writer.front() << ", " << limit << " of " << whole << " bytes: " << outcome.err);
      CHECK(outcome.exit == 4);
      const bool written = outcome.err == "wormdrive: cannot write r.h5.part: File too large\n";
      CHECK((written || (limit < 800 && outcome.err == "wormdrive: cannot create r.h5.part: File too large\n")));
      CHECK(folder.names() == std::set<std::string>{"s.toml"});
    }
  }
}

}  // namespace wormdrive::test::cli_bad_outputs
