# What every target of ours is compiled with; headers of others are system headers.
add_library(kinefile_compile_options INTERFACE)
target_compile_options(kinefile_compile_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(KINEFILE_WERROR)
  target_compile_options(kinefile_compile_options INTERFACE -Werror)
endif()
# A product and a sum are two roundings on every machine, whether it could fuse them or not: the same
# file gives the same bits everywhere.
target_compile_options(kinefile_compile_options INTERFACE -ffp-contract=off)
# What an attacker's file could make of a fault of ours is an abort (SECURITY.md). It costs
# a program that links the library nothing: these are flags of our own files.
option(KINEFILE_HARDEN "Checks of bounds and of the stack, read-only relocations" OFF)
if(KINEFILE_HARDEN)
  target_compile_definitions(kinefile_compile_options INTERFACE _GLIBCXX_ASSERTIONS)
  target_compile_options(kinefile_compile_options INTERFACE -fstack-protector-strong
    -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
  target_link_options(kinefile_compile_options INTERFACE LINKER:-z,relro,-z,now)
  include(CheckCXXCompilerFlag)
  check_cxx_compiler_flag(-fcf-protection KINEFILE_HAS_CET)
  if(KINEFILE_HAS_CET)
    target_compile_options(kinefile_compile_options INTERFACE -fcf-protection)
  endif()
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 sees faults in Eigen's and the standard library's inlined code that are not there.
  target_compile_options(kinefile_compile_options INTERFACE
    -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict)
endif()

# What is not the library need not be fast, but quickly compiled. After the user's own flags, so it
# is for our presets only.
option(KINEFILE_QUICK_COMPILE "Compile all but the library with -O1" OFF)
function(kinefile_compile_quickly target)
  if(KINEFILE_QUICK_COMPILE)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()
