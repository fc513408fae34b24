// A file may be a pipe, as of a shell's <(...): it gives its text once, to whoever opens it first.
#include <sys/stat.h>

#include "catch.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::cli_named_pipe {

TEST_CASE("a scenario or study is opened once, so that it may come through a named pipe") {
  struct Reader {
    std::string text;
    std::vector<std::string> words;
  };
  const std::string study = study_but("trials = 200", "trials = 5");
  const Reader readers[] = {{good_scenario, {"check", "pipe"}},
                            {good_scenario, {"run", "pipe", "-o", "o.h5"}},
                            {good_scenario, {"statics", "pipe"}},
                            {good_scenario, {"steady", "pipe"}},
                            {good_scenario, {"fmu", "pipe", "-o", "o.fmu"}},
                            {good_scenario, {"diagnose", "pipe", "no.csv", "-o", "o"}},
                            {study, {"sweep", "pipe", "-o", "o.h5"}}};
  for (const auto& [text, words] : readers) {
    const StudyFolder folder(text);
    REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
    Process writer({"/usr/bin/timeout", "60", "/bin/cp", "study.toml", "pipe"}, folder.path());
    std::vector<std::string> limited{"/usr/bin/timeout", "60", WORMDRIVE_PROGRAM};
    limited.insert(limited.end(), words.begin(), words.end());
    const Outcome outcome = Process(limited, folder.path()).wait();
    INFO(words.front() << ": " << outcome.err);
    CHECK(writer.wait().exit == 0);
    if (words.front() == "diagnose")
      CHECK(outcome.err == "no.csv: error: cannot be read: No such file or directory\n");
    else
      CHECK(outcome.exit == 0);
  }
}

}  // namespace wormdrive::test::cli_named_pipe
