#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/diagnose.hpp"
#include "recovery/campaign.hpp"

// Recordings of the recovery tests' own drive that once led a diagnosis astray, each for its own reason. Most take ten
// seconds of two processors each and run with the target long_tests alone, after any change to a diagnosis.

namespace wormdrive::test::diagnosis_hard_recordings {

namespace {

struct Amount {
  const char* effect;
  double amount;
};

recovery::Case hard(std::uint64_t seed, const std::vector<Amount>& hidden, const char* conditions = "ideal") {
  recovery::Case drawn{recovery::Kind::single, recovery::conditions(conditions), seed, {}};
  for (const Amount& h : hidden) drawn.hidden.push_back({&truth::secret(h.effect), truth::Size::medium, h.amount});
  return drawn;
}

struct Answer {
  recovery::Score score;
  Diagnosis diagnosis;
};

Answer answer(const recovery::Case& drawn) {
  const recovery::Bench bench = recovery::record(drawn);
  Diagnosis d = diagnose(recovery::data_sheet(drawn), {bench.recording}, {.threads = 2});
  return {recovery::judge(drawn, bench.drive, d).score, std::move(d)};
}

/// The diagnosis of a recording whose causes have to be named exactly.
Diagnosis named_exactly(const recovery::Case& drawn) {
  Answer found = answer(drawn);
  CAPTURE(found.diagnosis.sentence);
  CHECK(found.score == recovery::Score::exact);
  return std::move(found.diagnosis);
}

}  // namespace

TEST_CASE("a limit far below the largest command is found, though all that it cuts passes for outliers", "[slow]") {
  named_exactly(hard(10510089960399327083U, {{"torque_saturation", 0.12}}));
}

TEST_CASE("a level of friction far from what is stated is named beside its fall, whose law is sought anew for it",
          "[.][long]") {
  const Diagnosis below = named_exactly(hard(8544923407699674050U, {{"stribeck", 0.03}, {"mesh_friction", -0.015}}));
  CHECK(below.causes.size() == 2);
  const Diagnosis within = named_exactly(hard(17675402408226979046U, {{"mesh_friction", 0.015}, {"stribeck", 0.03}}));
  CHECK(within.causes.size() == 2);
}

TEST_CASE("what a fall of another shape than the catalogue's leaves over the speed makes no cause beside it",
          "[.][long]") {
  named_exactly(hard(7590460569741094619U, {{"stribeck", 0.09}}));
}

TEST_CASE("a wide gap is named beside what hid it, though nobody can predict how its teeth bounce", "[.][long]") {
  named_exactly(hard(12351327449815399994U, {{"worm_coulomb", 0.01}, {"backlash", 0.004}}));
}

TEST_CASE("a gap that was found later does not drop a cause without which nothing fits", "[.][long]") {
  named_exactly(hard(3689283242906862325U, {{"worm_viscous", 9e-5}, {"backlash", 0.004}}));
}

TEST_CASE("of three causes that scale all torques alike, two remain that do as well", "[.][long]") {
  named_exactly(hard(5020412394954123531U, {{"torque_gain", 0.03}, {"load_magnitude", 0.06}}));
}

TEST_CASE("commands that are seldom exceeded are known") {
  Recording r;
  r.period = 1e-3;
  for (int k = 0; k < 1000; ++k) {
    r.motor_torque.push_back((k % 2 == 0 ? 1e-3 : -1e-3) * k);
    r.gear_angle.push_back(1e-3 * k);
  }
  r.valid.assign(r.samples(), 1);
  const Magnitudes m = magnitudes(recovery::data_sheet(recovery::conditions("ideal")), {prepared(r, 0, 60.0)});
  CHECK(m.largest_torque == 0.999);
  CHECK(std::abs(m.rare_torques[0] - 0.995) < 1e-12);
  CHECK(std::abs(m.rare_torques[1] - 0.984) < 1e-12);
  CHECK(std::abs(m.rare_torques[2] - 0.949) < 1e-12);
}

TEST_CASE("two effects that nearly cancel are found though other ones were found first", "[.][long]") {
  named_exactly(hard(7809331778440145391U, {{"mesh_friction", 0.015}, {"load_magnitude", -0.06}}));
}

TEST_CASE("what did as well as a cause when that was found is no class with it if it does not so in the end",
          "[.][long]") {
  const Diagnosis d = named_exactly(hard(18133264718257835443U, {{"torque_gain", 0.03}, {"load_magnitude", 0.06}}));
  CHECK(d.classes.empty());
}

TEST_CASE("two causes that do as well as three are the better explanation", "[.][long]") {
  // less inertia of worm and gear and some of the load is the same motion
  named_exactly(hard(12987163819398539930U, {{"torque_gain", 0.03}, {"load_magnitude", 0.06}}));
}

TEST_CASE("friction at rest is named for all its break-aways, though one of those held out outweighs all others",
          "[.][long]") {
  named_exactly(hard(16617251610193380410U, {{"static_friction", 0.09}}, "realistic"));
}

TEST_CASE("friction at rest is found between the sizes that are tried: much less of it helps no more than none",
          "[slow]") {
  named_exactly(hard(5367963912548052634U, {{"static_friction", 0.156}}));
}

TEST_CASE("a wide gap is found though the noise without it passes for most of the motion", "[.][long]") {
  const Diagnosis d = named_exactly(hard(11050129810103917130U, {{"backlash", 0.004}}));
  REQUIRE(d.causes.size() == 1);
  CHECK(std::abs(d.causes[0].parameters[0].value - 0.004) < 0.15 * 0.004);
}

TEST_CASE("what impacts leave in single blocks makes no cause beside a gap", "[.][long]") {
  named_exactly(hard(10405037338987322326U, {{"backlash", 0.004}}, "realistic"));
}

TEST_CASE("a gap keeps its name though its teeth cannot be followed as far as the noise lets others be", "[.][long]") {
  named_exactly(hard(8559633916621165583U, {{"backlash", 0.004}}));
}

TEST_CASE("what is of no certain size beside a gap is no cause, for all that it adds to the likelihood", "[.][long]") {
  named_exactly(hard(4253192110446129441U, {{"backlash", 0.004}}));
}

TEST_CASE("candidates beside a gap are compared by impacts that suit each of them", "[.][long]") {
  named_exactly(hard(6401084500742193729U, {{"torque_offset", 0.0012}, {"backlash", 0.001}}));
}

TEST_CASE("a number far beyond its tolerance is named though others, within theirs, predict what was held out as well",
          "[slow]") {
  named_exactly(hard(8060836718574869034U, {{"mesh_friction", -0.045}}, "realistic"));
}

TEST_CASE("of the shapes of a fall the one that fits is taken, though another promises more from afar", "[.][long]") {
  using enum truth::MeshFriction::Fall;
  for (const std::uint64_t seed : {3U, 4U}) {
    const recovery::Case drawn = hard(seed, {{"stribeck", 0.03}});
    const bool is_bell = recovery::record(drawn).drive.friction.fall == gaussian;
    const Diagnosis d = named_exactly(drawn);
    REQUIRE(d.causes.size() == 1);
    CHECK(std::abs(d.causes[0].parameters[0].value - 0.03) < 0.02 * 0.03);
    const auto& fall = std::get<std::optional<Stribeck<double>>>(d.extended.effects.list);
    REQUIRE(fall);
    CHECK(fall->exponent == 2.0);
    CHECK(fall->tail == (is_bell ? 0.0 : 1.0));
  }
}

TEST_CASE("friction that falls as soon as anything moves is in a class with friction at rest", "[.][long]") {
  const auto [score, d] = answer(hard(16379865211237047177U, {{"static_friction", 0.09}}, "realistic"));
  CAPTURE(d.sentence);
  CHECK(d.verdict == Verdict::ambiguous);
  CHECK(d.classes == std::vector<std::vector<std::string>>{{"stribeck", "static_friction"}});
}

TEST_CASE("a spring is found though where it is slack shows only once it has a stiffness", "[.][long]") {
  const auto [score, d] = answer(hard(14339916788581164878U, {{"load_spring", 0.005}}, "realistic"));
  CAPTURE(d.sentence);
  REQUIRE(d.causes.size() == 1);
  CHECK(d.causes[0].effect == "load_spring");
}

TEST_CASE("friction that changes once per turn of the worm is named, stated parameters off within their tolerances too",
          "[.][long]") {
  named_exactly(hard(2611, {{"thread_friction", 0.06}}));
  const Diagnosis d = named_exactly(hard(2612, {{"thread_friction", 0.02}}, "realistic"));
  REQUIRE(d.causes.size() == 1);
  CHECK(std::abs(d.causes[0].parameters[0].value - 0.02) < 0.1 * 0.02);
}

TEST_CASE("less friction at one place of the gear is seen, and no name is claimed for it", "[slow]") {
  const auto [score, d] = answer(hard(76605843690817575U, {{"friction_spot", -0.2}}));
  CAPTURE(d.sentence);
  CHECK(d.verdict == Verdict::unexplained);
  CHECK(std::any_of(d.remainders.begin(), d.remainders.end(), [](const auto& r) { return r.axis == "one angle"; }));
}

TEST_CASE("numbers that only their tolerances tell apart are known no better than these allow", "[.][long]") {
  // torque, load and both inertias in proportion leave a motion as it is: of four numbers that are stated to 1 % the
  // common factor is known to half of that. A break-away that passes a sample made it look known to a tenth.
  const auto [score, d] = answer(hard(4553806777927191587U, {{"encoder_offset", -0.1}}, "realistic"));
  CAPTURE(d.sentence);
  const auto error = [&, &d = d](std::string_view effect) {
    const auto c = std::find_if(d.calibration.begin(), d.calibration.end(),
                                [&](const EstimatedEffect& e) { return e.effect == effect; });
    REQUIRE(c != d.calibration.end());
    return c->parameters.front().standard_error;
  };
  const double stated = recovery::stated_errors.share, Jw = truth::Geometry{}.worm_inertia;
  CHECK(error("torque_gain") > 0.45 * stated);
  CHECK(error("worm_inertia") > 0.45 * stated * Jw);
  CHECK(error("torque_gain") < 0.7 * stated);
  CHECK(error("worm_inertia") < 0.7 * stated * Jw);
}

}  // namespace wormdrive::test::diagnosis_hard_recordings
