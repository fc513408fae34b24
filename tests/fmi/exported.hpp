#pragma once
#include <optional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "fmi/importer.hpp"
#include "simulation/load_scenario.hpp"

namespace wormdrive::test {

/// A scenario exported by the program, and unpacked.
struct Exported {
  Folder folder;
  Scenario scenario;
  std::optional<Fmu> fmu;

  explicit Exported(const std::string& file, const std::vector<std::string>& overrides = {},
                    const std::vector<std::string>& options = {})
      : scenario(load_scenario(file, overrides, Purpose::run)) {
    std::vector<std::string> words{"fmu", file, "-o", "plant.fmu"};
    for (const std::string& o : overrides) words.insert(words.end(), {"--set", o});
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = folder.run(words);
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
    fmu.emplace(folder / "plant.fmu", folder);
  }
};

}  // namespace wormdrive::test
