# Rooms: a library for each, of the files in its folder. A room may use those named, each of which comes before
# it, so that the linker holds the order; tests/includes_test.cmake reads it from the same lines.

# vorpipe_house(prefix library...): for the rooms that follow in the same folder, what the names of their libraries
# begin with, and what all of them are built on.
function(vorpipe_house prefix)
  set(vorpipe_house_prefix ${prefix} PARENT_SCOPE)
  set(vorpipe_house_libraries ${ARGN} PARENT_SCOPE)
endfunction()

function(vorpipe_room room)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "USES;LIBRARIES")
  set(target ${vorpipe_house_prefix}${room})
  file(GLOB sources CONFIGURE_DEPENDS ${room}/*.cpp)
  add_library(${target} STATIC ${sources})
  list(TRANSFORM arg_USES PREPEND ${vorpipe_house_prefix})
  target_link_libraries(
    ${target}
    PUBLIC ${vorpipe_house_libraries} ${arg_USES}
    PRIVATE ${arg_LIBRARIES} dep::fmt)
  vorpipe_precompiled(${target})
  set_property(GLOBAL APPEND PROPERTY vorpipe_rooms ${target})
endfunction()
