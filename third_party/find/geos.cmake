# The C interface alone; the C++ one changes with every version.
find_package(GEOS CONFIG QUIET)
if(TARGET GEOS::geos_c)
  add_library(dep::geos INTERFACE IMPORTED)
  target_link_libraries(dep::geos INTERFACE GEOS::geos_c)
endif()
