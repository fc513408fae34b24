#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/logger.hpp"
#include "recovery/truth/hidden.hpp"
#include "some_of.hpp"

// The verdict on a drive is the same whether its log is clean, lacks rows, paused, or has times that are not even.

namespace wormdrive::test::diagnosis_uneven_verdicts {

namespace {

truth::Drive bench(const char* hidden = nullptr, double size = 0.0) {
  truth::Drive drive;
  drive.sensor.counts = 16384;
  truth::Generator generator(1);
  if (hidden) truth::secret(hidden).hide(drive, size, generator);
  return drive;
}

struct Log {
  std::string name;
  Logger logger{};
  std::function<void(Sheet&)> spoil = [](Sheet&) {};
};

void pause(Sheet& sheet, double from, double to) {
  std::erase_if(sheet.rows, [&](const auto& row) {
    const double t = std::stod(row[0]);
    return t > from && t < to;
  });
}

std::vector<Log> logs() {
  const Logger at_2ms{.period = 2e-3, .seed = 2};
  const auto jittered = [&](double period, double jitter) {
    Logger logger = at_2ms;
    logger.period = period;
    logger.jitter = jitter;
    return logger;
  };
  return some_of(std::vector<Log>{{"runs of four rows missing", at_2ms, [](Sheet& s) { lose(s, 0.05, 4); }},
                                  {"half a second missing", at_2ms, [](Sheet& s) { pause(s, 2.1, 2.6); }},
                                  {"jitter of 20 % at 1 kHz", jittered(1e-3, 0.2)},
                                  {"jitter of 20 % at 200 Hz", jittered(5e-3, 0.2)},
                                  {"clean", at_2ms},
                                  {"one row in twenty missing", at_2ms, [](Sheet& s) { lose(s, 0.05, 1); }},
                                  {"runs of thirty rows missing", at_2ms, [](Sheet& s) { lose(s, 0.05, 30); }},
                                  {"jitter of 1 %", jittered(2e-3, 0.01)},
                                  {"jitter of 5 %", jittered(2e-3, 0.05)},
                                  {"jitter of 20 %", jittered(2e-3, 0.2)}},
                 4);
}

Recording taken(const Log& log, const truth::Drive& drive) {
  Sheet sheet = log.logger.write(drive);
  log.spoil(sheet);
  return read(Folder(), sheet);
}

std::vector<std::string> causes(const Diagnosis& d) {
  std::vector<std::string> all;
  for (const EstimatedEffect& cause : d.causes) all.push_back(cause.effect);
  return all;
}

const DiagnosisSettings settings{.threads = 2};

}  // namespace

TEST_CASE("nothing hidden: nothing is found in any log", "[slow][cases]") {
  for (const Log& log : logs()) {
    const Diagnosis d = diagnose(nominal_arm(), {taken(log, bench())}, settings);
    INFO(log.name << ": " << d.sentence);
    CHECK(d.verdict == Verdict::adequate);
  }
}

TEST_CASE("a hidden friction is named in every log, with the same size", "[slow][cases]") {
  for (const Log& log : logs()) {
    const Diagnosis d = diagnose(nominal_arm(), {taken(log, bench("worm_viscous", 9e-5))}, settings);
    INFO(log.name << ": " << d.sentence);
    CHECK(d.verdict == Verdict::named);
    REQUIRE(causes(d) == std::vector<std::string>{"worm_viscous"});
    CHECK(std::abs(d.causes[0].parameters[0].value / 9e-5 - 1.0) < 0.03);
  }
}

TEST_CASE("recordings of different rates are diagnosed together", "[slow]") {
  const auto both = [](const truth::Drive& drive) {
    return std::vector<Recording>{taken({"", {.period = 1e-3, .seed = 3}}, drive),
                                  taken({"", {.period = 5e-3, .seed = 4}}, drive)};
  };
  const Diagnosis nothing = diagnose(nominal_arm(), both(bench()), settings);
  INFO(nothing.sentence);
  CHECK(nothing.verdict == Verdict::adequate);
  const Diagnosis friction = diagnose(nominal_arm(), both(bench("worm_viscous", 9e-5)), settings);
  INFO(friction.sentence);
  CHECK(friction.verdict == Verdict::named);
  CHECK(causes(friction) == std::vector<std::string>{"worm_viscous"});
}

}  // namespace wormdrive::test::diagnosis_uneven_verdicts
