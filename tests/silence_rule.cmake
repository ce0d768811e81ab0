# Fails when the program prints, handles signals or ends the process elsewhere than at its top: runs are parts of other programs
# too (python/). Run as  cmake -DROOT=<source folder> -P tests/silence_rule.cmake
cmake_policy(VERSION 3.25)

# What the command line is made of, and studies, which are run from there alone.
set(top "^(app/(command_line|main)\\.cpp|app/process/.*|results/progress\\.cpp|study/.*)$")
set(loud "fmt::print|std::cout|std::cerr|std::clog|[^a-z_]f?printf *\\(|fputs|std::puts|sigaction|std::signal|std::atexit|std::exit|[^a-z_]_exit|set_terminate|set_new_handler|setenv|putenv")

set(violations "")
file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/*/*.hpp ${ROOT}/*/*.cpp)
list(FILTER sources EXCLUDE REGEX "^(tests|benchmarks|build[^/]*)/")
foreach(source ${sources})
  if(source MATCHES "${top}")
    continue()
  endif()
  file(STRINGS ${ROOT}/${source} lines REGEX "${loud}")
  foreach(line ${lines})
    if(NOT line MATCHES "^ *//")
      string(APPEND violations "  ${source}: ${line}\n")
    endif()
  endforeach()
endforeach()
if(violations)
  message(FATAL_ERROR "only the top of the program prints and owns the process (docs/architecture.md):\n${violations}")
endif()
