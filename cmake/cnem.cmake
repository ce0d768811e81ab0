# Helpers shared by the library, test and benchmark targets.

if(CNEM_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Units of a folder's files fill more memory than GCC thinks of when it begins to collect what it no longer needs: up to a
  # fifth of the time to compile goes into that for little.
  add_compile_options(--param=ggc-min-heapsize=800000) # kB
endif()

function(cnem_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict) # takes the assignment of a literal to a std::string for an overlap (GCC 105651)
  endif()
  if(CNEM_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${CNEM_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${CNEM_SANITIZE})
  endif()
endfunction()

# Compiles the files of a library together, so that what they instantiate of other libraries (Eigen, fmt) is made once: one unit of
# all of input/ takes a third of what seven did. What stands in a folder `plane` or `space`, whose names are often the same,
# makes units of its own; so does what shares a UNITY_GROUP.
function(cnem_unity target)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_source_file_property(group ${source} UNITY_GROUP)
    get_source_file_property(alone ${source} SKIP_UNITY_BUILD_INCLUSION)
    if(group OR alone OR NOT source MATCHES "\\.cpp$")
      continue()
    endif()
    file(RELATIVE_PATH inside ${PROJECT_SOURCE_DIR} ${source})
    string(REGEX MATCH "/(plane|space)/" group ${inside})
    string(REPLACE "/" "" group "${group}")
    if(NOT group)
      set(group all)
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# One static library per folder of the method, with the folders inside it. Files named *_kernel.cpp are compiled once per instruction set
# (see cnem_kernel); app/main.cpp belongs to the executable.
function(cnem_library folder)
  set_property(GLOBAL APPEND PROPERTY CNEM_FOLDERS ${folder})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  file(GLOB_RECURSE kernels CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*_kernel.cpp)
  list(FILTER sources EXCLUDE REGEX "(_kernel|/app/main)\\.cpp$")
  if(NOT sources AND NOT kernels)
    add_library(cnem_${folder} INTERFACE)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PUBLIC;PRIVATE")
    target_link_libraries(cnem_${folder} INTERFACE ${arg_PUBLIC})
    target_include_directories(cnem_${folder} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                               $<INSTALL_INTERFACE:include/cnem>)
    return()
  endif()
  add_library(cnem_${folder} STATIC ${sources})
  target_compile_features(cnem_${folder} PUBLIC cxx_std_20)
  target_include_directories(cnem_${folder} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                             $<INSTALL_INTERFACE:include/cnem>)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PUBLIC;PRIVATE")
  # Nobody who links an installed library needs the headers that it was compiled with.
  list(TRANSFORM arg_PRIVATE REPLACE "^(nlohmann_json::.*|CLI11::.*)$" "$<BUILD_INTERFACE:\\1>")
  target_link_libraries(cnem_${folder} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  cnem_warnings(cnem_${folder})
  if(CNEM_UNITY)
    cnem_unity(cnem_${folder})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU") # takes each file for a header there, whose types others might see too
      target_compile_options(cnem_${folder} PRIVATE -Wno-subobject-linkage)
    endif()
  endif()
  foreach(kernel ${kernels})
    cnem_kernel(cnem_${folder} ${kernel})
  endforeach()
endfunction()

# Compiles one kernel file for the baseline, AVX2 and AVX-512, each in its own namespace CNEM_ISA;
# core/machine/isa.hpp chooses at run time, so that the binary runs on any x86-64. Kernel files include only headers whose
# every function lives in namespace CNEM_ISA: an inline function of a common header, compiled here with AVX,
# could be the copy the linker keeps for everyone. Hence no Eigen, no fmt and no std containers in them. Vectors are
# passed to inlined functions alone, so that how an ABI passes them does not matter (-Wno-psabi).
function(cnem_kernel target file)
  get_filename_component(name ${file} NAME_WE)
  set(flags_baseline "")
  set(flags_avx2 -mavx2 -mfma)
  set(flags_avx512 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mfma -mprefer-vector-width=512)
  foreach(isa baseline avx2 avx512)
    set(object ${target}_${name}_${isa})
    add_library(${object} OBJECT ${file})
    target_include_directories(${object} PRIVATE ${PROJECT_SOURCE_DIR})
    target_compile_definitions(${object} PRIVATE CNEM_ISA=${isa} CNEM_ISA_${isa}=1)
    if(CNEM_SANITIZE) # a list with commas, which generator expressions do not take
      set(optimised -O1)
    else()
      set(optimised -O3)
    endif()
    target_compile_options(${object} PRIVATE ${optimised} -fno-math-errno -fno-trapping-math
                           -Wno-psabi ${flags_${isa}})
    cnem_warnings(${object})
    if(CNEM_SANITIZE MATCHES address AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # A kernel is one function with thousands of temporaries: guarding each on the stack, and each access in
      # line, makes compiling it several times slower. Accesses to the arrays it is given stay checked, by calls.
      target_compile_options(${object} PRIVATE --param=asan-stack=0 --param=asan-instrumentation-with-call-threshold=0)
    endif()
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${object}>)
  endforeach()
endfunction()
