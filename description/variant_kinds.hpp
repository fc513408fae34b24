#pragma once
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace wormdrive {

/// The `kind` of every alternative of a variant, in its order.
template <class Variant>
std::vector<std::string> kinds_of() {
  return []<std::size_t... K>(std::index_sequence<K...>) {
    return std::vector<std::string>{std::string(std::variant_alternative_t<K, Variant>::kind)...};
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

/// The alternative of the given kind with its default parameters; the last one if no other matches.
template <class Variant, std::size_t K = 0>
Variant make_kind(const std::string& kind) {
  if constexpr (K + 1 < std::variant_size_v<Variant>)
    if (kind != std::variant_alternative_t<K, Variant>::kind) return make_kind<Variant, K + 1>(kind);
  return std::variant_alternative_t<K, Variant>{};
}

}  // namespace wormdrive
