#pragma once
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace wormdrive::test {

/// The first of some cases that take seconds each; all of them where WORMDRIVE_ALL_CASES is set, as in the target
/// long_tests, which runs the tests with the tag [cases].
template <class Case>
std::vector<Case> some_of(std::vector<Case> all, std::size_t count = 1) {
  if (std::getenv("WORMDRIVE_ALL_CASES") == nullptr && count < all.size())
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(count), all.end());
  return all;
}

}  // namespace wormdrive::test
