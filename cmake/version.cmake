# Writes the version into OUTPUT from INPUT: VERSION, and the commit where SOURCE is a git checkout (of its own: sources
# unpacked within another one are none of its). Run at every build, touches the file only when it changed.
set(CNEM_VERSION ${VERSION})
execute_process(COMMAND git rev-parse --show-cdup WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE above ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE outside)
if(NOT outside AND above STREQUAL "")
  execute_process(COMMAND git describe --always --dirty --exclude "*" WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit
                  ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
  if(NOT failed AND commit)
    set(CNEM_VERSION "${VERSION} (${commit})")
  endif()
endif()
configure_file(${INPUT} ${OUTPUT} @ONLY)
