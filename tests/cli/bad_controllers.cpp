// One malformed input per line:
// clang-format off
#include "cli/bad_input.hpp"

// What the program says about controllers that it cannot run.

namespace wormdrive::test::cli_bad_controllers {

namespace {

const std::string motor = "[motor.torque]\nkind = \"constant\"\ntorque_Nm = -0.05\n";
/// Without a fault; line numbers count from its first line: [controller] is on line 11.
const std::string controlled = good_but(motor, R"([controller]
kind = "sliding"
sample_time_s = 1e-3
bandwidth_rad_per_s = 94
layer_rad_per_s = 0.3
eta_rad_per_s2 = 30
[reference]
kind = "sinusoid"
amplitude_rad = 0.14
frequency_Hz = 2
[sensor]
speed_filter_Hz = 200
)");
const std::string sliding = "kind = \"sliding\"\nsample_time_s = 1e-3\nbandwidth_rad_per_s = 94\nlayer_rad_per_s = 0.3\neta_rad_per_s2 = 30\n";
const std::string reference = "kind = \"sinusoid\"\namplitude_rad = 0.14\nfrequency_Hz = 2\n";

std::string but(const std::string& part, const std::string& by) { return edited(controlled, part, by); }

}  // namespace

TEST_CASE("the controlled scenario on which the bad ones are based is valid") {
  const Folder folder;
  folder.write("s.toml", controlled);
  REQUIRE(folder.run({"run", "s.toml", "-q"}).exit == 0);
}

TEST_CASE("controller tables that exclude other tables are rejected with the choice to make") {
  check_rejected(Folder(), {
      {"a motor torque too", good_scenario + controlled.substr(controlled.find("[controller]"), controlled.find("[load]") - controlled.find("[controller]")),
       "s.toml:11:1: error: [motor.torque] is stated along with [controller]; keep one: kind = \"open_loop\" holds a torque over time between samples"},
      {"a sensor alone", good_scenario + "[sensor]\ncounts = 16\n", "s.toml:19:1: error: [sensor] needs a [controller], but there is none"},
      {"a reference alone", good_scenario + "[[reference]]\nkind = \"step\"\n",
       "s.toml:19:1: error: [reference] needs a [controller], but there is none"},
      {"no reference", but("[reference]\n" + reference, ""), "s.toml:11:1: error: [controller] lacks a [reference] to follow"},
      {"no torque to hold", but(sliding, "kind = \"open_loop\"\nsample_time_s = 1e-3\n"),
       "s.toml:11:1: error: [controller] lacks 'torque' (the torque over time that is to be held)"},
      {"a linear axis", "title = \"x\"\n[mesh]\nkind = \"none\"\naxis = \"linear\"\nmass_kg = 1\n[run]\nduration_s = 1\n[controller]\nkind = \"open_loop\"\n"
       "sample_time_s = 1\n[controller.torque]\nkind = \"constant\"\nforce_N = 1\n",
       "s.toml:8:1: error: [controller] needs a rotary axis; mesh.axis is \"linear\""}});
}

TEST_CASE("unknown, missing and out-of-range keys of a controller are reported") {
  check_rejected(Folder(), {
      {"no kind", but("kind = \"sliding\"\n", ""),
       "s.toml:11:1: error: [controller] lacks 'kind' (one of \"sliding\", \"pid\", \"position_servo\", \"open_loop\")"},
      {"unknown kind", but("\"sliding\"", "\"smc\""),
       "s.toml:12:8: error: controller.kind = \"smc\" must be one of \"sliding\", \"pid\", \"position_servo\", \"open_loop\""},
      {"misspelled", but("layer_rad_per_s", "layer"), "s.toml:15:1: error: unknown key 'layer' in [controller]; did you mean 'layer_rad_per_s'?"},
      {"missing", but("eta_rad_per_s2 = 30\n", ""), "s.toml:11:1: error: [controller] lacks 'eta_rad_per_s2' (reaching rate eta)"},
      {"no sample time", but("sample_time_s = 1e-3\n", ""), "s.toml:11:1: error: [controller] lacks 'sample_time_s' (time between two samples)"},
      {"a negative layer", but("layer_rad_per_s = 0.3", "layer_rad_per_s = -0.3"),
       "s.toml:15:19: error: controller.layer_rad_per_s = -0.3 rad/s must be greater than 0 rad/s"},
      {"a small beta", but("eta_rad_per_s2 = 30", "eta_rad_per_s2 = 30\nbeta1 = 0.5"), "s.toml:17:9: error: controller.beta1 = 0.5 must be at least 1"},
      {"two samples of delay", but("eta_rad_per_s2 = 30", "eta_rad_per_s2 = 30\ndelay_samples = 2"),
       "s.toml:17:17: error: controller.delay_samples = 2 must be at least 0 and at most 1"},
      {"half a sample of delay", but("eta_rad_per_s2 = 30", "eta_rad_per_s2 = 30\ndelay_samples = 0.5"),
       "s.toml:17:17: error: controller.delay_samples = 0.5 must be a whole number"},
      {"a nominal model that is none", but("[reference]", "[controller.nominal]\nC1 = -7\n[reference]"),
       "s.toml:17:1: error: the nominal model violates eq. 17: Jw i + C1 Jg = -0.003655 kg m^2 must be greater than 0"},
      {"friction and C1", but("[reference]", "[controller.variation]\nfriction = 0.1\nC1 = 0.1\n[reference]"),
       "s.toml:18:12: error: controller.variation.friction is stated along with C1 or C2; keep the friction, or the two others"},
      {"a branch without inertia", but("[reference]", "[controller.variation]\nC1 = 1000\n[reference]"),
       "s.toml:17:1: error: controller.variation leaves the branch C1 without inertia, Jw i + C1 Jg <= 0, and no gain withstands that; reduce the variation, or "
       "state D1_per_kgm2 and E1_rad_per_s2"},
      {"PID without weights", but(sliding, "kind = \"pid\"\nsample_time_s = 1e-3\n"),
       "s.toml:11:1: error: [controller] lacks 'integral_weight' (weight of the integral of e, squared)\n"
       "s.toml:11:1: error: [controller] lacks 'angle_weight' (weight of e squared)\n"
       "s.toml:11:1: error: [controller] lacks 'speed_weight' (weight of e' squared)"}});
}

TEST_CASE("anti-windup that cannot be is reported") {
  const std::string eta = "eta_rad_per_s2 = 30";
  check_rejected(Folder(), {
      {"an unknown method", but(eta, eta + "\nanti_windup = \"clamping\""),
       "s.toml:17:15: error: controller.anti_windup = \"clamping\" must be one of \"none\", \"back_calculation\", \"conditional\", \"model_recovery\""},
      {"an unknown method with a time", but(eta, eta + "\nanti_windup = \"clamping\"\ntracking_time_s = 0.01"),
       "s.toml:17:15: error: controller.anti_windup = \"clamping\" must be one of \"none\", \"back_calculation\", \"conditional\", \"model_recovery\""},
      {"a time that nothing tracks with", but(eta, eta + "\nanti_windup = \"conditional\"\ntracking_time_s = 0.01"),
       "s.toml:18:19: error: controller.tracking_time_s has no effect with anti_windup = \"conditional\"; remove it, or use \"back_calculation\" or "
       "\"model_recovery\""},
      {"no method", but(eta, eta + "\ntracking_time_s = 0.01"),
       "s.toml:17:19: error: controller.tracking_time_s has no effect with anti_windup = \"none\"; remove it, or use \"back_calculation\" or "
       "\"model_recovery\""},
      {"within a sample", but(eta, eta + "\nanti_windup = \"back_calculation\"\ntracking_time_s = 1e-4"),
       "s.toml:18:19: error: controller.tracking_time_s = 0.0001 s must be at least the sample time, 0.001 s"},
      {"no integral", but(sliding, "kind = \"position_servo\"\nsample_time_s = 1e-3\ngain_Nm_per_rad = 2\nanti_windup = \"conditional\"\n"),
       "s.toml:15:15: error: controller.anti_windup needs a law with an integral, and \"position_servo\" has none"},
      {"a model that a servo does not use", but(sliding, "kind = \"position_servo\"\nsample_time_s = 1e-3\ngain_Nm_per_rad = 2\n"
                                                         "[controller.nominal]\nC1 = -0.02\n[controller.variation]\nC1 = 0.1\n"),
       "s.toml:15:1: error: [controller.nominal] has no effect with kind = \"position_servo\", a law without a model; remove it\n"
       "s.toml:17:1: error: [controller.variation] has no effect with kind = \"position_servo\", a law without a model; remove it"},
      {"a servo without a gain", but(sliding, "kind = \"position_servo\"\nsample_time_s = 1e-3\n"),
       "s.toml:11:1: error: [controller] lacks 'gain_Nm_per_rad' (torque per angle to the goal)"}});
}

TEST_CASE("sample times that do not fit the run are reported") {
  check_rejected(Folder(), {
      {"longer than the run", but("sample_time_s = 1e-3", "sample_time_s = 1"),
       "s.toml:13:17: error: controller.sample_time_s = 1 s must be at most the duration, 0.01 s"},
      {"too many", but("sample_time_s = 1e-3", "sample_time_s = 1e-12"),
       "s.toml:13:17: error: controller.sample_time_s = 1e-12 s would give 1e+10 samples; at most 1e+09 are allowed"},
      {"zero", but("sample_time_s = 1e-3", "sample_time_s = 0"), "s.toml:13:17: error: controller.sample_time_s = 0 s must be greater than 0 s"},
      {"starting too late", but("sample_time_s = 1e-3", "sample_time_s = 1e-3\nsample_offset_s = 0.01"),
       "s.toml:14:19: error: controller.sample_offset_s = 0.01 s must be less than the duration, 0.01 s"}});
}

TEST_CASE("faults of references, sensors, disturbances and windows are reported") {
  check_rejected(Folder(), {
      {"unknown reference", but("\"sinusoid\"", "\"sine\""),
       "s.toml:18:8: error: reference.kind = \"sine\" must be one of \"sinusoid\", \"step\", \"trapezoid\", \"chirp\", \"multisine\", "
       "\"random_steps\", \"table\""},
      {"an angle twice", but("amplitude_rad = 0.14", "amplitude_rad = 0.14\namplitude_deg = 8"),
       "s.toml:20:17: error: reference.amplitude_deg is stated twice, also as amplitude_rad; keep one"},
      {"a short table", but(reference, "kind = \"table\"\ntimes_s = [0, 1, 2]\nangles_deg = [0, 1, 2]\n"),
       "s.toml:19:11: error: reference.times_s has 3 values; at least 4 are needed"},
      {"half a sine", but(reference, "kind = \"multisine\"\namplitude_rad = 1\nlowest_frequency_Hz = 1\nhighest_frequency_Hz = 2\ncount = 1.5\n"),
       "s.toml:22:9: error: reference.count = 1.5 must be a whole number"},
      {"second of two", but("[reference]\n" + reference, "[[reference]]\n" + reference + "[[reference]]\n" + edited(reference, "2\n", "0\n")),
       "s.toml:24:16: error: reference[1].frequency_Hz = 0 Hz must be greater than 0 Hz"},
      {"unknown speed", but("[sensor]", "[sensor]\nspeed = \"true\""),
       "s.toml:22:9: error: sensor.speed = \"true\" must be one of \"difference\", \"exact\""},
      {"an unknown shaft", but("[sensor]", "[sensor]\nshaft = \"motor\""),
       "s.toml:22:9: error: sensor.shaft = \"motor\" must be one of \"gear\", \"worm\""},
      {"no worm", "title = \"x\"\n[mesh]\nkind = \"none\"\ninertia_kgm2 = 1\n[run]\nduration_s = 1\n[controller]\nkind = \"position_servo\"\n"
       "gain_Nm_per_rad = 1\nsample_time_s = 0.01\n[reference]\n" + reference + "[sensor]\nshaft = \"worm\"\n",
       "s.toml:16:9: error: sensor.shaft = \"worm\" needs a worm, but mesh.kind is \"none\""},
      {"an exact speed with counts", but("[sensor]\nspeed_filter_Hz = 200", "[sensor]\nspeed = \"exact\"\ncounts = 4096"),
       "s.toml:23:10: error: sensor.counts = 4096 has no effect with speed = \"exact\"; remove it, or use speed = \"difference\""},
      {"an exact speed with noise", but("[sensor]\nspeed_filter_Hz = 200", "[sensor]\nspeed = \"exact\"\nnoise_rad = 1e-5"),
       "s.toml:23:13: error: sensor.noise_rad = 1e-05 has no effect with speed = \"exact\"; remove it, or use speed = \"difference\""},
      {"an exact speed with a filter", but("[sensor]\nspeed_filter_Hz", "[sensor]\nspeed = \"exact\"\nspeed_filter_Hz"),
       "s.toml:23:19: error: sensor.speed_filter_Hz = 200 has no effect with speed = \"exact\"; remove it, or use speed = \"difference\""},
      {"half a count", but("[sensor]", "[sensor]\ncounts = 16.5"), "s.toml:22:10: error: sensor.counts = 16.5 must be a whole number"},
      {"no deviation", but("[sensor]", "[disturbance]\nseed = 3\n[sensor]"), "s.toml:21:1: error: [disturbance] lacks 'deviation_Nm' (standard deviation)"},
      {"a window beyond the end", but("[sensor]", "[metrics]\nfrom_s = 1\n[sensor]"),
       "s.toml:22:10: error: metrics.from_s = 1 s must be less than the duration, 0.01 s"},
      {"a window the wrong way round", but("[sensor]", "[metrics]\nfrom_s = 0.005\nto_s = 0.002\n[sensor]"),
       "s.toml:22:10: error: metrics.from_s = 0.005 s must be less than to_s = 0.002 s"}});
}

}  // namespace wormdrive::test::cli_bad_controllers
