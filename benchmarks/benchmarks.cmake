# One executable per file of benchmarks/kernels: build/benchmark_<name>.
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/benchmarks/kernels/*.cpp)
foreach(source ${sources})
  get_filename_component(name ${source} NAME_WE)
  add_executable(benchmark_${name} ${source})
  target_link_libraries(benchmark_${name} PRIVATE cnem_app benchmark::benchmark)
  cnem_warnings(benchmark_${name})
endforeach()

# build/growth: cost per node from a thousand nodes to a million.
add_executable(growth ${PROJECT_SOURCE_DIR}/benchmarks/growth/growth.cpp)
target_link_libraries(growth PRIVATE cnem_app CLI11::CLI11)
cnem_warnings(growth)
if(CNEM_TESTS)
  add_test(NAME benchmarks.growth COMMAND growth --to 2000 --output growth_test)
  add_test(NAME benchmarks.peers COMMAND ${PROJECT_SOURCE_DIR}/benchmarks/peers/compare taylor_plane --particles 600
                                         --steps 30 --repeats 2 -- sleep 0.05)
  add_test(NAME benchmarks.peers_failed COMMAND ${PROJECT_SOURCE_DIR}/benchmarks/peers/compare taylor_plane
                                                --particles 600 --steps 30 --repeats 2 -- ls /nowhere)
  set_tests_properties(benchmarks.peers PROPERTIES PASS_REGULAR_EXPRESSION "ratio cnem to peer: [0-9.]+")
  set_tests_properties(benchmarks.peers_failed PROPERTIES PASS_REGULAR_EXPRESSION "the peer failed")
  set_tests_properties(benchmarks.peers benchmarks.peers_failed PROPERTIES ENVIRONMENT "CNEM=$<TARGET_FILE:cnem>")
endif()
