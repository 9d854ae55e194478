# `make install`: the library, its headers, CMake and pkg-config files, the command, its man page
# and its completions, which the command writes itself.
include(CMakePackageConfigHelpers)

install(TARGETS kinefile EXPORT kinefile_targets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/kinefile"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
# Who links the static library links what it uses, too.
set(kinefile_static_libraries "-lhwy")
set(kinefile_static_packages "find_dependency(hwy)\n")
if(BUILD_SHARED_LIBS)
  set(kinefile_private_libraries "${kinefile_static_libraries}")
  set(kinefile_static_libraries "")
  set(kinefile_static_packages "")
endif()
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/kinefile")
install(EXPORT kinefile_targets NAMESPACE kinefile:: FILE kinefileTargets.cmake
  DESTINATION "${package_folder}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/kinefileConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/kinefileConfig.cmake" INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/kinefileConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/kinefileConfig.cmake"
  "${PROJECT_BINARY_DIR}/kinefileConfigVersion.cmake" DESTINATION "${package_folder}")
# Relative, since `cmake --install --prefix` may put the files anywhere.
file(RELATIVE_PATH kinefile_prefix_from_pc "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file("${PROJECT_SOURCE_DIR}/cmake/kinefile.pc.in" "${PROJECT_BINARY_DIR}/kinefile.pc"
  @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/kinefile.pc"
  DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs/" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

if(KINEFILE_CLI)
  if(BUILD_SHARED_LIBS)
    file(RELATIVE_PATH lib_from_bin "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
    set_target_properties(kinefile_command PROPERTIES INSTALL_RPATH "$ORIGIN/${lib_from_bin}")
  endif()
  install(TARGETS kinefile_command RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  set(generated "")
  foreach(kind IN ITEMS man bash zsh fish)
    set(file "${PROJECT_BINARY_DIR}/kinefile.${kind}")
    add_custom_command(OUTPUT "${file}"
      COMMAND kinefile_command --generate ${kind} > "${file}"
      DEPENDS kinefile_command VERBATIM)
    list(APPEND generated "${file}")
  endforeach()
  add_custom_target(kinefile_manual ALL DEPENDS ${generated})
  install(FILES "${PROJECT_BINARY_DIR}/kinefile.man" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1"
    RENAME kinefile.1)
  install(FILES "${PROJECT_BINARY_DIR}/kinefile.bash"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME kinefile)
  install(FILES "${PROJECT_BINARY_DIR}/kinefile.zsh"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions" RENAME _kinefile)
  install(FILES "${PROJECT_BINARY_DIR}/kinefile.fish"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d" RENAME kinefile.fish)
endif()
