# What every target of ours is compiled with; headers of others are system headers.
add_library(kinefile_compile_options INTERFACE)
target_compile_options(kinefile_compile_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
# A product and a sum are two roundings on every machine, whether it could fuse them or not: the same
# file gives the same bits everywhere.
target_compile_options(kinefile_compile_options INTERFACE -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 sees faults in Eigen's and the standard library's inlined code that are not there.
  target_compile_options(kinefile_compile_options INTERFACE
    -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

# Reading these headers is half of the time that most of our files take to compile. One target reads
# them, all others with the same options reuse that. The browser build goes without, so that a file
# which forgets an include does not compile there.
function(kinefile_precompile target first)
  if(EMSCRIPTEN)
    return()
  endif()
  if("${target}" STREQUAL "${first}")
    target_precompile_headers(${target} PRIVATE <Eigen/Core> <Eigen/Geometry> <fmt/format.h>
      <tl/expected.hpp> <algorithm> <array> <functional> <map> <memory> <string> <vector>)
  else()
    target_precompile_headers(${target} REUSE_FROM ${first})
  endif()
endfunction()

# What is not the library need not be fast, but quickly compiled.
function(kinefile_compile_quickly target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()
