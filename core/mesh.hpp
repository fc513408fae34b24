#pragma once
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/field.hpp"
#include "core/mode.hpp"
#include "core/numbers/portable.hpp"

namespace wormdrive {

/// Geometry, friction and inertias of a worm gear, as stated in a data sheet.
template <class T>
struct MeshParameters {
  T i{};       ///< transmission ratio theta_w / theta_g
  T lambda{};  ///< lead angle of the worm [rad]
  T phi_n{};   ///< normal pressure angle [rad]
  T lw{};      ///< pitch radius of the worm [m]
  T lg{};      ///< pitch radius of the gear [m]
  T mu{};      ///< coefficient of friction of the mesh
  T Jw{};      ///< inertia of the worm side [kg m^2]
  T Jg{};      ///< inertia of the gear side without the load [kg m^2]

  static constexpr auto fields() {
    using P = MeshParameters;
    constexpr double quarter = std::numbers::pi / 4, half = std::numbers::pi / 2;
    return std::tuple{
        Field{&P::i, "ratio", unit::none, bounds::positive, "transmission ratio, worm angle over gear angle"},
        Field{&P::lambda, "lead_angle", unit::degrees, Bounds{0.0, quarter, true, false}, "lead angle of the worm"},
        Field{&P::phi_n, "pressure_angle", unit::degrees, Bounds{0.0, half, false, true}, "normal pressure angle"},
        Field{&P::lw, "worm_pitch_radius", unit::metre, bounds::positive, "pitch radius of the worm"},
        Field{&P::lg, "gear_pitch_radius", unit::metre, bounds::positive, "pitch radius of the gear"},
        Field{&P::mu, "friction", unit::none, bounds::not_negative, "coefficient of friction between the teeth"},
        Field{&P::Jw, "worm_inertia", unit::kilogram_square_metre, bounds::positive,
              "inertia of the worm side, motor included"},
        Field{&P::Jg, "gear_inertia", unit::kilogram_square_metre, bounds::positive,
              "inertia of the gear side without the load"}};
  }
};

/// A drive without a gear, `[mesh] kind = "none"`.
template <class T>
struct SingleInertia {
  T J{};  ///< [kg m^2], or [kg] for a linear axis

  static constexpr auto fields() {
    return std::tuple{
        Field{&SingleInertia::J, "inertia", unit::kilogram_square_metre, bounds::positive, "inertia that moves"}};
  }
};

/// What locks, decided by the static friction of the mesh [YehWu2009, section 3].
enum class LockingRegime {
  back_drivable,      ///< mu < mu_w: either side can drive the other
  gear_self_locking,  ///< mu_w <= mu <= mu_g: only the worm can drive
  worm_self_locking,  ///< mu > mu_g: without load no motor torque moves it
};

/// The mesh of worm and gear: the torque ratio C and what follows from it.
///
/// Forces of the teeth enter the motion through C alone; every torque balance reads
/// (Jw i + C(m) Jg) theta_g'' = tau_w + C(m) tau_g with m = motion * flank * mu [YehWu2009, eq. 18-19].
template <class T>
class GearMesh {
 public:
  T i{}, mu{}, Jw{}, Jg{}, lw{}, lg{}, lambda{}, phi_n{};
  bool has_teeth = true;  ///< false: a single inertia, no flank and no mesh friction

  explicit GearMesh(const MeshParameters<T>& p)
      : i(p.i), mu(p.mu), Jw(p.Jw), Jg(p.Jg), lw(p.lw), lg(p.lg), lambda(p.lambda), phi_n(p.phi_n) {
    using portable::cos, portable::sin;
    radius_ratio_ = lw / lg;
    cos_phi_sin_lambda_ = cos(phi_n) * sin(lambda);
    cos_phi_cos_lambda_ = cos(phi_n) * cos(lambda);
    sin_lambda_ = sin(lambda);
    cos_lambda_ = cos(lambda);
  }

