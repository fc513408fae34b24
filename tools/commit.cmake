# Writes OUTPUT, a header with version and commit; only when it changes, so that nothing is rebuilt for nothing.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[#pragma once

namespace wormdrive {
inline constexpr const char* version = "@VERSION@";
inline constexpr const char* commit = "@commit@";
}  // namespace wormdrive
]] @ONLY)
