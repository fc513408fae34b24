#pragma once
#include <string>

namespace wormdrive {

/// HDF5 up to 1.14 trusts the heap in which texts lie, and a file with a few bytes changed there ends the program that
/// reads it. So a child process reads all structure and texts first. Throws ReadFault if it does not live to its end. A
/// process that is writing results has read what it needs and forks no children. while_written: another program may be
/// writing values in it.
void read_ahead(const std::string& path, bool while_written = false);

}  // namespace wormdrive
