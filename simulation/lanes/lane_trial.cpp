#include "simulation/lanes/lane_trial.hpp"

#include <limits>
#include <optional>
#include <variant>

namespace wormdrive {
namespace {

/// Of a law for which nothing is promised.
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Lemma1Quiet<double> all_quiet{infinity, infinity, infinity};

}  // namespace

LaneTrial<double> lane_trial(const ControlScenario& control, const Effects<double>& effects,
                             const NominalModel& nominal, const Lemma1& lemma, const ControlWatch& watch,
                             double torque_limit) {
  const auto& scale = std::get<std::optional<EncoderScale<double>>>(effects.list);
  const auto& offset = std::get<std::optional<EncoderOffset<double>>>(effects.list);
  const double zero_error = control.sensor.zero_error;
  LaneTrial<double> trial{.sliding = {},
                          .pid = {},
                          .load_torque = nominal.load_torque,
                          .load_angle_offset = nominal.load_angle_offset,
                          .load_constant = nominal.load_constant,
                          .encoder_share = scale ? scale->share : 0.0,
                          .encoder_zero = offset ? offset->angle : -0.0,  // which changes no angle, not even 0
                          .count = Encoder(control.sensor).count(),
                          .zero_error = zero_error != 0.0 ? zero_error : -0.0,
                          .age = effects.measuring_delay(),
                          .latched = 0.0,
                          .speed = {control.sensor.filter_cutoff, control.sampling.period},
                          .sums = watch.meter.sums(),
                          .quiet = watch.lemma ? watch.lemma->quiet() : all_quiet,
                          .limit = torque_limit,
                          .left = 0.0,
                          .torque = 0.0,
                          .behind = effects.delay() + effects.lag(),
                          .mode = {},
                          .across = {},
                          .flank_changes = 0.0,
                          .counted_flank_changes = 0.0,
                          .arm_offset = {},
                          .per_speed = 1.0,
                          .theta = 0.0,
                          .omega = 0.0};
  if (const auto* const sliding = std::get_if<SlidingParameters>(&control.law))
    trial.sliding = {*sliding, nominal, SlidingBounds(*sliding, lemma)};
  if (const auto* const pid = std::get_if<PidParameters>(&control.law))
    trial.pid = {lqr_gains(*pid, mean_inertia(nominal)), *pid, nominal};
  return trial;
}

}  // namespace wormdrive
