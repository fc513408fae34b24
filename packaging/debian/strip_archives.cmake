# CPack strips programs; archives keep what the linker needs.
file(GLOB_RECURSE archives ${CPACK_TEMPORARY_DIRECTORY}/*.a)
if(archives)
  execute_process(COMMAND strip --strip-debug --remove-section=.comment --remove-section=.note
                          --enable-deterministic-archives ${archives} COMMAND_ERROR_IS_FATAL ANY)
endif()
