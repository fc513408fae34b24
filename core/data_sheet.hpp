#pragma once
#include <numbers>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/mesh.hpp"

namespace wormdrive {

/// A worm gear as a catalogue states it: teeth in place of radii and lead angle, efficiencies in place of friction, or
/// both efficiencies in place of all of them.
struct DataSheet {
  double i{};                        ///< transmission ratio
  double phi_n{};                    ///< normal pressure angle [rad]
  double a{};                        ///< centre distance [m]
  std::optional<double> starts{};    ///< threads of the worm
  std::optional<double> module{};    ///< of the gear [m]
  std::optional<double> mu{};        ///< coefficient of friction
  std::optional<double> forward{};   ///< efficiency with the worm driving
  std::optional<double> backward{};  ///< with the gear driving
  double Jw{}, Jg{};                 ///< [kg m^2], as in MeshParameters

  static constexpr std::string_view kind = "data_sheet";
  static constexpr std::string_view meaning = "worm and gear from a data sheet";
  static constexpr auto fields() {
    using D = DataSheet;
    constexpr Presence o = Presence::optional;
    constexpr Bounds share = bounds::open(0.0, 1.0), below_one{.high = 1.0, .high_exclusive = true};
    constexpr double half = std::numbers::pi / 2;
    return std::tuple{
        Field{&D::i, "ratio", unit::none, bounds::positive, "transmission ratio, worm angle over gear angle"},
        Field{&D::phi_n, "pressure_angle", unit::degrees, Bounds{0.0, half, false, true}, "normal pressure angle"},
        Field{&D::a, "centre_distance", unit::metre, bounds::positive, "distance of the axes of worm and gear"},
        Field{&D::starts, "starts", unit::whole, bounds::positive, "threads of the worm", o},
        Field{&D::module, "module", unit::metre, bounds::positive, "pitch diameter of the gear over its teeth", o},
        Field{&D::mu, "friction", unit::none, bounds::not_negative, "coefficient of friction between the teeth", o},
        Field{&D::forward, "forward_efficiency", unit::none, share, "power out over power in, worm driving", o},
        Field{&D::backward, "backward_efficiency", unit::none, below_one,
              "the same, gear driving; negative when self-locking", o},
        Field{&D::Jw, "worm_inertia", unit::kilogram_square_metre, bounds::positive,
              "inertia of the worm side, motor included"},
        Field{&D::Jg, "gear_inertia", unit::kilogram_square_metre, bounds::positive,
              "inertia of the gear side without the load"}};
  }
};

// With the angle of friction rho, tan rho = mu / cos phi_n, a gear that closes has the efficiencies
// tan lambda / tan(lambda + rho) forward and tan(lambda - rho) / tan lambda backward: 1/(i C2) and i C1 of its mesh.

/// tan^2 lambda of the gear with both efficiencies; none such closes unless it is in (0, 1].
inline double tan_squared_lead(double forward, double backward) {
  const double both = 1.0 + forward * backward;
  return (both - 2.0 * forward) / (both - 2.0 * backward);
}
/// mu / cos phi_n of a gear with a forward efficiency, from t = tan lambda.
inline double friction_of_forward(double t, double forward) { return t * (1.0 - forward) / (forward + t * t); }
/// mu / cos phi_n of a gear with a backward efficiency, from t = tan lambda.
inline double friction_of_backward(double t, double backward) {
  return t * (1.0 - backward) / (1.0 + backward * t * t);
}

}  // namespace wormdrive
