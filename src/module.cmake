# Modules: a library for each folder of the table in CMakeLists.txt beside this. A module may use those named, each of
# which comes before it: the linker holds that, and tests/includes_test.cmake, which reads the same lines.

# vorpipe_module(folder [USES folder...] [EXCEPT source...] [SHOWS library...] [LIBRARIES library...]): EXCEPT are
# sources that are compiled elsewhere, or not at all; SHOWS are libraries that its headers name as well.
function(vorpipe_module folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "USES;EXCEPT;SHOWS;LIBRARIES")
  vorpipe_target_of(${folder} target)
  set(uses "")
  foreach(used IN LISTS arg_USES)
    vorpipe_target_of(${used} used)
    list(APPEND uses ${used})
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  list(TRANSFORM arg_EXCEPT PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/)
  list(REMOVE_ITEM sources ${arg_EXCEPT})
  add_library(${target} STATIC ${sources})
  target_link_libraries(
    ${target}
    PUBLIC vorpipe_base ${uses} ${arg_SHOWS}
    PRIVATE ${arg_LIBRARIES} dep::fmt)
  vorpipe_precompiled(${target})
  vorpipe_batches(${target} ALONE ${vorpipe_alone})
  set_property(GLOBAL APPEND PROPERTY vorpipe_modules ${target})
endfunction()

# The library of a module: vorpipe_io_sites of io/sites.
function(vorpipe_target_of folder target)
  string(REPLACE "/" "_" name ${folder})
  set(${target} vorpipe_${name} PARENT_SCOPE)
endfunction()
