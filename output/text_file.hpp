#pragma once
#include <functional>
#include <string>
#include <string_view>

namespace wormdrive {

/// Writes a text file as NAME.part first and renames it when it is whole and on disk: the final name never holds a
/// partial file, and a symbolic link stays one. What may be replaced is up to the caller. Throws OutputFault naming the
/// file and the reason.
void write_text_file(const std::string& path, const std::string& text);
/// The same of a text that is too long to be held: write() hands its parts to what it is given, one after the other.
void write_text_file(const std::string& path,
                     const std::function<void(const std::function<void(std::string_view)>&)>& write);

/// Makes a folder with its parents, if it is not there. Throws OutputFault.
void make_folder(const std::string& path);

}  // namespace wormdrive
