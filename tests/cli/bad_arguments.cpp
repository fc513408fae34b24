// One malformed input per line:
// clang-format off
#include "cli/bad_input.hpp"

// What the program says about words on its command line, and about files that it is given instead of scenarios.

namespace wormdrive::test::cli_bad_arguments {

namespace {

BadInput set(const std::string& name, const std::string& assignment, const std::string& message) {
  return {name, good_scenario, "--set " + message, {"--set", assignment}};
}

/// An HDF5 file with one text attribute.
void write_hdf5(const std::string& path, const std::string& attribute, const std::string& value) {
  const wormdrive::Hdf5Handle file = wormdrive::create_hdf5(path);
  write_attribute(file, attribute, value);
}

}  // namespace

TEST_CASE("an override that cannot be applied is quoted in its message") {
  check_rejected(Folder(), {
      set("no =", "mesh.ratio", "mesh.ratio: error: no '='; write table.key=value"),
      set("no key", "=3", "=3: error: an empty key; write table.key=value"),
      set("no last key", "mesh.=3", "mesh.=3: error: an empty key; write table.key=value"),
      set("no table", ".ratio=3", ".ratio=3: error: an empty key; write table.key=value"),
      set("unknown key", "mesh.ratoi=3", "mesh.ratoi=3: error: unknown key 'ratoi' in [mesh]; did you mean 'ratio'?"),
      set("unknown table", "meshes.ratio=3", "meshes.ratio=3: error: unknown table 'meshes' in the scenario; did you mean 'mesh'?"),
      set("unknown effect", "effect.worm_colomb.torque_Nm=1",
          "effect.worm_colomb.torque_Nm=1: error: unknown table 'worm_colomb' in [effect]; did you mean 'worm_coulomb'?"),
      set("half an effect", "effect.worm_coulomb.on=true",
          "effect.worm_coulomb.on=true: error: [effect.worm_coulomb] lacks 'torque_Nm' (friction torque while the worm turns)"),
      set("wrong type", "mesh.ratio=fast", "mesh.ratio=fast: error: mesh.ratio must be a number, not a string"),
      set("nothing", "mesh.ratio=", "mesh.ratio=: error: mesh.ratio must be a number, not a string"),
      set("table replaced", "mesh=3", "mesh=3: error: mesh must be a table, not a number"),
      set("out of bounds", "mesh.ratio=-1", "mesh.ratio=-1: error: mesh.ratio = -1 must be greater than 0"),
      set("no array", "motor.torque[2].torque_Nm=3",
          "motor.torque[2].torque_Nm=3: error: motor.torque is not an array; leave out the index [2]"),
      set("no index", "motor.torque[x].torque_Nm=3",
          "motor.torque[x].torque_Nm=3: error: 'torque[x]' does not end with an index like [0]"),
      set("index not closed", "motor.torque[0.torque_Nm=3",
          "motor.torque[0.torque_Nm=3: error: 'torque[0' does not end with an index like [0]"),
      set("number for a table", "mesh.ratio.of=3", "mesh.ratio.of=3: error: mesh.ratio is not a table"),
      set("two lines", "mesh.ratio=3\nmesh.friction=9", "mesh.ratio=3 mesh.friction=9: error: mesh.ratio must be a number, not a string"),
      set("invalid UTF-8", "title=\xff", "title=\xff: error: neither a TOML value nor plain text: *")});
}

TEST_CASE("the message on a bad index gives the number of elements") {
  const std::string two = good_but("[motor.torque]", "[[motor.torque]]\nkind = \"ramp\"\nrate_Nm_per_s = 1\n[[motor.torque]]");
  check_rejected(Folder(), {
      {"no such element", two, "--set motor.torque[2].torque_Nm=3: error: motor.torque has no element [2], counted from 0; it has 2",
       {"--set", "motor.torque[2].torque_Nm=3"}},
      {"no index", two, "--set motor.torque.torque_Nm=3: error: motor.torque is an array; name one of its elements, as in motor.torque[0]",
       {"--set", "motor.torque.torque_Nm=3"}}});
}

TEST_CASE("a file that is not a scenario is reported by name") {
  const Folder folder;
  std::filesystem::create_directory(folder / "folder");
  write_hdf5(folder / "other.h5", "author", "somebody");
  write_hdf5(folder / "fault.h5", "scenario", edited(good_scenario, "ratio = 60", "ratio = 0"));
  folder.write("cut.h5", "\x89HDF\r\n\x1a\n and no more");
  const std::string long_name(300, 'a');
  for (const std::string command : {"run", "check", "statics", "steady"})
    check_rejected(folder, {
        {"missing", "", "no.toml: error: cannot be read: No such file or directory", {command, "no.toml"}, true},
        {"folder", "", "folder: error: cannot be read: it is a directory", {command, "folder"}, true},
        {"a device without end", "", "/dev/zero:1:1: error: a NUL byte; a scenario is plain text or a result file (.h5)", {command, "/dev/zero"}, true},
        {"name too long", "", long_name + ": error: cannot be read: File name too long", {command, long_name}, true},
        {"HDF5 without a scenario", "", "other.h5: error: it is not a wormdrive result: it has no attribute 'scenario'", {command, "other.h5"}, true},
        {"HDF5 cut off", "", "cut.h5: error: it cannot be opened as *", {command, "cut.h5"}, true},
        {"HDF5 with a faulty scenario", "", "fault.h5:3:9: error: mesh.ratio = 0 must be greater than 0", {command, "fault.h5"}, true}});
}

TEST_CASE("an HDF5 attribute that is not a single text is not a scenario") {
  const Folder folder;
  {
    const wormdrive::Hdf5Handle numbers = wormdrive::create_hdf5(folder / "number.h5");
    wormdrive::write_attribute(numbers, "scenario", 3.0);
    const wormdrive::Hdf5Handle list = wormdrive::create_hdf5(folder / "list.h5");
    const hsize_t three = 3;
    const char* const texts[] = {"a", "b", "c"};
    const wormdrive::Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "type"), space(H5Screate_simple(1, &three, nullptr), H5Sclose, "space");
    H5Tset_size(type, H5T_VARIABLE);
    const wormdrive::Hdf5Handle attribute(H5Acreate2(list, "scenario", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "attribute");
    H5Awrite(attribute, type, texts);
  }
  for (const std::string file : {"number.h5", "list.h5"})
    check_rejected(folder, {{file, "", file + ": error: it is not a wormdrive result: its attribute 'scenario' is not a text", {"check", file}, true}});
}

TEST_CASE("unknown commands and unexpected arguments end with exit code 2") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  check_rejected(folder, {{"unknown command", "", "wormdrive: error: unknown command 'simulate'; the commands are new, list, check, schema, run, view, statics, steady, efficiency, fmu, plot, report, diff, export, sweep, summary, worst, rare, replay, merge, diagnose",
                       {"simulate", "s.toml"}, true},
                      {"misspelled command", "", "wormdrive: error: unknown command 'rum'; did you mean 'run'?", {"rum", "s.toml"}, true},
                      {"no command", "", "wormdrive: error: a command is required; see wormdrive --help or docs/howto/first_simulation.md", {}, true},
                      {"no scenario", "", "wormdrive run: error: scenario is required; see wormdrive run --help or docs/howto/first_simulation.md", {"run"}, true},
                      {"no data", "", "wormdrive diagnose: error: data is required; see wormdrive diagnose --help or docs/howto/first_diagnosis.md", {"diagnose", "s.toml"}, true},
                      {"no result", "", "wormdrive plot: error: files is required; see wormdrive plot --help", {"plot"}, true},
                      {"unknown option", "", "wormdrive run: error: The following argument was not expected: --fast; see wormdrive run --help or docs/howto/first_simulation.md",
                       {"run", "s.toml", "--fast"}, true},
                      {"a study", "[sweep]\ntrials = 3\n",
                       "s.toml: error: this is a study, for wormdrive sweep; the scenario is the file that it names", {"run", "s.toml"}, true},
                      {"no study", good_scenario,
                       "s.toml: error: this is a scenario, for wormdrive run; a sweep needs a study, which names the scenario: scenario = \"FILE.toml\", [sweep], [[parameter]]; see docs/howto/first_sweep.md",
                       {"sweep", "s.toml"}, true},
                      {"statics without teeth", "[mesh]\nkind = \"none\"\ninertia_kgm2 = 1\n",
                       "s.toml: error: statics needs teeth, but mesh.kind is \"none\"", {"statics", "s.toml"}, true}});
  struct Misuse {
    std::vector<std::string> words;
    std::string named;
  };
  for (const Misuse& misuse : {Misuse{{"run", "s.toml", "s.toml"}, "s.toml"},
                               {{"run", "s.toml", "--set"}, "--set"}, {{"statics", "s.toml", "--points", "1"}, "--points"},
                               {{"statics", "s.toml", "--max-load", "-1"}, "--max-load: '-1' is not a number greater than 0"},
                               {{"steady", "s.toml", "--max-speed", "inf"}, "--max-speed: 'inf' is not a number greater than 0"},
                               {{"list", "colours"}, "colours"}, {{"list"}, "required"}, {{"plot"}, "required"}}) {
    const Outcome outcome = folder.run(misuse.words);
    INFO(outcome.err << "expected: " << misuse.named);
    CHECK(outcome.exit == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find(misuse.named) != std::string::npos);
    CHECK(folder.names() == std::set<std::string>{"s.toml"});
  }
}

