# Debian's volk has neither a library nor a CMake package: backend/vulkan/volk.cpp compiles it.
find_path(VOLK_INCLUDE_DIR volk.h PATH_SUFFIXES volk)
if(VOLK_INCLUDE_DIR)
  add_library(dep::volk INTERFACE IMPORTED)
  target_include_directories(dep::volk INTERFACE ${VOLK_INCLUDE_DIR})
  target_link_libraries(dep::volk INTERFACE dep::vulkan ${CMAKE_DL_LIBS})
endif()
