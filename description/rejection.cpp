#include "description/rejection.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/elastic/elastic_teeth.hpp"
#include "description/build_control.hpp"

namespace wormdrive {

/// Beyond mu_g the worm brakes itself, for C2 has passed through infinity; without eq. 17 no motion is unique.
std::optional<std::string> why_it_cannot_move(const Scenario& scenario) {
  const auto* const parameters = std::get_if<MeshParameters<double>>(&scenario.mesh);
  if (!parameters) return std::nullopt;
  GearMesh<double> mesh = make_mesh(scenario);
  const double stated = parameters->mu;
  const FrictionRange range = scenario.effects.friction_range({stated, stated}, scenario.run.duration);
  if (range.low < 0.0)
    return fmt::format("mesh.friction = {} may fall to {:.6g} with its effects; friction must be at least 0", stated,
                       range.low);
  if (has_elastic_teeth(scenario.effects)) return std::nullopt;  // which have one motion for every friction
  mesh.mu = range.high;
  std::string friction = fmt::format("mesh.friction = {}", stated);
  if (mesh.mu != stated) friction += fmt::format(", which may rise to {:.6g} with its effects,", mesh.mu);
  if (mesh.mu >= mesh.mu_g())
    return fmt::format(
        "{} is not below mu_g = {:.6g} (cos(phi_n)/tan(lambda)): the worm would lock itself; only "
        "elastic teeth, [effect.tooth_compliance], allow it",
        friction, mesh.mu_g());
  const double slope = scenario.effects.least_slope(), Jw_i = mesh.Jw * mesh.i * slope * slope;
  const double Jg = greatest_gear_inertia(scenario), surface = Jw_i / Jg;
  if (mesh.C1() > -surface) return std::nullopt;
  const std::string limit =
      slope < 1.0 ? fmt::format("-Jw i k^2/Jg where the worm is slowest, k = {:.6g},", slope) : "-Jw i/Jg";
  return fmt::format(
      "{} violates eq. 17, C1 > -Jw i/Jg: C1 = {:.6g}, {} = {:.6g} with Jg = {:.6g} kg m^2; the rigid drive would jam. "
      "Lower the friction, raise worm_inertia_kgm2, lower the gear-side inertia below {:.6g} kg m^2, or add "
      "[effect.tooth_compliance]: elastic teeth can jam",
      friction, mesh.C1(), limit, -surface, Jg, -Jw_i / mesh.C1());
}

template <class Parameters>
bool states_anything(const Parameters& parameters) {
  const Parameters nothing{};
  bool any = false;
  for_each_field<Parameters>([&](const auto& f) { any = any || parameters.*f.member != nothing.*f.member; });
  return any;
}
/// What is stated about a model for a law that has none.
std::vector<ControllerRejection> unused_models(const ControlScenario& control) {
  std::vector<ControllerRejection> list;
  const std::string_view kind = std::visit([](const auto& law) { return law.kind; }, control.law);
  for (const auto& [table, stated] : {std::pair{"nominal", states_anything(control.nominal)},
                                      std::pair{"variation", states_anything(control.variations)}})
    if (stated)
      list.push_back({table, fmt::format("[controller.{}] has no effect with kind = \"{}\", a law without a model; "
                                         "remove it",
                                         table, kind)});
  return list;
}

/// Both branches must have a positive inertia, for the law divides by it, the linear design a solution, and no
/// anti-windup may be faster than the samples.
std::vector<ControllerRejection> controller_rejections(const Scenario& scenario) {
  if (!scenario.control) return {};
  if (!has_model(scenario.control->law)) return unused_models(*scenario.control);
  std::vector<ControllerRejection> list;
  const NominalModel nominal = make_nominal(scenario);
  for (const auto& [name, C] : {std::pair{"C1", nominal.C1}, std::pair{"C2", nominal.C2}})
    if (nominal.inertia(C) <= 0.0)
      list.push_back({"nominal", fmt::format("the nominal model violates eq. 17: Jw i + {} Jg = {:.6g} kg m^2 must be "
                                             "greater than 0",
                                             name, nominal.inertia(C))});
  const auto* const sliding = std::get_if<SlidingParameters>(&scenario.control->law);
  if (sliding && list.empty()) {
    const SlidingBounds bounds(*sliding, make_lemma1(scenario));
    for (const std::size_t k : {0, 1})
      if (std::isinf(bounds.D[k]) || std::isinf(bounds.E[k]))
        list.push_back({"variation",
                        fmt::format("controller.variation leaves the branch C{0} without inertia, Jw i + C{0} Jg <= 0, "
                                    "and no gain withstands that; reduce the variation, or state D{0}_per_kgm2 and "
                                    "E{0}_rad_per_s2",
                                    k + 1)});
  }
  const auto* const pid = std::get_if<PidParameters>(&scenario.control->law);
  if (pid && pid->integral_weight > 0.0 && list.empty() &&
      !stabilises(lqr_gains(*pid, mean_inertia(nominal)), mean_inertia(nominal)))
    list.push_back(
        {"kind", "the weights have no stabilising gains in double precision; bring them closer to each other"});
  const auto& [method, tracking_time] = scenario.control->anti_windup;
  const double period = scenario.control->sampling.period;
  if (AntiWindupSettings::tracks(method) && tracking_time && *tracking_time < period)
    list.push_back({"tracking_time_s", fmt::format("controller.tracking_time_s = {} s must be at least the sample "
                                                   "time, {} s",
                                                   *tracking_time, period)});
  return list;
}

std::optional<ControllerRejection> variation_rejection(const Scenario& scenario) {
  if (!scenario.control) return std::nullopt;
  const Variations& variations = scenario.control->variations;
  if (!variations.friction || (variations.C1 <= 0.0 && variations.C2 <= 0.0)) return std::nullopt;
  return ControllerRejection{
      "friction", "controller.variation.friction is stated along with C1 or C2; keep the friction, or the two others"};
}

std::vector<ControllerRejection> sensor_rejections(const Scenario& scenario) {
  if (!scenario.control || !scenario.control->sensor.exact_speed) return {};
  const SensorSettings& sensor = scenario.control->sensor;
  std::vector<ControllerRejection> list;
  // An exact speed is none that was made of counts, noise or a filtered difference.
  for (const auto& [key, value] : {std::pair{"counts", sensor.counts}, std::pair{"noise_rad", sensor.noise},
                                   std::pair{"speed_filter_Hz", sensor.filter_cutoff}})
    if (value > 0.0)
      list.push_back({key, fmt::format("sensor.{} = {:g} has no effect with speed = \"exact\"; remove it, or use speed "
                                       "= \"difference\"",
                                       key, value)});
  return list;
}

std::vector<ControllerRejection> sampling_rejections(const Scenario& scenario) {
  constexpr double most_samples = 1e9;  // of a run; whoever asks for more has slipped in the unit
  if (!scenario.control) return {};
  const SamplingSettings& sampling = scenario.control->sampling;
  const double duration = scenario.run.duration, period = sampling.period;
  if (duration <= 0.0 || period <= 0.0) return {};
  std::vector<ControllerRejection> list;
  if (period > duration)
    list.push_back({"sample_time_s", fmt::format("controller.sample_time_s = {} s must be at most the duration, {} s",
                                                 period, duration)});
  else if (duration > most_samples * period)
    list.push_back({"sample_time_s",
                    fmt::format("controller.sample_time_s = {} s would give {:.3g} samples; at most {:g} are allowed",
                                period, duration / period, most_samples)});
  if (sampling.offset >= duration)
    list.push_back(
        {"sample_offset_s", fmt::format("controller.sample_offset_s = {} s must be less than the duration, {} s",
                                        sampling.offset, duration)});
  return list;
}

std::optional<ControllerRejection> window_rejection(const Scenario& scenario) {
  if (!scenario.control) return std::nullopt;
  const MetricsWindow& window = scenario.control->window;
  const double duration = scenario.run.duration;
  if (window.from >= window.to)
    return ControllerRejection{
        "from_s", fmt::format("metrics.from_s = {} s must be less than to_s = {} s", window.from, window.to)};
  if (duration > 0.0 && window.from >= duration)
    return ControllerRejection{
        "from_s", fmt::format("metrics.from_s = {} s must be less than the duration, {} s", window.from, duration)};
  return std::nullopt;
}

std::optional<std::string> why_the_drive_cannot_run(const Scenario& scenario) {
  if (const auto effects = effect_rejections(scenario); !effects.empty()) return effects.front().what;
  return why_it_cannot_move(scenario);
}

std::optional<std::string> why_it_cannot_run(const Scenario& scenario) {
  if (auto why = why_the_drive_cannot_run(scenario)) return why;
  if (const auto controller = controller_rejections(scenario); !controller.empty()) return controller.front().what;
  if (const auto variation = variation_rejection(scenario)) return variation->what;
  if (const auto sensor = sensor_rejections(scenario); !sensor.empty()) return sensor.front().what;
  if (const auto sampling = sampling_rejections(scenario); !sampling.empty()) return sampling.front().what;
  if (const auto window = window_rejection(scenario)) return window->what;
  return std::nullopt;
}

}  // namespace wormdrive
