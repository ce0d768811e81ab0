add_custom_target(unit_tests)

# Tests are programs: compiled as position-independent code or not, they and the headers they share have to be it alike.
set(CMAKE_POSITION_INDEPENDENT_CODE OFF)

# What is tested is the library: tests themselves are not worth optimising, and compile in a fifth less time.
set(test_options $<$<AND:$<BOOL:${CNEM_UNITY}>,$<CONFIG:Release>>:-O1>)

# One executable per folder of tests; CTest names are <folder path>.<suite>.<test>, so that
# `ctest -R contract` or `ctest -R unit.voronoi` select them.
function(cnem_tests folder)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${folder}/*.cpp)
  if(NOT sources)
    return()
  endif()
  string(REPLACE "/" "_" target test_${folder})
  string(REPLACE "/" "." prefix ${folder}.)
  add_executable(${target} ${sources})
  target_link_libraries(${target} PRIVATE ${ARGN} GTest::gtest_main)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${target} PRIVATE CNEM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  cnem_warnings(${target})
  target_compile_options(${target} PRIVATE ${test_options})
  if(CNEM_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
    target_compile_options(${target} PRIVATE -Wno-shadow) # a name of another test file may be used for a local
    if(folder STREQUAL "unit/core") # the first; what most tests read
      target_precompile_headers(${target} PRIVATE <Eigen/Dense> <Eigen/Sparse> <fmt/format.h> <gtest/gtest.h>
                                <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <map> <memory> <numbers>
                                <optional> <random> <span> <string> <vector>)
    else()
      target_precompile_headers(${target} REUSE_FROM test_unit_core)
    endif()
  endif()
  if(folder MATCHES "^unit/")
    add_dependencies(unit_tests ${target})
  endif()
  gtest_discover_tests(${target} TEST_PREFIX ${prefix} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600 ENVIRONMENT "GOMP_SPINCOUNT=1000")
endfunction()

cnem_tests(unit/core cnem_core)
cnem_tests(unit/voronoi cnem_voronoi)
cnem_tests(unit/clouds cnem_clouds)
cnem_tests(unit/plasticity cnem_plasticity)
cnem_tests(unit/thermal cnem_thermal cnem_cnem cnem_methods)
cnem_tests(unit/contact cnem_contact)
cnem_tests(unit/machining cnem_machining)
cnem_tests(unit/structure cnem_machining)
cnem_tests(unit/input cnem_input)
cnem_tests(unit/results cnem_results)
cnem_tests(unit/report cnem_report VTK::CommonCore VTK::CommonDataModel VTK::IOXML PNG::PNG GIF::GIF PkgConfig::WEBP_READER)
cnem_tests(unit/cnem cnem_clouds cnem_cnem)
cnem_tests(unit/adapt cnem_adapt cnem_clouds)
cnem_tests(unit/fracture cnem_clouds cnem_fracture cnem_mechanics)
cnem_tests(unit/methods cnem_mechanics cnem_cnem cnem_methods cnem_clouds)
cnem_tests(unit/mechanics cnem_clouds cnem_mechanics cnem_cnem cnem_methods)
cnem_tests(unit/evaluate cnem_report cnem_clouds cnem_cnem cnem_methods)
cnem_tests(unit/app cnem_app)
cnem_tests(unit/study cnem_app PNG::PNG)
target_compile_definitions(test_unit_study PRIVATE CNEM_PROGRAM="$<TARGET_FILE:cnem>") # a sweep runs the program
add_dependencies(test_unit_study cnem)
cnem_tests(restart cnem_results) # runs the program as a process
target_compile_definitions(test_restart PRIVATE CNEM_PROGRAM="$<TARGET_FILE:cnem>")
add_dependencies(test_restart cnem)
cnem_tests(conservation cnem_clouds cnem_adapt cnem_mechanics cnem_methods)
cnem_tests(degenerate cnem_clouds cnem_cnem cnem_methods)
cnem_tests(contract cnem_clouds cnem_cnem cnem_methods)
cnem_tests(convergence cnem_app)
cnem_tests(verification cnem_app VTK::CommonCore VTK::CommonDataModel VTK::IOXML)
cnem_tests(bad_input cnem_app)
if(CNEM_LONG_TESTS)
  cnem_tests(long cnem_app VTK::CommonCore VTK::CommonDataModel VTK::IOXML)
endif()
if(CNEM_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # With sanitizers GCC takes members of std::regex for uninitialised, as its manual warns.
  target_compile_options(test_bad_input PRIVATE -Wno-maybe-uninitialized)
endif()

if(CNEM_PYTHON)
  foreach(part case run arrays notebook documents)
    add_test(NAME python.${part} COMMAND ${Python3_EXECUTABLE} -m unittest test_${part}
             WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/tests/python)
    set_tests_properties(python.${part} PROPERTIES TIMEOUT 600 ENVIRONMENT
      "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;MPLBACKEND=Agg;CNEM_PROGRAM=$<TARGET_FILE:cnem>")
  endforeach()
endif()

add_test(NAME include_rule COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR}
                                   -P ${PROJECT_SOURCE_DIR}/tests/include_rule.cmake)
add_test(NAME silence_rule COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR}
                                   -P ${PROJECT_SOURCE_DIR}/tests/silence_rule.cmake)
add_test(NAME packaging COMMAND bash ${PROJECT_SOURCE_DIR}/tests/packaging.sh $<TARGET_FILE:cnem> ${PROJECT_SOURCE_DIR}
                                ${PROJECT_BINARY_DIR} ${PROJECT_VERSION})
add_test(NAME clusters COMMAND ${PROJECT_SOURCE_DIR}/.ci/clusters $<TARGET_FILE:cnem>)
