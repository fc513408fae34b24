#pragma once
#include <string>

namespace wormdrive {

/// The full path of a file or folder that belongs to the program, such as "share/wormdrive/plots/plot.py": it stands
/// below the folder of the program, as in a build, or below that folder's parent, as in an installation. So both can be
/// moved. Throws OutputFault if there is no such file.
std::string resource(const std::string& path);

/// Where a page of the documentation stands, "howto/sweep.md": its full path if it is installed with the program, or
/// else as the sources have it.
std::string documentation_page(const std::string& path);

}  // namespace wormdrive
