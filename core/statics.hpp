#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/mesh.hpp"
#include "core/numbers/portable.hpp"

namespace wormdrive {

/// Forces of the mesh at rest: N = flank * Wn and Wf [N], from theta' = theta'' = 0 [YehWu2009, eq. 6-7].
struct MeshForces {
  double normal;    ///< flank * Wn: positive on the left flank
  double friction;  ///< Wf
};

/// Solves the two torque balances at rest for the mesh forces; right and left flank are one solution with N signed.
inline MeshForces forces_at_rest(const GearMesh<double>& mesh, double tau_m, double tau_l) {
  const double cos_phi = portable::cos(mesh.phi_n), s = portable::sin(mesh.lambda), c = portable::cos(mesh.lambda);
  const double worm_force = tau_m / mesh.lw, gear_force = tau_l / mesh.lg;
  // worm: 0 = worm_force + N cos_phi s - Wf c;  gear: 0 = gear_force - N cos_phi c - Wf s
  return {(gear_force * c - worm_force * s) / cos_phi, worm_force * c + gear_force * s};
}

/// Whether the mesh sticks at these torques, |Wf| <= mu_s Wn [YehWu2009, eq. 8], in all three locking regimes.
inline bool sticks(const GearMesh<double>& mesh, double tau_m, double tau_l) {
  const MeshForces forces = forces_at_rest(mesh, tau_m, tau_l);
  return std::abs(forces.friction) <= mesh.mu * std::abs(forces.normal);
}

/// Motor torques that hold the gear at a load torque [N m]: the closed interval, or everything outside the open one.
struct StickRegion {
  double low, high;
  bool outside = false;  ///< worm self-locking: stuck outside (low, high), the wedge of [YehWu2009, fig. 4] moves
  friend bool operator==(const StickRegion&, const StickRegion&) = default;
};

/// The stick region at load torque tau_l [YehWu2009, eq. 9-10 and fig. 3-5].
inline StickRegion stick_region(const GearMesh<double>& mesh, double tau_l) {
  const double a = -mesh.C1() * tau_l, b = -mesh.C2() * tau_l;
  return {std::min(a, b), std::max(a, b), mesh.regime() == LockingRegime::worm_self_locking};
}

/// Motor torques at which the gear starts to turn [N m]; empty for a worm that locks itself: it has only the wedge.
struct BreakInTorques {
  std::optional<double> forward, backward;
};

/// Break-in torques in both directions: -C1 tau_l and -C2 tau_l, which swap with the sign of tau_l [YehWu2009, eq.
/// 9-10].
inline BreakInTorques break_in_torques(const GearMesh<double>& mesh, double tau_l) {
  const StickRegion region = stick_region(mesh, tau_l);
  if (region.outside) return {};
  return {region.high, region.low};
}

/// Direction in which the gear starts when the torques leave it free; stuck inside the region. For mu < mu_g.
inline Motion release_direction(const GearMesh<double>& mesh, double tau_m, double tau_l) {
  const StickRegion region = stick_region(mesh, tau_l);
  if (tau_m > region.high) return Motion::forward;
  return tau_m < region.low ? Motion::backward : Motion::stuck;
}

/// Efficiency with the worm driving, 1/(i C2); 0 where the worm locks itself.
inline double forward_efficiency(const GearMesh<double>& mesh) {
  return mesh.regime() == LockingRegime::worm_self_locking ? 0.0 : 1.0 / (mesh.i * mesh.C2());
}

/// Efficiency with the gear driving, i C1; negative when self-locking: the motor must help to lower the load.
inline double backward_efficiency(const GearMesh<double>& mesh) { return mesh.i * mesh.C1(); }

}  // namespace wormdrive
