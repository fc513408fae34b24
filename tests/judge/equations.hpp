#pragma once
#include <optional>

#include "judge/drive.hpp"
#include "judge/real.hpp"
#include "judge/tape.hpp"

namespace judge {

template <class Real>
typename Tape<Real>::Value like(typename Tape<Real>::Value v, Real constant) {
  return v.tape->constant(constant);
}
template <class Real>
Sized like(const Sized&, Real constant) {
  return {constant};
}

/// What the torques of a drive depend on: its inputs [N m], angle [rad] and speed [rad/s] of the gear, and how long it
/// has been at rest [s], where it is.
template <class S>
struct Circumstances {
  S motor, load, theta, omega;
  std::optional<S> rest{};
};

/// What the torques come to: theta'' = pull / inertia, and the distance from the switching surface [N m].
template <class S>
struct Outcome {
  S pull, inertia, beyond;
};

/// The equations of motion of docs/model.md, "Two bodies, one equation" and "The flank", with the effects' laws.
template <class Real>
class Equations {
 public:
  explicit Equations(const Drive& drive) : drive_(drive) {
    const Real lambda = drive.lambda, phi_n = drive.phi_n;
    sine_ = sin(lambda);
    cosine_ = cos(lambda);
    cos_phi_ = cos(phi_n);
    Jg_ = drive.Jg;
    if (drive.arm) Jg_ += Real(drive.arm->inertia);
  }

  /// In a direction of motion and on a flank; sigma is +1 or -1 also where the gear rests and is asked whether it
  /// starts.
  template <class S>
  Outcome<S> operator()(const Circumstances<S>& at, int sigma, int flank) const {
    const S one = like<Real>(at.theta, Real(1));
    S turn = at.theta, slope = one, curvature = like<Real>(at.theta, Real(0));  // of theta_w/i over theta_g
    if (const auto& e = drive_.transmission_error) {
      const S x = at.theta + Real(e->phase), s = Real(e->amplitude) * sin(x);
      turn = at.theta + s;
      slope = one + Real(e->amplitude) * cos(x);
      curvature = curvature - s;
    }
    const Real i = drive_.teeth ? drive_.i : 1.0;
    const S omega_w = drive_.transmission_error ? i * (slope * at.omega) : i * at.omega;
    const S worm = on_worm(at, i * turn, omega_w, sigma), gear = on_gear(at, sigma);
    if (!drive_.teeth) return {worm + gear, like<Real>(at.theta, Jg_), like<Real>(at.theta, Real(-1))};

    const S m = Real(sigma * flank) * friction(at, omega_w, sigma);
    const Real radii = Real(drive_.lw) / Real(drive_.lg), Jwi = Real(drive_.Jw) * i;
    const S C =
        radii * ((like<Real>(m, cos_phi_ * sine_) - cosine_ * m) / (like<Real>(m, cos_phi_ * cosine_) + sine_ * m));
    if (!drive_.transmission_error) return {worm + C * gear, Jg_ * C + Jwi, worm - (Jwi / Jg_) * gear};
    // theta_w'' = i (slope theta_g'' + curvature theta_g'^2), and the lever arms at the worm are 1/slope of the even
    // ones
    const S rest = worm - Jwi * (curvature * (at.omega * at.omega));
    return {slope * rest + C * gear, Jwi * (slope * slope) + Jg_ * C, rest - (Jwi / Jg_) * (slope * gear)};
  }

 private:
  template <class S>
  S on_worm(const Circumstances<S>& at, const S& theta_w, const S& omega_w, int sigma) const {
    S torque = at.motor;
    if (drive_.torque_gain) torque = torque + Real(*drive_.torque_gain) * at.motor;
    if (drive_.torque_offset) torque = torque + Real(*drive_.torque_offset);
    if (const auto& e = drive_.cogging)
      torque = torque + Real(e->amplitude) * sin(Real(e->periods) * theta_w + Real(e->phase));
    if (drive_.worm_coulomb) torque = torque - Real(sigma) * Real(*drive_.worm_coulomb);
    if (drive_.worm_viscous) torque = torque - Real(*drive_.worm_viscous) * omega_w;
    if (const auto& e = drive_.bearing_asymmetry)
      torque = torque - Real(e->torque) - Real(sigma) * Real(e->coefficient) * omega_w;
    return torque;
  }
  template <class S>
  S on_gear(const Circumstances<S>& at, int sigma) const {
    S torque = at.load;
    if (const auto& arm = drive_.arm) torque = Real(arm->amplitude) * cos(at.theta + Real(arm->offset));
    if (const auto& e = drive_.load_spring) torque = torque - Real(e->stiffness) * (at.theta - Real(e->angle));
    if (drive_.gear_coulomb) torque = torque - Real(sigma) * Real(*drive_.gear_coulomb);
    if (drive_.gear_viscous) torque = torque - Real(*drive_.gear_viscous) * at.omega;
    return torque;
  }
  template <class S>
  S friction(const Circumstances<S>& at, const S& omega_w, int sigma) const {
    const S one = like<Real>(at.theta, Real(1));
    S mu = like<Real>(at.theta, Real(drive_.mu));
    if (const auto& e = drive_.stribeck) {
      const Real per_speed = Real(drive_.lw) / cosine_ / Real(e->speed) * Real(-sigma);
      mu = mu - Real(e->drop) * (one - exp(per_speed * omega_w));
    }
    if (drive_.friction_asymmetry) mu = mu + Real(sigma) * Real(*drive_.friction_asymmetry);
    if (const auto& e = drive_.static_friction; e && at.rest)
      mu = mu + Real(e->rise) * (e->growth_time > 0.0 ? one - exp((Real(-1) / Real(e->growth_time)) * *at.rest) : one);
    return mu;
  }

  Drive drive_;
  Real sine_, cosine_, cos_phi_, Jg_;
};

}  // namespace judge
