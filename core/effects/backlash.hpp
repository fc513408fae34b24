#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// The teeth have play: within a gap no flank touches.
template <class T>
struct Backlash {
  static constexpr std::string_view id = "backlash";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause = "the teeth are thinner than the spaces they run in, as cut or worn";
  static constexpr std::string_view law = "no flank touches while |theta_g - theta_w/i| < gap/2";
  T gap{};

  static constexpr auto fields() {
    return std::tuple{Field{&Backlash::gap, "gap", unit::degrees, bounds::not_negative,
                            "angle that the gear can turn while the worm is held"}};
  }
};

}  // namespace wormdrive
