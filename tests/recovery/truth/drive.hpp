#pragma once
#include <limits>
#include <numbers>

// The ground truth of the recovery tests: a worm drive as a machine has it, with equations, solver and controller of
// its own. Nothing here includes core/, events/, control/ or scenarios/: a diagnosis that finds an effect in these data
// has not found its own code. All in SI.
namespace truth {

/// What a data sheet states: Table 1 of Yeh & Wu 2009 with a mass of 1 kg on an arm of 7 cm.
struct Geometry {
  double ratio = 60;
  double lead_angle = 4 * std::numbers::pi / 180;
  double pressure_angle = 20 * std::numbers::pi / 180;
  double worm_radius = 0.011, gear_radius = 0.045;
  double worm_inertia = 2.53e-5, gear_inertia = 7.39e-4;  ///< the gear's without the load
  double mass = 1.0, arm = 0.07;
  double gravity = 9.81;
};

/// What a data sheet states of a drive.
struct Sheet {
  Geometry geometry;
  double friction = 0.25;  ///< between the teeth
};

/// Friction between the teeth, a function of everything that it may depend on.
struct MeshFriction {
  enum class Fall { gaussian, lorentzian, hyperbolic };

  double level = 0.25;
  double drop = 0.0, fall_speed = 0.1;  ///< Stribeck: what it loses at speed, and by which sliding speed [m/s]
  Fall fall = Fall::gaussian;
  double asymmetry = 0.0;                                 ///< more forward, less backward
  double wave = 0.0, wave_phase = 0.0;                    ///< share over the gear angle
  double worm_wave = 0.0, worm_wave_phase = 0.0;          ///< share over the worm angle
  double drift = 0.0;                                     ///< share gained until the end of the recording
  double rise = 0.0;                                      ///< of rest over motion, at once
  double dwell_rise = 0.0, dwell_time = 1.0;              ///< of rest, growing while it lasts
  double spot = 0.0, spot_angle = 0.0, spot_width = 0.1;  ///< share more around one angle
};

/// Everything between the command and the shaft of the worm.
struct Actuator {
  double limit = std::numeric_limits<double>::infinity();
  double delay = 0.0, lag = 0.0;  ///< [s]
  double gain = 0.0, offset = 0.0;
  double cogging = 0.0, cogging_periods = 4.0, cogging_phase = 0.0;
  double vibration = 0.0, vibration_frequency = 17.0;  ///< a torque that something beside the drive makes [N m, Hz]
  bool reversed = false;                               ///< the recorded torque runs backward in time
};

/// Friction of the bearings of worm and gear.
struct Bearings {
  double worm_coulomb = 0.0, worm_viscous = 0.0, gear_coulomb = 0.0, gear_viscous = 0.0;
  double asymmetry_torque = 0.0, asymmetry_viscous = 0.0;  ///< of the worm, more forward
  double fan = 0.0;                                        ///< square-law drag of the gear [N m s^2]
};

/// The mass on its arm and what else pulls at the gear.
struct Load {
  double excess = 0.0;  ///< share of the torque
  double angle = 0.0;
  double spring = 0.0, spring_angle = 0.0;
  double lost = 0.0, lost_at = std::numeric_limits<double>::infinity();  ///< share of the mass that falls off, and when
};

/// How the teeth touch: a spring and a damper along the normal that push only.
struct Teeth {
  double stiffness = 2e7;                 ///< [N/m]
  double damping_ratio = 0.15;            ///< of the vibration of the gear against the worm
  double gap = 0.0;                       ///< [rad] at the gear
  double error = 0.0, error_phase = 0.0;  ///< transmission error over the gear angle [rad]
};

/// Encoders, and the noise that nobody asked for.
struct Sensor {
  double delay = 0.0, scale = 0.0, offset = 0.0;
  double counts = 65536, noise = 3e-5;  ///< per turn, 0: not rounded; standard deviation before rounding [rad]
  double worm_counts = 0.0;             ///< 0: there is no encoder on the worm
};
struct Noise {
  double white = 5e-4;  ///< of the torque, held over a sample [N m]
  double coloured = 0.0, time_constant = 0.05;
};

struct Drive {
  Sheet sheet;
  Geometry geometry;
  double worm_inertia_excess = 0.0, gear_inertia_excess = 0.0;
  MeshFriction friction;
  Actuator actuator;
  Bearings bearings;
  Load load;
  Teeth teeth;
  Sensor sensor;
  Noise noise;
};

}  // namespace truth
