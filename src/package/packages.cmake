# Packages, made by src/package/make: three of Debian, and an archive with every library but those of the compiler,
# the system and drivers.
set(CPACK_PACKAGE_NAME vorpipe)
set(CPACK_PACKAGE_VENDOR "The vorpipe authors")
set(CPACK_PACKAGE_CONTACT "The vorpipe authors <vorpipe@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program library development)
set(CPACK_VERBATIM_VARIABLES ON)

# Debian: Depends comes from what is linked; the shared library's own users need at least this version.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/src/package/compress.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(vorpipe_about
    "Computes Voronoi diagrams (Thiessen polygons, Dirichlet cells) and power
diagrams (Laguerre or radical tessellations) of sites in the plane by Vulkan,
by OpenGL or on the CPU: cells, areas, neighbors, pictures; each cell
certified, periodic domains and outlines with holes included.")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME vorpipe)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION math)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${vorpipe_about}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libvulkan1, mesa-vulkan-drivers")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libegl1, libopengl0, libgl1-mesa-dri")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libvorpipe0)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "${vorpipe_about}\n.\nThe shared library.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "libvulkan1, mesa-vulkan-drivers")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/src/package/debian/triggers)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libvorpipe-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${vorpipe_about}\n.\nHeaders for C and C++, and files for CMake and pkg-config.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libvorpipe0 (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)

# What Debian wants beside the files: the license, and what changed.
file(READ LICENSE license)
string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
string(REGEX REPLACE "\n([^\n])" "\n \\1" license "${license}")
configure_file(src/package/debian/copyright.in package/copyright @ONLY)
configure_file(src/package/debian/changelog.in package/changelog @ONLY)
find_program(GZIP gzip)
if(GZIP)
  execute_process(COMMAND ${GZIP} -9nfk ${CMAKE_CURRENT_BINARY_DIR}/package/changelog COMMAND_ERROR_IS_FATAL ANY)
  foreach(pair program=vorpipe library=libvorpipe0 development=libvorpipe-dev)
    string(REPLACE "=" ";" pair ${pair})
    list(GET pair 0 component)
    list(GET pair 1 name)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/package/copyright ${CMAKE_CURRENT_BINARY_DIR}/package/changelog.gz
            DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name} COMPONENT ${component})
  endforeach()
endif()

# The archive: libraries beside ours, and a search path that they inherit.
install(CODE "
    file(GET_RUNTIME_DEPENDENCIES
      EXECUTABLES \"$<TARGET_FILE:vorpipe>\" LIBRARIES \"$<TARGET_FILE:vorpipe_c>\"
      PRE_EXCLUDE_REGEXES \"^ld-linux\" \"^lib(c|m|dl|rt|pthread|stdc\\\\+\\\\+|gcc_s)\\\\.so\" \"^lib(vulkan|GL|EGL|GLX|OpenGL|GLdispatch)\"
      POST_EXCLUDE_REGEXES \"libvorpipe\\\\.so\"
      RESOLVED_DEPENDENCIES_VAR libraries UNRESOLVED_DEPENDENCIES_VAR lost)
    if(lost)
      message(FATAL_ERROR \"not found: \${lost}\")
    endif()
    set(prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
    foreach(library IN LISTS libraries)
      file(INSTALL \"\${library}\" DESTINATION \"\${prefix}/${CMAKE_INSTALL_LIBDIR}/vorpipe\" FOLLOW_SYMLINK_CHAIN)
    endforeach()"
  COMPONENT bundle EXCLUDE_FROM_ALL)
include(CPack)
