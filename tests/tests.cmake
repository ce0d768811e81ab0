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
  gtest_discover_tests(${target} TEST_PREFIX ${prefix} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600 ENVIRONMENT "GOMP_SPINCOUNT=1000")
endfunction()

cnem_tests(unit/core cnem_core)
cnem_tests(unit/voronoi cnem_voronoi)
cnem_tests(unit/plasticity cnem_plasticity)
cnem_tests(unit/thermal cnem_thermal cnem_cnem cnem_alternatives)
cnem_tests(unit/contact cnem_contact)
cnem_tests(unit/io cnem_io)
cnem_tests(unit/cnem cnem_cnem)
cnem_tests(unit/fracture cnem_fracture cnem_mechanics)
cnem_tests(unit/mechanics cnem_mechanics cnem_cnem cnem_alternatives)
cnem_tests(unit/app cnem_app)
target_compile_definitions(test_unit_app PRIVATE CNEM_PROGRAM="$<TARGET_FILE:cnem>") # a sweep runs the program
add_dependencies(test_unit_app cnem)
cnem_tests(restart cnem_io) # runs the program as a process
target_compile_definitions(test_restart PRIVATE CNEM_PROGRAM="$<TARGET_FILE:cnem>")
add_dependencies(test_restart cnem)
cnem_tests(degenerate cnem_voronoi cnem_cnem cnem_alternatives)
cnem_tests(contract cnem_cnem cnem_alternatives)
cnem_tests(convergence cnem_app)
cnem_tests(verification cnem_app)

add_test(NAME include_rule COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR}
                                   -P ${PROJECT_SOURCE_DIR}/tests/include_rule.cmake)
