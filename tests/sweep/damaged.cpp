// Files of sweeps that are damaged where an unfinished one goes on are bad input, and are told as such.
#include <fcntl.h>
#include <fmt/format.h>

#include "catch.hpp"
#include "output/hdf5/fixed_table.hpp"
#include "sweep/file/sweep_file.hpp"
#include "sweep/mpirun.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_damaged {

namespace {

/// Spoils the index of the first trial of a sweep that it has, behind which it has written enough that HDF5 holds that
/// trial in no buffer any more; returns the trial.
std::size_t damage_first_trial(const StudyFolder& folder, const std::string& sweep, const std::string& part) {
  for (;; usleep(1000)) {
    REQUIRE_FALSE(folder.names().contains(sweep));  // it would be too late
    if (!folder.names().contains(part)) continue;
    const Hdf5Handle file = open_hdf5_while_written(folder / part), column = open_object(file, "trials/index");
    const std::vector<double> status = read_column(file, "trials/status");
    const auto row = static_cast<std::size_t>(
        std::find_if(status.begin(), status.end(), [](double s) { return s != 0.0; }) - status.begin());
    if (std::count(status.begin(), status.end(), 0.0) + 20000 > std::ssize(status)) continue;
    const double wrong = -1.0;
    const auto at = static_cast<off_t>(H5Dget_offset(column) + row * sizeof wrong);
    const int on_disk = open((folder / part).c_str(), O_WRONLY);
    REQUIRE(pwrite(on_disk, &wrong, sizeof wrong, at) == sizeof wrong);
    ::close(on_disk);
    return row;
  }
}

/// The name of a damage, what it does to a file, and how the file is refused.
struct Damage {
  std::string name;
  void (*damage)(hid_t file);
  std::string fault;
};

template <class... Names>
void remove(hid_t file, Names... names) {
  (H5Ldelete(file, names, H5P_DEFAULT), ...);
}

}  // namespace

TEST_CASE("what an interrupted sweep has left is looked at as a whole before it goes on", "[sweep][slow]") {
  const Damage damages[] = {
      {"no summary", [](hid_t file) { remove(file, "summary"); }, "it has no 'summary'"},
      {"a table of the summary less", [](hid_t file) { remove(file, "summary/worst"); }, "it has no 'summary/worst'"},
      {"a column of it less", [](hid_t file) { remove(file, "summary/metrics/mean"); },
       "it has no column 'summary/metrics/mean'"},
      {"a column of it too short",
       [](hid_t file) {
         remove(file, "summary/statuses");
         FixedTable::create(file, "summary/statuses", {{"status", "1", ""}, {"trials", "1", ""}}, 2);
       },
       "its column 'summary/statuses/status' has 2 rows instead of 3"},
      {"numbers for texts",
       [](hid_t file) {
         remove(file, "summary/influences/parameter");
         H5Lcreate_hard(file, "summary/influences/index", file, "summary/influences/parameter", H5P_DEFAULT,
                        H5P_DEFAULT);
       },
       "its column 'summary/influences/parameter' does not hold texts of 512 bytes"},
      {"no name of the ranking", [](hid_t file) { H5Adelete(open_object(file, "summary"), "ranked_by"); },
       "it has no attribute 'ranked_by'"},
      {"no reasons", [](hid_t file) { remove(file, "reasons"); }, "it has no 'reasons'"},
      {"few reasons",
       [](hid_t file) {
         remove(file, "reasons");
         FixedTexts::create(file, "reasons", "", 3);
       },
       "its column 'reasons' has 3 rows instead of 100"},
      {"few verdicts",
       [](hid_t file) {
         remove(file, "referee");
         FixedTable::create(file, "referee", verdict_columns(Axis::rotary), 3);
       },
       "its column 'referee/judged' has 3 rows instead of 1000"},
      {"no command", [](hid_t file) { H5Adelete(file, "command_line"); }, "it has no attribute 'command_line'"},
      {"sources that are a number",
       [](hid_t file) {
         H5Adelete(file, "sources");
         write_attribute(file, "sources", 1.0);
       },
       "its attribute 'sources' is not a text"}};
  const StudyFolder folder(study_but("trials = 200", "trials = 60000"));
  REQUIRE(folder.interrupted({"-o", "good.h5"}, SIGKILL).exit == 128 + SIGKILL);
  for (const auto& [name, damage, fault] : damages) {
    INFO(name);
    std::filesystem::copy_file(folder / "good.h5.part", folder / "o.h5.part");
    damage(reopen_hdf5(folder / "o.h5.part"));
    for (const std::vector<std::string>& words : {std::vector<std::string>{WORMDRIVE_PROGRAM, "sweep", "study.toml"},
                                                  has_mpi() ? on_ranks("2", {}) : std::vector<std::string>{}}) {
      if (words.empty()) continue;
      std::vector<std::string> resume = words;
      resume.insert(resume.end(), {"-o", "o.h5", "--resume"});
      const Outcome outcome = Process(resume, folder.path()).wait();
      CHECK(outcome.exit == 2);
      CHECK(outcome.err.starts_with("o.h5.part: error: "));
      CHECK(outcome.err.substr(0, outcome.err.find('\n')).find(fault) != std::string::npos);
    }
    std::filesystem::remove(folder / "o.h5.part");
  }
}

TEST_CASE("a file that is damaged while it is written is bad input, of a rank as of a single process",
          "[sweep][slow]") {
  const StudyFolder folder(study_but("trials = 200", "trials = 300000"));
  const auto fault = [](const std::string& part, std::size_t trial) {
    return fmt::format("{}: error: its column 'trials/index' contains -1 in the row of trial {}\n", part, trial);
  };
  {
    Process alone({WORMDRIVE_PROGRAM, "sweep", "study.toml", "-o", "alone.h5"}, folder.path());
    const std::size_t trial = damage_first_trial(folder, "alone.h5", "alone.h5.part");
    const Outcome outcome = alone.wait();
    CHECK(outcome.exit == 2);
    CHECK(outcome.err == fault("alone.h5.part", trial));
  }
  if (!has_mpi()) return;
  Process job(on_ranks("2", {"-o", "ranks.h5"}), folder.path());
  const std::size_t trial = damage_first_trial(folder, "ranks.h5", "ranks.h5.rank_1_1.part");
  const Outcome outcome = job.wait();
  CHECK(outcome.exit == 2);
  CHECK(outcome.err.starts_with(fault("ranks.h5.rank_1_1.part", trial)));
  CHECK(outcome.err.find("wormdrive") == std::string::npos);  // the rest is mpirun's
}

}  // namespace wormdrive::test::sweep_damaged
