#pragma once
#include "control/control_summary.hpp"
#include "control/lanes/trial.hpp"
#include "description/build_control.hpp"

namespace wormdrive {

/// What a trial has in its lane before it moves; motion and modes are those of its run. torque_limit: of the motor
/// [N m].
LaneTrial<double> lane_trial(const ControlScenario& control, const Effects<double>& effects,
                             const NominalModel& nominal, const Lemma1& lemma, const ControlWatch& watch,
                             double torque_limit);

}  // namespace wormdrive