  /// A single inertia J [kg m^2, or kg for a linear axis] without a gear: the same equation with i = C = 1.
  static GearMesh without_teeth(T J) {
    MeshParameters<T> p;
    p.i = p.lw = p.lg = T(1);
    p.Jg = J;
    GearMesh mesh(p);
    mesh.has_teeth = false;
    mesh.cos_phi_sin_lambda_ = mesh.cos_phi_cos_lambda_ = T(1);
    mesh.sin_lambda_ = mesh.cos_lambda_ = T(0);
    return mesh;
  }

  /// Torque ratio C for a signed friction m = motion * flank * mu: C1 = C(+mu), C2 = C(-mu) [YehWu2009, eq. 9].
  template <class S>
  S C(const S& m) const {
    return radius_ratio_ * (cos_phi_sin_lambda_ - m * cos_lambda_) / (cos_phi_cos_lambda_ + m * sin_lambda_);
  }
  T C1() const { return C(mu); }
  T C2() const { return C(T(-mu)); }

  /// Lever arm of the normal force on the gear, (cos phi_n cos lambda + m sin lambda) lg [m] [YehWu2009, eq. 12, 14].
  template <class S>
  S gear_arm(const S& m) const {
    return (cos_phi_cos_lambda_ + m * sin_lambda_) * lg;
  }
  /// Lever arm of the normal force on the worm, (cos phi_n sin lambda - m cos lambda) lw [m] [YehWu2009, eq. 1].
  template <class S>
  S worm_arm(const S& m) const {
    return (cos_phi_sin_lambda_ - m * cos_lambda_) * lw;
  }

  /// Wn [N] >= 0 between the torques of both sides [N m]: from the balance of the gear with its inertial torque Jg
  /// theta_g'' and the signed friction m while moving [YehWu2009, eq. 12, 14], from rest [eq. 6-7] while stuck.
  template <class S>
  S normal_force(const S& tau_w, const S& tau_g, const S& inertial, Mode mode, const S& m) const {
    using std::abs, portable::cos;
    if (!has_teeth) return S(T(0));
    if (mode.motion == Motion::stuck) return abs(tau_g / lg * cos_lambda_ - tau_w / lw * sin_lambda_) / cos(phi_n);
    return normal_force(tau_g, inertial, mode.flank, m);
  }
  /// The same on a flank of a gear that moves.
  template <class S>
  S normal_force(const S& tau_g, const S& inertial, Flank flank, const S& m) const {
    return T(sign(flank)) * (tau_g - inertial) / gear_arm(m);
  }

  /// Slope of the static surface tau_m = H tau_l, (lw/lg) cot lambda [YehWu2009, eq. 9].
  T H() const { return radius_ratio_ * cos_lambda_ / sin_lambda_; }
  /// Friction above which the gear cannot drive the worm, cos phi_n tan lambda.
  T mu_w() const { return cos_phi_sin_lambda_ / cos_lambda_; }
  /// Friction above which the worm cannot drive the gear, cos phi_n cot lambda.
  T mu_g() const { return cos_phi_cos_lambda_ / sin_lambda_; }

  /// Sliding speed of the teeth at a worm speed [m/s], lw w_w / cos lambda.
  template <class S>
  S sliding_speed(const S& omega_w) const {
    return lw * omega_w / cos_lambda_;
  }

  /// Ratio that the radii and the lead angle imply, lg / (lw tan lambda); a gear that closes has exactly i.
  T closing_ratio() const { return lg / (lw * sin_lambda_ / cos_lambda_); }
  /// Lead angle [rad] with which the radii give the ratio i.
  T closing_lead_angle() const {
    using std::atan;
    return atan(lg / (lw * i));
  }

  LockingRegime regime() const {
    if (mu < mu_w()) return LockingRegime::back_drivable;
    return mu > mu_g() ? LockingRegime::worm_self_locking : LockingRegime::gear_self_locking;
  }

 private:
  T radius_ratio_{}, cos_phi_sin_lambda_{}, cos_phi_cos_lambda_{}, sin_lambda_{}, cos_lambda_{};
};

}  // namespace wormdrive
