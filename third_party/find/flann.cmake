# By its header and its library: flann.pc would bring HDF5 and MPI, and its CMake package that of the machine that
# builds, where it is built for another one. FLANN's headers call LZ4 themselves.
find_path(FLANN_INCLUDE_DIR flann/flann.hpp)
find_library(FLANN_LIBRARY flann_cpp)
if(FLANN_INCLUDE_DIR AND FLANN_LIBRARY)
  add_library(dep::flann INTERFACE IMPORTED)
  target_include_directories(dep::flann INTERFACE ${FLANN_INCLUDE_DIR})
  target_link_libraries(dep::flann INTERFACE ${FLANN_LIBRARY} dep::lz4)
endif()
