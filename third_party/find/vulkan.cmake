# Headers only: volk opens the loader at run time.
find_package(Vulkan QUIET)
if(TARGET Vulkan::Headers)
  add_library(dep::vulkan INTERFACE IMPORTED)
  target_link_libraries(dep::vulkan INTERFACE Vulkan::Headers)
  target_compile_definitions(dep::vulkan INTERFACE VK_NO_PROTOTYPES)
endif()
