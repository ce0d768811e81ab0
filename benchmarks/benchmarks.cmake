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
endif()
