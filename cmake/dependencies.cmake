# Libraries that the core is compiled against are header-only, so that the browser build can use
# the same ones. em++ does not look into /usr/include: it gets a folder of links to just these.
add_library(kinefile_headers INTERFACE)
if(EMSCRIPTEN)
  set(staged "${CMAKE_BINARY_DIR}/headers")
  file(MAKE_DIRECTORY "${staged}")
  foreach(link "eigen3/Eigen;Eigen" "fmt;fmt" "fast_float;fast_float" "tl;tl"
               "nlohmann;nlohmann" "hwy;hwy")
    list(GET link 0 from)
    list(GET link 1 to)
    file(CREATE_LINK "/usr/include/${from}" "${staged}/${to}" SYMBOLIC)
  endforeach()
  target_include_directories(kinefile_headers SYSTEM INTERFACE "${staged}")
  # Without it fmt brings the standard library's locales along, 60 kB that nothing uses.
  target_compile_definitions(kinefile_headers INTERFACE FMT_STATIC_THOUSANDS_SEPARATOR=',')
else()
  find_package(Eigen3 REQUIRED NO_MODULE)
  find_package(fmt REQUIRED)
  find_path(fast_float_folder fast_float/fast_float.h REQUIRED)  # headers alone, without a package
  find_package(tl-expected REQUIRED)
  find_package(hwy REQUIRED)
  target_link_libraries(kinefile_headers INTERFACE Eigen3::Eigen tl::expected)
endif()
target_compile_definitions(kinefile_headers INTERFACE FMT_HEADER_ONLY EIGEN_MPL2_ONLY)
