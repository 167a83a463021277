# What `cmake --install` puts where, by component: program, library, development. For programs that find the library
# by CMake, by pkg-config or by hand.
include(CMakePackageConfigHelpers)

install(TARGETS vorpipe RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(
  TARGETS vorpipe_c
  EXPORT vorpipe
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
          COMPONENT library
          NAMELINK_COMPONENT development)
install(FILES src/c/vorpipe_c.h src/c/vorpipe.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)

set(vorpipe_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/vorpipe)
install(EXPORT vorpipe NAMESPACE vorpipe:: FILE vorpipe-targets.cmake DESTINATION ${vorpipe_cmake_dir} COMPONENT development)
configure_package_config_file(src/package/vorpipe-config.cmake.in package/vorpipe-config.cmake
                              INSTALL_DESTINATION ${vorpipe_cmake_dir})
# Versions with the same SONAME.
write_basic_package_version_file(package/vorpipe-config-version.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/package/vorpipe-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/package/vorpipe-config-version.cmake
        DESTINATION ${vorpipe_cmake_dir} COMPONENT development)

# From the folder of vorpipe.pc to the prefix, so that the tree can be moved.
file(RELATIVE_PATH vorpipe_pc_to_prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(src/package/vorpipe.pc.in package/vorpipe.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/package/vorpipe.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
