#pragma once
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include "recovery/truth/size.hpp"

namespace truth {

using Generator = std::mt19937_64;

enum class Size { small, medium, large };
inline constexpr Size sizes[] = {Size::small, Size::medium, Size::large};
std::string_view name(Size size);

/// What an extended scenario would state, read off the true drive.
struct TrueParameter {
  std::string_view field;  ///< as the catalogue calls it
  double (*of)(const Drive&);
};

/// Something that can be hidden in a drive.
struct Secret {
  std::string_view effect;      ///< id in the catalogue; of what stands outside it, our name
  double small, medium, large;  ///< in the usual drive
  bool either_sign;
  bool needs_worm_encoder;  ///< the gear's own encoder does not show it
  void (*hide)(Drive&, double size, Generator&);
  std::vector<TrueParameter> parameters;
  Dimension dimension = Dimension::plain;  ///< of the sizes
  std::vector<std::string_view> twins{};   ///< effects with exactly the same data: naming one of them is right

  double amount(Size size, const Sheet& sheet = {}) const;
};

/// Every effect of the catalogue that a recording can show.
std::span<const Secret> catalogue();
/// What no effect of the catalogue explains. `dwell` may be called static_friction.
std::span<const Secret> outside();
/// One of the two by name; throws std::invalid_argument for an unknown one.
const Secret& secret(std::string_view effect);

/// Standard deviations by which the drive differs from its data sheet.
struct NominalErrors {
  double share = 0.0;   ///< of friction, mass, both inertias and the torque constant
  double angle = 0.0;   ///< of the arm [rad]
  double offset = 0.0;  ///< of the motor torque [N m]
};

/// A drive by its data sheet, drawn: ratios of 8 to 100, friction of 0.03 to 0.25, 0.3 to 30 times the usual size.
Drive any_drive(Generator& generator);

/// Moves everything that a data sheet states by a normal deviate.
void disturb_nominal(Drive& drive, const NominalErrors& errors, Generator& generator);

}  // namespace truth
