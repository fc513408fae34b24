#pragma once
#include <cstring>

#include "bindings/fmi/component.hpp"

namespace wormdrive {

// Kept states as bytes, as both versions ask for them.

inline const FmuInstance::Kept& kept_at(const void* state) {
  need(state, "the state");
  return *static_cast<const FmuInstance::Kept*>(state);
}

inline Status serialized_size(void* c, const char* function, const void* state, std::size_t* size) {
  return call(c, function, outside_step, [&](FmuInstance& instance) {
    need(size, "the place of the size");
    *size = instance.to_numbers(kept_at(state)).size() * sizeof(double);
  });
}
inline Status serialize(void* c, const char* function, const void* state, void* bytes, std::size_t size) {
  return call(c, function, outside_step, [&](FmuInstance& instance) {
    need(bytes, "the place of the bytes");
    const std::vector<double> numbers = instance.to_numbers(kept_at(state));
    if (size < numbers.size() * sizeof(double))
      throw std::invalid_argument(fmt::format("the state has {} bytes, more than the {} that there is place for",
                                              numbers.size() * sizeof(double), size));
    std::memcpy(bytes, numbers.data(), numbers.size() * sizeof(double));
  });
}
inline Status deserialize(void* c, const char* function, const void* bytes, std::size_t size, void** state) {
  return call(c, function, outside_step, [&](FmuInstance& instance) {
    need(bytes, "the list of bytes");
    need(state, "the place of the state");
    if (size % sizeof(double) != 0) throw std::invalid_argument("the bytes are no state");
    std::vector<double> numbers(size / sizeof(double));
    if (!numbers.empty()) std::memcpy(numbers.data(), bytes, size);
    *state = new FmuInstance::Kept(instance.from_numbers(numbers));
  });
}

}  // namespace wormdrive
