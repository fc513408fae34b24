#pragma once
// What the kernels take from the standard library. Its inline functions are shared with the rest of the program, so
// that a kernel includes them before it turns to the instructions of a newer processor.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>
