# The header alone: view/window/glfw.cpp opens the library when a window is wanted.
find_path(GLFW_INCLUDE_DIR GLFW/glfw3.h)
if(GLFW_INCLUDE_DIR)
  add_library(dep::glfw INTERFACE IMPORTED)
  target_include_directories(dep::glfw INTERFACE ${GLFW_INCLUDE_DIR})
  target_link_libraries(dep::glfw INTERFACE ${CMAKE_DL_LIBS})
endif()
