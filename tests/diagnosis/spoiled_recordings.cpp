#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "description/diagnostics.hpp"
#include "diagnosis/sheet.hpp"

// Recordings that something happened to on their way: each is refused with one sentence, none passes for physics.

namespace wormdrive::test::diagnosis_spoiled_recordings {

namespace {

constexpr std::size_t t = 0, u = 1, y = 2;  ///< columns

struct Spoiled {
  std::string name;
  std::function<void(Sheet&)> spoil;
  std::string says;  ///< without the folder of the file
};

std::string verdict(const Folder& folder, const Sheet& sheet) {
  try {
    const Recording recording = read(folder, sheet);
    std::string all = "it was taken";
    for (const std::string& remark : recording.remarks) all += "\n" + remark;
    return all;
  } catch (const InputFault& fault) {
    std::string text = fault.what();
    const std::string path = folder / "";
    if (text.starts_with(path)) text.erase(0, path.size());
    return text;
  }
}

/// Adds a column that should be the speed of the gear.
void add_speed(Sheet& s, double factor) {
  s.names.push_back("gear_speed_rad_per_s");
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    const std::size_t a = std::max<std::size_t>(k, 5) - 5, b = std::min(k + 5, s.rows.size() - 1);
    const double speed = (s.number(b, y) - s.number(a, y)) / (1e-3 * static_cast<double>(b - a));
    s.rows[k].push_back(fmt::format("{:.6g}", factor * speed));
  }
}

/// Adds an encoder on the worm that goes so many times as far as the gear.
void add_worm(Sheet& s, double factor) {
  s.names.push_back("worm_angle_rad");
  for (std::size_t k = 0; k < s.rows.size(); ++k) s.rows[k].push_back(fmt::format("{:.9g}", factor * s.number(k, y)));
}

const double degree = std::numbers::pi / 180.0;

// clang-format off
const std::vector<Spoiled> spoiled{
    {"no samples",
     [](Sheet& s) { s.rows.clear(); },
     "r.csv: error: 0 samples; a diagnosis needs at least 1000"},
    {"ten samples",
     [](Sheet& s) { s.rows.resize(10); },
     "r.csv: error: 10 samples; a diagnosis needs at least 1000"},
    {"two seconds",
     [](Sheet& s) { s.rows.resize(2000); },
     "r.csv: error: 2000 samples of 0.001 s are 2 s; a diagnosis needs at least 3 s"},
    {"no angle",
     [](Sheet& s) { s.names[y] = "position"; },
     "r.csv:1: error: no column 'gear_angle_rad'; the header line names time_s, motor_torque_Nm, position; [data] gear_angle_rad = \"...\" in the scenario would say which it is"},
    {"other names",
     [](Sheet& s) { s.names = {"t", "motor_torque", "gear_angle"}; },
     "r.csv:1: error: no column 'time_s'; the header line names t, motor_torque, gear_angle; [data] time_s = \"t\" in the scenario would say which it is"},
    {"empty cell",
     [](Sheet& s) { s.rows[17][y] = ""; },
     "r.csv:19: error: gear_angle_rad = '' is not a finite number"},
    {"nan",
     [](Sheet& s) { s.rows[4000][u] = "nan"; },
     "r.csv:4002: error: motor_torque_Nm = 'nan' is not a finite number"},
    {"a word",
     [](Sheet& s) { s.rows[100][u] = "off"; },
     "r.csv:102: error: motor_torque_Nm = 'off' is not a finite number"},
    {"a short line",
     [](Sheet& s) { s.rows[100].pop_back(); },
     "r.csv:102: error: 2 cells where the header has 3"},
    {"decimal comma",
     [](Sheet& s) { s.rows[5] = {"0", "005", "0", "03", "0", "1"}; },
     "r.csv:7: error: 6 cells where the header has 3"},
    {"negative time",
     [](Sheet& s) { s.each(t, [](double v, std::size_t) { return v - 1.0; }); },
     "r.csv:2: error: time_s = -1 is negative; count time from the first sample on"},
    {"time stands",
     [](Sheet& s) { s.rows[3000][t] = s.rows[2999][t]; },
     "r.csv:3002: error: time_s = 2.999 stands twice in a row"},
    {"time goes back",
     [](Sheet& s) { s.rows[3000][t] = s.rows[2000][t]; },
     "r.csv:3002: error: time_s = 2 is before 2.999"},
    {"time in ms",
     [](Sheet& s) { s.each(t, [](double v, std::size_t) { return 1e3 * v; }); },
     "r.csv: error: time_s has steps of 1 s; a diagnosis needs at most 0.02 s (is time_s in seconds?)"},
    {"constant torque",
     [](Sheet& s) { s.each(u, [](double, std::size_t) { return 0.03; }); },
     "r.csv: error: motor_torque_Nm is 0.03 throughout: a torque that never changes shows nothing of the drive"},
    {"torque in mN m",
     [](Sheet& s) { s.each(u, [](double v, std::size_t) { return 1e3 * v; }); },
     "r.csv: error: motor_torque_Nm fits the drive when it is read in mN m, not as it stands (6 % of the torque unaccounted for, 100 % as it stands)"},
    {"torque with the other sign",
     [](Sheet& s) { s.each(u, [](double v, std::size_t) { return -v; }); },
     "r.csv: error: motor_torque_Nm fits the drive with the opposite sign, not as it stands (6 % of the torque unaccounted for, 200 % as it stands)"},
    {"torque of the gear",
     [](Sheet& s) { s.each(u, [](double v, std::size_t) { return 60.0 * v; }); },
     "r.csv: error: motor_torque_Nm is 61 times what the drive of the scenario needs for this motion: wrong unit, or wrong scenario"},
    {"torque of a drive whose angle is in degrees",
     [](Sheet& s) { s.each(u, [](double v, std::size_t) { return 0.0169 * v; }); },
     "r.csv: error: motor_torque_Nm is 0.017 times what the drive of the scenario needs for this motion: wrong unit, or wrong scenario; so it is if gear_angle_rad is in degrees"},
    {"constant angle",
     [](Sheet& s) { s.each(y, [](double, std::size_t) { return 0.2; }); },
     "r.csv: error: gear_angle_rad is 0.2 throughout: the gear never moved, or its encoder was stuck"},
    {"hardly any motion",
     [](Sheet& s) { s.each(y, [](double v, std::size_t) { return 3.834952e-4 * std::round(4.0 * v); }); },
     "r.csv: error: gear_angle_rad moves by 0.0069 rad, less than 20 steps of its encoder: too little to learn from"},
    {"degrees for radians",
     [](Sheet& s) { s.each(y, [](double v, std::size_t) { return v / degree; }); },
     "r.csv: error: gear_angle_rad fits the drive when it is read in degrees, not as it stands (6 % of the torque unaccounted for, 1656 % as it stands)"},
    {"angle of the worm",
     [](Sheet& s) { s.each(y, [](double v, std::size_t) { return 60.0 * v; }); },
     "r.csv: error: gear_angle_rad fits the drive when it is the angle of the worm, not as it stands (6 % of the torque unaccounted for, 1736 % as it stands)"},
    {"angle with the other sign",
     [](Sheet& s) { s.each(y, [](double v, std::size_t) { return -v; }); },
     "r.csv: error: gear_angle_rad fits the drive with the opposite sign, not as it stands (6 % of the torque unaccounted for, 246 % as it stands)"},
    {"swapped columns",
     [](Sheet& s) { std::swap(s.names[u], s.names[y]); },
     "r.csv: error: motor_torque_Nm and gear_angle_rad fit the drive when they are swapped, not as it stands (6 % of the torque unaccounted for, 97 % as it stands)"},
    {"encoder within one turn",
     [](Sheet& s) { s.each(y, [](double v, std::size_t) { return v < 0 ? v + 2 * std::numbers::pi : v; }); },
     "r.csv:3872: error: gear_angle_rad jumps from 0.000383495 to 6.28127 within one sample: it is counted within one turn; unwrap it"},
    {"saturated encoder",
     [](Sheet& s) { s.each(y, [](double v, std::size_t) { return std::clamp(v, -1.5, 1.5); }); },
     "r.csv:1969: error: gear_angle_rad stands at 1.5 from 1.967 s to 3.244 s and moves at 2 rad/s just after: the encoder is at the end of its range"},
    {"stuck encoder",
     [](Sheet& s) { for (std::size_t k = 4400; k < 4700; ++k) s.rows[k][y] = s.rows[4400][y]; },
     "r.csv:4402: error: gear_angle_rad stands at -1.34952 from 4.4 s to 4.699 s and moves at 2.3 rad/s just after: the encoder was stuck"},
    {"encoder that slips",
     [](Sheet& s) { for (std::size_t k = 4200; k < s.rows.size(); ++k) s.put(k, y, s.number(k, y) + 0.3); },
     "r.csv:4202: error: gear_angle_rad jumps from -0.733243 to -0.438228 within one sample: no drive moves so fast; cut the recording there or mend its encoder"},
    {"every tenth sample overwritten",
     [](Sheet& s) { for (std::size_t k = 0; k < s.rows.size(); k += 10) s.put(k, y, 9.0); },
     "r.csv: error: 799 of 8000 samples are such that no measurement can have given them"},
    {"speed in rpm",
     [](Sheet& s) { add_speed(s, 30 / std::numbers::pi); },
     "r.csv: error: gear_speed_rad_per_s is in rpm, which does not match gear_angle_rad: 9.55 times its derivative"},
    {"worm with another ratio",
     [](Sheet& s) { add_worm(s, 30); },
     "r.csv: error: worm_angle_rad goes 30 times as far as gear_angle_rad, where the scenario states a ratio of 60: state ratio = 30"},
    {"worm with the other sign",
     [](Sheet& s) { add_worm(s, -60); },
     "r.csv: error: worm_angle_rad goes -60 times as far as gear_angle_rad, where the scenario states a ratio of 60: turn its sign"},
    {"worm in degrees",
     [](Sheet& s) { add_worm(s, 60 / degree); },
     "r.csv: error: worm_angle_rad goes 3438 times as far as gear_angle_rad, where the scenario states a ratio of 60: it is in degrees"},
    {"worm counted at the gear",
     [](Sheet& s) { add_worm(s, 1); },
     "r.csv: error: worm_angle_rad goes 1 times as far as gear_angle_rad, where the scenario states a ratio of 60: it is counted at the gear"},
    {"speed of the worm",
     [](Sheet& s) { add_speed(s, 60); },
     "r.csv: error: gear_speed_rad_per_s is the speed of the worm, which does not match gear_angle_rad: 60 times its derivative"}};
// clang-format on

}  // namespace

TEST_CASE("a spoiled recording is refused with one sentence and never taken for physics") {
  const Folder folder;
  for (const Spoiled& bad : spoiled) {
    Sheet sheet = sound();
    bad.spoil(sheet);
    INFO("case: " << bad.name);
    CHECK(verdict(folder, sheet) == bad.says);
  }
}

}  // namespace wormdrive::test::diagnosis_spoiled_recordings
