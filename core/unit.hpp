#pragma once
#include <numbers>
#include <string_view>

namespace wormdrive {

/// A unit at the edge of the program: how a key ends, how it is printed, and its size in SI.
struct Unit {
  std::string_view suffix;  ///< end of a TOML key or CSV column, "Nm" in torque_Nm; empty for pure numbers
  std::string_view symbol;  ///< as printed, "N m"
  double si = 1.0;          ///< one of this unit in SI
  bool whole = false;       ///< takes whole numbers only
};

namespace unit {
inline constexpr double degree = std::numbers::pi / 180.0;

inline constexpr Unit none{"", "1"};
inline constexpr Unit whole{"", "1", 1.0, true};  ///< how many, which of several, an order
inline constexpr Unit percent{"percent", "%", 0.01};
inline constexpr Unit share{"share", "1"};
inline constexpr Unit second{"s", "s"};
inline constexpr Unit hertz{"Hz", "Hz"};
inline constexpr Unit metre{"m", "m"};
inline constexpr Unit per_metre{"per_m", "1/m"};
inline constexpr Unit metre_per_second{"m_per_s", "m/s"};
inline constexpr Unit kilogram{"kg", "kg"};
inline constexpr Unit newton{"N", "N"};
inline constexpr Unit newton_per_metre{"N_per_m", "N/m"};
inline constexpr Unit newton_second_per_metre{"Ns_per_m", "N s/m"};
inline constexpr Unit second_per_metre{"s_per_m", "s/m"};
inline constexpr Unit radian{"rad", "rad"};
inline constexpr Unit degrees{"deg", "deg", degree};
inline constexpr Unit radian_per_second{"rad_per_s", "rad/s"};
inline constexpr Unit radian_per_second_squared{"rad_per_s2", "rad/s^2"};
inline constexpr Unit newton_metre{"Nm", "N m"};
inline constexpr Unit newton_metre_second{"Nms", "N m s"};
inline constexpr Unit newton_metre_per_second{"Nm_per_s", "N m/s"};
inline constexpr Unit newton_metre_per_radian{"Nm_per_rad", "N m/rad"};
inline constexpr Unit second_per_radian{"s_per_rad", "s/rad"};
inline constexpr Unit newton_metre_second_per_radian{"Nms_per_rad", "N m s/rad"};
inline constexpr Unit kilogram_square_metre{"kgm2", "kg m^2"};
inline constexpr Unit volt{"V", "V"};
inline constexpr Unit ampere{"A", "A"};
inline constexpr Unit ohm{"ohm", "ohm"};
inline constexpr Unit henry{"H", "H"};
inline constexpr Unit kelvin{"K", "K"};
inline constexpr Unit joule_per_kelvin{"J_per_K", "J/K"};
inline constexpr Unit kelvin_per_watt{"K_per_W", "K/W"};
inline constexpr Unit per_kelvin{"per_K", "1/K"};
inline constexpr Unit newton_metre_per_ampere{"Nm_per_A", "N m/A"};
inline constexpr Unit volt_per_newton_metre{"V_per_Nm", "V/(N m)"};
}  // namespace unit

}  // namespace wormdrive
