#pragma once
#include <string>
#include <vector>

#include "output/replacing.hpp"

namespace wormdrive {

/// Runs the script that draws; its exit code.
int run_plots(const std::vector<std::string>& arguments);

/// Draws every picture of a diagnosis into a folder, PART.png, some at a time; the exit code of the script.
int draw_all(const std::string& file, const std::string& folder, int at_a_time, Replace replace);

}  // namespace wormdrive
