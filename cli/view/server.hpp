#pragma once
#include <functional>
#include <string>

#include "cli/view/viewer.hpp"

namespace wormdrive {

/// Serves the page of a viewer on the loopback address until the program is told to end (SIGINT, SIGTERM).
///
/// It answers under a path that holds a token of 128 random bits, to whoever calls it by its own address, and nobody
/// else: GET PATH is the page, POST PATH run takes the values of sliders as JSON and answers with the page of their
/// run. port 0: any free one. Calls opened with the address once it answers. Throws OutputFault where the port is
/// taken.
void serve(Viewer& viewer, int port, const std::function<void(const std::string& address)>& opened);

}  // namespace wormdrive
