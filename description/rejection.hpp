#pragma once
#include <optional>
#include <string>
#include <vector>

#include "description/scenario.hpp"

namespace wormdrive {

// What the bounds of single fields cannot say against a run.

/// An effect that cannot be on as it is stated.
struct EffectRejection {
  std::string id, what;
};
std::vector<EffectRejection> effect_rejections(const Scenario& scenario);

/// Why no unique motion exists: friction beyond mu_g, where the worm locks itself, or against eq. 17.
std::optional<std::string> why_it_cannot_move(const Scenario& scenario);

/// A key of a controller's table whose values give no controlled run.
struct ControllerRejection {
  std::string key, what;
};
std::vector<ControllerRejection> controller_rejections(const Scenario& scenario);
/// The same for the keys of [controller.variation] and of [sensor].
std::optional<ControllerRejection> variation_rejection(const Scenario& scenario);
std::vector<ControllerRejection> sensor_rejections(const Scenario& scenario);
/// The same for the times of its samples; none before a duration is stated.
std::vector<ControllerRejection> sampling_rejections(const Scenario& scenario);
/// Why metrics have no samples.
std::optional<ControllerRejection> window_rejection(const Scenario& scenario);

/// The first reason that lies in the drive: an effect or a friction that cannot be.
std::optional<std::string> why_the_drive_cannot_run(const Scenario& scenario);

/// The first of all these reasons.
std::optional<std::string> why_it_cannot_run(const Scenario& scenario);

}  // namespace wormdrive