TEST_CASE("files that are not HDF5 are rejected in the same words by every command, each file once") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  folder.write("t.toml", good_scenario);
  const std::string words = ": error: not an HDF5 file; wormdrive run writes one",
                    both = "s.toml" + words + "\nt.toml" + words;
  check_rejected(folder, {{"plot", "", both, {"plot", "s.toml", "t.toml", "-o", "p.png"}, true},
                          {"diff", "", both, {"diff", "s.toml", "t.toml"}, true},
                          {"report", "", "s.toml" + words, {"report", "s.toml"}, true}});
}

TEST_CASE("plot rejects files that are not results") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  std::filesystem::create_directory(folder / "folder");
  write_hdf5(folder / "other.h5", "author", "somebody");
  check_rejected(folder, {
      {"missing", "", "no.h5: error: cannot be read: No such file or directory", {"plot", "no.h5"}, true},
      {"folder", "", "folder: error: cannot be read: it is a directory", {"plot", "folder"}, true}});
  const Outcome outcome = folder.run({"plot", "other.h5"});
  INFO(outcome.err);
  CHECK(outcome.exit == 2);
  CHECK(outcome.err == "other.h5: error: it has no attribute 'kind'\n");
  CHECK(folder.names() == std::set<std::string>{"folder", "other.h5", "s.toml"});
}

}  // namespace wormdrive::test::cli_bad_arguments
