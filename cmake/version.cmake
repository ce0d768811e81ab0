# Writes the version (git describe) into OUTPUT from INPUT; run at every build, touches the file only when it changed.
execute_process(COMMAND git describe --tags --always --dirty
                WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE CNEM_VERSION ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
if(failed OR NOT CNEM_VERSION)
  set(CNEM_VERSION "unknown (not built from a git checkout)")
endif()
configure_file(${INPUT} ${OUTPUT} @ONLY)
