#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace wormdrive::fuzz {

/// Numbers and choices, as far as the bytes go; then zeros.
class ByteSource {
 public:
  ByteSource(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  bool empty() const { return at_ == end_; }
  std::uint8_t byte() { return empty() ? std::uint8_t{0} : *at_++; }
  double number() {
    const std::uint8_t kind = byte();
    if (kind % 4 != 0) return (kind - 128) * 0.01;
    std::uint64_t bits = 0;
    for (int k = 0; k < 8; ++k) bits = bits << 8 | byte();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  const std::uint8_t *at_, *end_;
};

}  // namespace wormdrive::fuzz
