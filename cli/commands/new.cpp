#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "description/diagnostics.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/resource.hpp"

namespace wormdrive {
namespace {

struct NewOptions {
  std::string file;
  std::string kind;  ///< one of new_kinds()
};

constexpr std::string_view mesh_lines =
    R"([mesh]                                # worm and gear, as a data sheet states them
ratio = 60                            # worm angle over gear angle
lead_angle_deg = 3.9                  # of the worm; _rad works too, for every angle
pressure_angle_deg = 20               # normal pressure angle
worm_pitch_radius_m = 0.011
gear_pitch_radius_m = 0.045
friction = 0.1                        # between the teeth; above about cos(20 deg) tan(3.9 deg) = 0.064 it is self-locking
worm_inertia_kgm2 = 2.5e-5            # motor included
gear_inertia_kgm2 = 7.4e-4            # without the load
)";

constexpr std::string_view arm = R"(
[load]                                # wormdrive list loads
kind = "gravity_arm"                  # torque cos(gear angle + angle_offset)
mass_kg = 1.0
arm_m = 0.07
# angle_offset_deg = 0                # of the arm from horizontal at gear angle 0
)";

constexpr std::string_view effects_lines = R"(
[effect.worm_coulomb]                 # bearings of the worm; all effects: wormdrive list effects
torque_Nm = 0.005

# [effect.stribeck]                   # friction that falls with the sliding speed
# drop = 0.05
# speed_m_per_s = 0.1
)";

constexpr std::string_view initial = R"(
# [initial]
# gear_angle_deg = 0
# gear_speed_rad_per_s = 0
)";

constexpr std::string_view motor = R"(
[motor.torque]                        # wormdrive list torques; several [[motor.torque]] add up
kind = "sinusoid"
amplitude_Nm = 0.15
frequency_Hz = 1.5
phase_deg = 90                        # 90: starts at its largest value
)";

constexpr std::string_view run_lines = R"(
[run]
duration_s = 2
# report_interval_s = 0.002           # a thousandth of the duration if not stated
# relative_tolerance = 1e-10
# solver = "taylor"                   # fast; "cvode" is the default
)";

constexpr std::string_view control = R"(
[controller]                          # wormdrive list controllers
kind = "sliding"
sample_time_s = 0.001
bandwidth_rad_per_s = 94              # lambda_c
layer_rad_per_s = 0.3                 # half width Phi of the boundary layer
eta_rad_per_s2 = 30                   # margin of the switching gain
beta1 = 2                             # by how much friction may differ, at least 1
beta2 = 2
# [controller.nominal]                # what it believes of the drive; as stated above if nothing stands here
# [controller.variation]              # what it is to withstand: wormdrive check tells whether Lemma 1 holds

[reference]                           # wormdrive list references; several [[reference]] add up
kind = "sinusoid"
amplitude_rad = 0.14
frequency_Hz = 1

[sensor]
counts = 240000                       # of the encoder, per turn of the gear: 4000 per turn of the worm. One count per
                                      # sample should be well within the layer: here 0.026 rad/s
)";

constexpr std::string_view axis_lines = R"([mesh]
kind = "none"                         # no gear: one mass
axis = "linear"                       # forces in N, positions in m, masses in kg
mass_kg = 95

[motor.torque]
kind = "sinusoid"
amplitude_N = 60
frequency_Hz = 0.5

[effect.gear_coulomb]                 # dry friction of the guide
force_N = 20

[effect.gear_viscous]
coefficient_Ns_per_m = 200
)";

constexpr std::string_view teeth = R"(
[effect.tooth_compliance]             # teeth that yield: worm and gear move on their own
stiffness_N_per_m = 1e6
damping_s_per_m = 300                 # law of Hunt and Crossley

[effect.backlash]
gap_deg = 0.02                        # play of the gear with the worm held
)";

constexpr std::string_view study_lines =
    R"(scenario = "my_drive.toml"            # beside this file: wormdrive new my_drive.toml
set = ["run.solver=taylor"]           # as --set, for every trial; of the solvers the fast one

[sweep]
design = "monte_carlo"                # or latin_hypercube, sobol, saltelli, shapley, morris, grid, one_at_a_time, table
trials = 10000
seed = 1

[[parameter]]
path = "mesh.friction"                # as --set takes it, with its unit
distribution = "truncated_normal"
mean = 0.1
deviation = 0.02
low = 0.05

[[parameter]]
path = "load.mass_kg"
distribution = "triangular"
low = 0.8
mode = 1.0
high = 1.3

[[parameter]]
path = "effect.worm_coulomb.torque_Nm"
distribution = "lognormal"
median = 0.005
log_deviation = 0.3                   # of the natural logarithm

[[threshold]]                         # the share of trials beyond it; wormdrive summary lists all metrics
metric = "final_gear_angle"
above_rad = 0
)";

struct Kind {
  std::string_view name, title;
  std::vector<std::string_view> parts;
  std::string_view command = "run", page = "scenario.md";  ///< that runs it, and where its keys are told
};
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"open_loop",
       "A worm drive under a motor torque over time",
       {mesh_lines, motor, arm, effects_lines, initial, run_lines}},
      {"controlled",
       "A worm drive under a sampled controller",
       {mesh_lines, control, arm, effects_lines, initial, run_lines}},
      {"elastic_teeth", "A worm drive with backlash", {mesh_lines, motor, arm, teeth, initial, run_lines}},
      {"linear_axis", "A linear axis with dry friction", {axis_lines, run_lines}},
      {"study",
       "A worm drive whose friction, load and bearings are uncertain",
       {study_lines},
       "sweep",
       "howto/sweep.md"}};
  return all;
}

/// What `wormdrive new --kind` may be.
std::vector<std::string> new_kinds() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name);
  return names;
}

int new_command(const NewOptions& options) {
  const auto kind = std::find_if(kinds().begin(), kinds().end(), [&](const Kind& k) { return k.name == options.kind; });
  std::string text = fmt::format("# Run it: wormdrive {} {}. Every key: {}.\ntitle = \"{}\"\n", kind->command,
                                 std::filesystem::path(options.file).filename().string(),
                                 documentation_page(std::string(kind->page)), kind->title);
  if (kind->command == "run") text += '\n';
  for (const std::string_view part : kind->parts) text += part;
  errno = 0;
  std::FILE* const file = std::fopen(options.file.c_str(), "wx");  // never over something that is there
  if (!file && errno == EEXIST) reject({options.file}, "it exists; choose another name");
  const bool written = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const bool closed = file && std::fclose(file) == 0;
  if (!written || !closed) {
    const int reason = errno;
    if (file) std::remove(options.file.c_str());
    throw OutputFault(fmt::format("cannot write {}: {}", options.file, std::strerror(reason)));
  }
  print_item("wrote", fmt::format("{}    run it: wormdrive {} {}", options.file, kind->command, options.file));
  return 0;
}

}  // namespace

void add_new(CommandSet& commands) {
  auto [command, options] = commands.add("new", "write a commented scenario or study to start from", new_command);
  command.add_option("file", options.file, "scenario or study to write (.toml)")->required();
  options.kind = new_kinds().front();
  command.add_option("--kind", options.kind, "what the file describes")
      ->check(CLI::IsMember(new_kinds()))
      ->capture_default_str();
}

}  // namespace wormdrive
