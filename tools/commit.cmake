# Writes OUTPUT, a header with version, commit and a digest of the sources that decide results; only when it changes, so
# that nothing is rebuilt for nothing. The digest needs no git, and tells two changed trees of one commit apart.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()

set(patterns)
foreach(folder core events statistics control description output simulation sweep diagnosis)
  list(APPEND patterns ${SOURCE}/${folder}/*.hpp ${SOURCE}/${folder}/*.cpp)
endforeach()
file(GLOB_RECURSE files RELATIVE ${SOURCE} ${patterns})
list(APPEND files CMakeLists.txt)  # the flags in it make the same bits on every machine
list(SORT files)
set(digests "")
foreach(file ${files})
  file(SHA256 ${SOURCE}/${file} digest)
  string(APPEND digests "${file} ${digest}\n")
endforeach()
string(SHA256 sources "${digests}")
string(SUBSTRING ${sources} 0 12 sources)

file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[#pragma once

namespace wormdrive {
inline constexpr const char* version = "@VERSION@";
inline constexpr const char* commit = "@commit@";
inline constexpr const char* sources = "@sources@";
}  // namespace wormdrive
]] @ONLY)
