#include <cstddef>

// The C++ library in an FMU keeps memory for exceptions, 73 KB, until its process ends; a process that loads and
// unloads FMUs would lose as much with each. It goes with the FMU.
#ifdef __GLIBCXX__
namespace __gnu_cxx {
void __freeres();
}

namespace {
[[gnu::destructor]] void free_memory_for_exceptions() { __gnu_cxx::__freeres(); }
}  // namespace
#endif
