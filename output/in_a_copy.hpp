#pragma once
#include <functional>

namespace wormdrive {

/// Does some work in a copy of this process, which ends with it, within a minute of processor time. False if the copy
/// does not live to its end. For libraries that trust the files they read: a damaged file then ends the copy. True
/// where there can be no copy.
bool ends_well_in_a_copy(const std::function<void()>& work);

}  // namespace wormdrive
