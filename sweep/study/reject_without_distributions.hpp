#pragma once
#include <string>
#include <string_view>

#include "sweep/study/study.hpp"

namespace wormdrive {

/// Rejects a study whose points are those of a file, in which nothing can be searched that lies between or beyond them.
/// path: the file with the study; remedy: what to do instead. Throws InputFault.
void reject_without_distributions(const Study& study, const std::string& path, std::string_view remedy);

}  // namespace wormdrive
