#pragma once
#include <string>
#include <string_view>

namespace wormdrive {

/// What a result may take the place of.
enum class Replace {
  same_kind,  ///< an older result of the same kind; a finished sweep, which may have taken days, only of nothing
  anything,   ///< any plain file: the user forces it
};

/// The file that a path means, at the end of symbolic links; throws OutputFault if they lead in a circle.
std::string followed(const std::string& path);

/// Throws OutputFault, with what is there and what to do, unless an HDF5 result of a kind may be written to a path:
/// what is there, and what another program has left as its part, must be what it may replace.
void reject_replacing(const std::string& path, std::string_view kind, Replace replace);

/// The same of a part alone.
void reject_replacing_part(const std::string& part_path, std::string_view kind, Replace replace);

/// The same of a file of another format, which was written by this program if its first 4096 bytes hold a mark.
void reject_replacing_unmarked(const std::string& path, std::string_view mark, Replace replace);

/// Throws OutputFault for a path that names something else than a plain file or nothing.
void reject_unless_plain_file(const std::string& path);

}  // namespace wormdrive
