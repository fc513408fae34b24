#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "control/nominal.hpp"
#include "core/field.hpp"
#include "core/mesh.hpp"

namespace wormdrive {

/// Relative variations around the nominal model that a sliding controller is to withstand; friction stands for the C1
/// and C2 that follow from it.
struct Variations {
  double C1{0.0}, C2{0.0}, load{0.0}, inertia{0.0};
  std::optional<double> friction;
  std::optional<std::array<double, 2>> by_friction{};  ///< never stated: |C1 - C1_hat|, |C2 - C2_hat| that it comes to

  static constexpr auto fields() {
    using P = Variations;
    constexpr Presence o = Presence::optional;
    constexpr Bounds share = bounds::between(0.0, 0.99);
    return std::tuple{
        Field{&P::C1, "C1", unit::none, bounds::not_negative, "relative variation of C1", o},
        Field{&P::C2, "C2", unit::none, bounds::not_negative, "relative variation of C2", o},
        Field{&P::load, "load", unit::none, bounds::not_negative, "relative error of the load estimate", o},
        Field{&P::inertia, "gear_inertia", unit::none, share, "relative variation of Jg", o},
        Field{&P::friction, "friction", unit::none, share, "relative variation of the friction, instead of C1 and C2",
              o}};
  }
};

/// The variations with those of C1 and C2 in place of that of the friction; not as shares, for C1 may be 0.
inline Variations in_terms_of_C(Variations variations, const GearMesh<double>& mesh) {
  if (!variations.friction) return variations;
  std::array<double, 2>& by = variations.by_friction.emplace();
  for (const double share : {-*variations.friction, *variations.friction}) {
    const double mu = mesh.mu * (1.0 + share);
    by[0] = std::max(by[0], std::abs(mesh.C(mu) - mesh.C1()));
    by[1] =
        std::max(by[1], mu < mesh.mu_g() ? std::abs(mesh.C(-mu) - mesh.C2()) : std::numeric_limits<double>::infinity());
  }
  variations.friction.reset();
  return variations;
}

/// What Lemma 1 needs for one of the two branches C1, C2 [YehWu2009, eq. 20-21].
struct BranchBounds {
  double b_hat;  ///< 1/(Jw i + C Jg), nominal [1/(kg m^2)]
  double d_hat;  ///< nominal, 1/Jg for any C [1/(kg m^2)]
  double beta;   ///< least gain margin over the variations
  double D;      ///< largest |d - d_hat|, d as the law that runs has it [1/(kg m^2)]
  double E;      ///< largest |e - e_hat|, e_hat = 0 [rad/s^2]
};

/// The numbers of Lemma 1 for a nominal model and its variations.
struct Lemma1 {
  std::array<BranchBounds, 2> branch;  ///< of C1 and C2
  double M;                            ///< largest distance of the true surface from u = 0 [N m]
  double largest_load;                 ///< largest |tau_l_hat| [N m]
};

/// Bounds over all corners of the variations, between which every quantity is monotone; infinite where a corner leaves
/// a branch without inertia.
///
/// They are those of the law that runs. It knows the nominal surface only, u = tau_m - (Jw i/Jg_hat) tau_l_hat, so that
/// the drive is theta'' = b u + d tau_l_hat + e with d = (C + Jw i/Jg_hat)/(Jw i + C Jg), and
/// d - d_hat = (C/Jg_hat) (Jg_hat - Jg)/(Jw i + C Jg). The paper's d, 1/Jg, belongs to a u with the true Jg, which no
/// controller has. The true surface lies at u = (Jw i/Jg) tau_l_tilde + (Jw i/Jg - Jw i/Jg_hat) tau_l_hat: M covers
/// both.
inline Lemma1 lemma1(const NominalModel& nominal, const Variations& variations) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Lemma1 result{};
  result.largest_load = std::abs(nominal.load_torque) + std::abs(nominal.load_constant);
  const double load_error = variations.load * result.largest_load;
  const std::array<double, 2> C{nominal.C1, nominal.C2}, share{variations.C1, variations.C2};
  for (int k = 0; k < 2; ++k) {
    BranchBounds& branch = result.branch[k];
    branch.b_hat = 1.0 / nominal.inertia(C[k]);
    branch.d_hat = 1.0 / nominal.Jg;
    branch.beta = 1.0;
    for (const double c : {-1.0, 1.0})
      for (const double j : {-1.0, 1.0}) {
        const double Ck =
            variations.by_friction ? C[k] + c * (*variations.by_friction)[k] : C[k] * (1.0 + c * share[k]);
        const double Jg = nominal.Jg * (1.0 + j * variations.inertia), inertia = nominal.Jw_i + Ck * Jg;
        const double ratio = branch.b_hat * inertia, surface = nominal.Jw_i / Jg;
        const bool moves = inertia > 0.0;
        branch.beta = std::max({branch.beta, ratio, moves ? 1.0 / ratio : infinity});
        branch.D = std::max(branch.D, moves ? std::abs(Ck * (nominal.Jg - Jg)) * branch.d_hat / inertia : infinity);
        branch.E = std::max(branch.E, moves ? std::abs(Ck * load_error / inertia) : infinity);
        result.M =
            std::max(result.M, surface * load_error + std::abs(surface - nominal.surface()) * result.largest_load);
      }
  }
  return result;
}

}  // namespace wormdrive
