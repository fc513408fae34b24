#pragma once
#include <string>

namespace wormdrive {

/// Writes a text file as NAME.part first and renames it when it is whole and on disk: the final name never holds a
/// partial file, and a symbolic link stays one. What may be replaced is up to the caller. Throws OutputFault naming the
/// file and the reason.
void write_text_file(const std::string& path, const std::string& text);

/// Makes a folder with its parents, if it is not there. Throws OutputFault.
void make_folder(const std::string& path);

}  // namespace wormdrive
