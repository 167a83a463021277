# Not by its CMake package, which on Debian asks for programs of another package.
find_path(ZIP_INCLUDE_DIR zip.h)
find_library(ZIP_LIBRARY zip)
if(ZIP_INCLUDE_DIR AND ZIP_LIBRARY)
  add_library(dep::zip INTERFACE IMPORTED)
  target_include_directories(dep::zip INTERFACE ${ZIP_INCLUDE_DIR})
  target_link_libraries(dep::zip INTERFACE ${ZIP_LIBRARY})
endif()
