#pragma once
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace wormdrive {

/// The finite number that a text is, with a sign if need be and a decimal point whatever the locale says; nothing if
/// any other text stands in it.
inline std::optional<double> number_in(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);  // from_chars knows no plus sign
  const char* const end = text.data() + text.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace wormdrive
