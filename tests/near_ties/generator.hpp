#pragma once
#include <cstdint>

#include "near_ties/case.hpp"

namespace wormdrive::test::near_ties {

/// The case of this number among those of a seed; it can be made alone.
Case make_case(std::uint64_t seed, std::uint64_t index);

}  // namespace wormdrive::test::near_ties
