#include "output/replacing.hpp"

#include <filesystem>

#include "catch.hpp"
#include "cli/bad_input.hpp"
#include "sweep/studies.hpp"

// What a result may take the place of, whichever command writes it.

namespace wormdrive::test::output_replacing {

namespace {

const std::string cure = "; choose another name, or replace it with --force";

/// A command that writes something, without the name of the output, and what its older outputs are called.
struct Writer {
  std::vector<std::string> words;
  std::string name;
};

/// A folder with what every command reads.
struct Bench : StudyFolder {
  Bench() {
    write(
        "table.csv",
        "load_torque_Nm,motor_torque_Nm\n0.1,0.05\n0.2,0.09\n0.3,0.12\n0.1,-0.02\n0.2,-0.04\n0.3,-0.06\n0.4,0.15\n0.4,-"
        "0.08\n");
    REQUIRE(run({"run", "s.toml", "-q", "-o", "in.h5"}).exit == 0);
    REQUIRE(sweep({"-q", "-o", "swept.h5"}).exit == 0);
    hid_t const file = H5Fcreate((*this / "theirs.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    write_attribute(file, "kind", std::string("run"));  // as others call their files too
    H5Fclose(file);
    write("notes.txt", "of somebody else\n");
  }
  Outcome into(const Writer& writer, const std::string& output, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = writer.words;
    words.insert(words.end(), {"-o", output});
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
};

const std::vector<Writer> runs{{{"run", "s.toml", "-q"}, "run"}, {{"replay", "swept.h5", "--trial", "3", "-q"}, "run"}};
const std::vector<Writer> results{{{"run", "s.toml", "-q"}, "run"},
                                  {{"replay", "swept.h5", "--trial", "3", "-q"}, "run"},
                                  {{"worst", "swept.h5", "--evaluations", "4", "-q"}, "run"},
                                  {{"statics", "s.toml", "-q"}, "statics"},
                                  {{"steady", "s.toml", "-q"}, "steady"},
                                  {{"sweep", "study.toml", "-q"}, "sweep"},
                                  {{"merge", "swept.h5", "-q"}, "sweep"}};
const std::vector<Writer> others{
    {{"report", "in.h5"}, "page"}, {{"plot", "in.h5"}, "picture"}, {{"fmu", "s.toml", "-q"}, "FMU"}};

}  // namespace

TEST_CASE("no result replaces a foreign file or a result of another kind", "[slow]") {
  const Bench bench;
  const std::string theirs = bench.read("theirs.h5"), map = "map.h5";
  REQUIRE(bench.run({"statics", "s.toml", "-q", "-o", map}).exit == 0);
  REQUIRE(bench.run({"steady", "s.toml", "-q", "-o", "curve.h5"}).exit == 0);
  const auto names = bench.names();
  for (const Writer& writer : results) {
    const auto refused = [&](const std::string& output, const std::string& why) {
      const std::string before = bench.read(output);
      const Outcome outcome = bench.into(writer, output);
      CHECK(outcome.err == "wormdrive: cannot write " + output + ": " + why + cure + "\n");
      CHECK(outcome.exit == 4);
      CHECK(bench.read(output) == before);
      CHECK(bench.names() == names);
    };
    INFO(writer.words.front());
    refused("theirs.h5", "it exists and is not a wormdrive result");
    refused("notes.txt", "it exists and is not an HDF5 file");
    if (writer.name != "statics") refused(map, "it holds a result of statics");
    if (writer.name != "steady") refused("curve.h5", "it holds a result of steady");
    if (writer.name != "run") refused("in.h5", "it holds a run");
  }
}

TEST_CASE("an older result of the same kind is replaced, and with --force anything", "[slow]") {
  const Bench bench;
  for (const Writer& writer : results) {
    INFO(writer.words.front());
    const std::string output = writer.words.front() + ".h5";
    CHECK(bench.into(writer, output).exit == 0);
    const Outcome again = bench.into(writer, output);
    if (writer.words.front() == "sweep")  // a merge of the same sweep loses nothing
      CHECK(again.err == "wormdrive: cannot write " + output + ": it holds a finished sweep" + cure + "\n");
    else
      CHECK(again.exit == 0);
    CHECK(bench.into(writer, output, {"--force"}).exit == 0);
    bench.write("notes.txt", "of somebody else\n");
    CHECK(bench.into(writer, "notes.txt", {"--force"}).exit == 0);
    CHECK(is_hdf5(bench / "notes.txt"));
  }
}

TEST_CASE("pages, pictures and FMUs replace only their like", "[slow]") {
  const Bench bench;
  for (const Writer& writer : others) {
    INFO(writer.words.front());
    for (const std::string theirs : {"theirs.h5", "notes.txt", "in.h5"}) {
      if (theirs == "in.h5" && writer.name != "FMU") continue;  // which they read
      const std::string before = bench.read(theirs);
      const Outcome outcome = bench.into(writer, theirs);
      INFO(outcome.err);
      CHECK(outcome.exit == 4);
      CHECK(outcome.err.ends_with(cure + "\n"));
      CHECK(bench.read(theirs) == before);
    }
    const std::string output = "mine." + writer.words.front();
    CHECK(bench.into(writer, output).exit == 0);
    CHECK(bench.into(writer, output).exit == 0);
    CHECK(bench.into(writer, "notes.txt", {"--force"}).exit == 0);
    CHECK(bench.read("notes.txt").size() > 100);
    bench.write("notes.txt", "of somebody else\n");
  }
  for (const std::string& name : bench.names()) CHECK_FALSE(name.ends_with(".part"));
}

TEST_CASE("a diagnosis does not replace foreign files in its folder") {
  const Bench bench;
  std::filesystem::create_directory(bench / "found");
  bench.write("found/extended.toml", "# of somebody else\n");
  const std::vector<std::string> words{
      "diagnose", shipped("fig07_break_in_07cm_forward.toml"), "table.csv", "-q", "--no-pictures", "-o", "found"};
  const Outcome refused = bench.run(words);
  CHECK(refused.err ==
        "wormdrive: cannot write found/extended.toml: it exists and is not of a diagnosis; choose another folder, or "
        "replace it with --force\n");
  CHECK(refused.exit == 4);
  CHECK(bench.read("found/extended.toml") == "# of somebody else\n");
}

TEST_CASE("the part of another command's result is not overwritten") {
  const Bench bench;
  std::filesystem::copy(bench / "swept.h5", bench / "r.h5.part");
  const std::string part = bench.read("r.h5.part");
  const auto refused = [&](const std::vector<std::string>& words, const std::string& message) {
    const Outcome outcome = bench.run(words);
    CHECK(outcome.err == message + "\n");
    CHECK(bench.read("r.h5.part") == part);
  };
  refused({"run", "s.toml", "-q", "-o", "r.h5"}, "wormdrive: cannot write r.h5.part: it holds a sweep" + cure);
  bench.write("t.h5.part", "of somebody else\n");
  const Outcome text = bench.run({"run", "s.toml", "-q", "-o", "t.h5"});
  CHECK(text.err == "wormdrive: cannot write t.h5.part: it exists and is not an HDF5 file" + cure + "\n");
  CHECK(bench.run({"run", "s.toml", "-q", "-o", "r.h5", "--force"}).exit == 0);
  CHECK_FALSE(bench.names().contains("r.h5.part"));
}

TEST_CASE("an output that is a symbolic link remains one; its target is written", "[slow]") {
  const Bench bench;
  std::filesystem::create_directory(bench / "there");
  auto writers = others;
  writers.insert(writers.end(), results.begin(), results.end());
  for (const Writer& writer : writers) {
    INFO(writer.words.front());
    const std::string link = writer.words.front() + ".link", target = "there/" + writer.words.front();
    std::filesystem::create_symlink(target, bench / link);  // to nothing yet
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--force"}}) {
      const Outcome outcome = bench.into(writer, link, more);
      INFO(outcome.err);
      CHECK(outcome.exit == 0);
      CHECK(std::filesystem::is_symlink(bench / link));
      CHECK(std::filesystem::is_regular_file(bench / target));
      CHECK_FALSE(std::filesystem::is_symlink(bench / target));
      CHECK(bench.read(target).size() > 100);
    }
    CHECK_FALSE(bench.names().contains(link + ".part"));
  }
}

TEST_CASE("a part that is a symbolic link is not followed, and circular links are reported") {
  const Bench bench;
  std::filesystem::create_symlink(bench / "notes.txt", bench / "r.h5.part");
  std::filesystem::create_symlink(bench / "round.h5", bench / "round.h5");
  for (const Writer& writer : runs) {
    CHECK(bench.into(writer, "r.h5", {"--force"}).err == "wormdrive: cannot write r.h5.part: it is a symbolic link\n");
    CHECK(bench.into(writer, "round.h5").err ==
          "wormdrive: cannot write round.h5: Too many levels of symbolic links\n");
  }
  CHECK(bench.read("notes.txt") == "of somebody else\n");
}

TEST_CASE("a finished sweep is kept, resumed or replaced, as the options say") {
  const StudyFolder folder;
  REQUIRE(folder.sweep({"-q", "-o", "o.h5"}).exit == 0);
  const auto rows = folder.rows("o.h5");
  folder.write("study.toml", study_but("seed = 3", "seed = 4"));
  const Outcome again = folder.sweep({"-q", "-o", "o.h5"});
  CHECK(again.exit == 4);
  CHECK(folder.rows("o.h5") == rows);
  REQUIRE(folder.sweep({"-q", "-o", "other.h5"}).exit == 0);
  CHECK(folder.run({"merge", "other.h5", "-q", "-o", "o.h5"}).err ==
        "wormdrive: cannot write o.h5: it holds a finished sweep" + cure + "\n");
  CHECK(folder.rows("o.h5") == rows);
  CHECK_FALSE(folder.names().contains("o.h5.part"));
  CHECK(folder.sweep({"-q", "-o", "o.h5", "--force"}).exit == 0);
  CHECK_FALSE(folder.rows("o.h5") == rows);
  CHECK(folder.sweep({"-q", "-o", "o.h5", "--resume"}).exit == 0);
}

}  // namespace wormdrive::test::output_replacing
