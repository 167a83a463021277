# By its CMake package; flann.pc would bring HDF5 and MPI. FLANN's headers call LZ4 themselves.
find_package(flann CONFIG QUIET)
if(TARGET flann::flann_cpp)
  add_library(dep::flann INTERFACE IMPORTED)
  target_link_libraries(dep::flann INTERFACE flann::flann_cpp dep::lz4)
endif()
