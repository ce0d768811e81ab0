# One executable per file of benchmarks/kernels: build/benchmark_<name>.
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/benchmarks/kernels/*.cpp)
foreach(source ${sources})
  get_filename_component(name ${source} NAME_WE)
  add_executable(benchmark_${name} ${source})
  target_link_libraries(benchmark_${name} PRIVATE cnem_app benchmark::benchmark)
  cnem_warnings(benchmark_${name})
endforeach()
