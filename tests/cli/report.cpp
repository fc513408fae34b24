// The page that `wormdrive report` writes, without a browser.
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "cli/bad_input.hpp"

using namespace wormdrive;
using namespace wormdrive::test;

namespace {

/// The data in a page.
nlohmann::json data_in(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

}  // namespace

TEST_CASE("a report holds its run, and itself only") {
  const Folder folder;
  REQUIRE(folder.run({"run", shipped("fig09_switching.toml"), "-q", "--set", "title=\"</script> & <b>\""}).exit == 0);
  REQUIRE(folder.run({"report", "fig09_switching.h5"}).exit == 0);
  const std::string page = folder.read("fig09_switching.html");
  CHECK(folder.names() == std::set<std::string>{"fig09_switching.h5", "fig09_switching.html"});
  CHECK(page.size() < 1'000'000);
  CHECK(page.find("src=\"") == std::string::npos);
  CHECK(page.find("<title>&lt;/script&gt; &amp; &lt;b&gt;</title>") != std::string::npos);
  CHECK(page.find("Copyright (c) 2006, 2009, 2011, 2012, 2013, 2017") != std::string::npos);  // of dygraphs
  for (const std::string mark : {"{{page", "{{data", "{{dygraphs", "{{title"})
    CHECK(page.find(mark) == std::string::npos);
  const nlohmann::json data = data_in(page);
  CHECK(data.at("title") == "</script> & <b>");
  CHECK(data.at("events").size() == 12);
  CHECK(data.at("events")[0].at("kind") == "break_away");
  CHECK(data.at("trajectory").at("shown") == data.at("trajectory").at("rows"));
  CHECK(data.at("warnings").size() == 1);
}

TEST_CASE("a long run is thinned without losing an extreme") {
  const Folder folder;
  REQUIRE(folder
              .run({"run", shipped("fig09_switching.toml"), "-q", "-o", "a.h5", "--set", "run.report_interval_s=2e-5",
                    "--set", "run.solver=taylor"})
              .exit == 0);
  REQUIRE(folder.run({"report", "a.h5"}).exit == 0);
  const nlohmann::json trajectory = data_in(folder.read("a.html")).at("trajectory");
  const Hdf5Handle file = open_hdf5(folder / "a.h5");
  CHECK(trajectory.at("rows").get<int>() > 100000);
  CHECK(trajectory.at("shown").get<int>() < 40000);
  for (const nlohmann::json& column : trajectory.at("columns")) {
    const std::vector<double> all = read_column(file, "trajectory/" + column.at("name").get<std::string>());
    const auto shown = column.at("values").get<std::vector<double>>();
    INFO(column.at("name"));
    CHECK(std::abs(*std::max_element(shown.begin(), shown.end()) - *std::max_element(all.begin(), all.end())) < 1e-6);
    CHECK(std::abs(*std::min_element(shown.begin(), shown.end()) - *std::min_element(all.begin(), all.end())) < 1e-6);
  }
}

TEST_CASE("what is no run gets no report") {
  const Folder folder;
  folder.write("s.toml", good_scenario);
  REQUIRE(folder.run({"statics", "s.toml", "-q", "-o", "map.h5"}).exit == 0);
  refuse_all(
      folder,
      {{"statics", "", "map.h5: error: is the result of 'statics'; a report shows a run", {"report", "map.h5"}, true},
       {"a scenario",
        "",
        "s.toml: error: is no result file (HDF5); wormdrive run writes one",
        {"report", "s.toml"},
        true}});
}
