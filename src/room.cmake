# Rooms: a library for each, of the files in its folder. A room may use those named, each of which comes before
# it, so that the linker holds the order; tests/includes_test.cmake reads it from the same lines.

# vorpipe_house(prefix library...): for the rooms that follow in the same folder, what the names of their libraries
# begin with, and what all of them are built on. A house that is compiled in batches of several rooms is one library,
# which the rooms' names then stand for.
function(vorpipe_house prefix)
  set(vorpipe_house_prefix ${prefix} PARENT_SCOPE)
  set(vorpipe_house_libraries ${ARGN} PARENT_SCOPE)
  if(VORPIPE_BATCHES AND prefix IN_LIST vorpipe_batched_houses)
    add_library(${prefix}house STATIC)
    target_link_libraries(
      ${prefix}house
      PUBLIC ${ARGN}
      PRIVATE dep::fmt)
    # Once its rooms have given it their sources, when the arguments are read, too.
    cmake_language(DEFER CALL vorpipe_precompiled ${vorpipe_house_prefix}house)
    cmake_language(DEFER CALL vorpipe_batches ${vorpipe_house_prefix}house LEAST 35 ALONE ${vorpipe_alone})
    set_property(GLOBAL APPEND PROPERTY vorpipe_rooms ${prefix}house)
  endif()
endfunction()

# vorpipe_room(room [USES room...] [EXCEPT source...] [LIBRARIES library...]): EXCEPT are sources that are compiled
# elsewhere, or not at all.
function(vorpipe_room room)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "USES;EXCEPT;LIBRARIES")
  set(target ${vorpipe_house_prefix}${room})
  file(GLOB sources CONFIGURE_DEPENDS ${room}/*.cpp)
  list(TRANSFORM arg_EXCEPT PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/${room}/)
  list(REMOVE_ITEM sources ${arg_EXCEPT})
  set(house ${vorpipe_house_prefix}house)
  if(TARGET ${house} AND NOT ${target} IN_LIST vorpipe_lone_rooms)
    target_sources(${house} PRIVATE ${sources})
    target_link_libraries(${house} PRIVATE ${arg_LIBRARIES})
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE ${house})
    return()
  endif()
  add_library(${target} STATIC ${sources})
  list(TRANSFORM arg_USES PREPEND ${vorpipe_house_prefix})
  target_link_libraries(
    ${target}
    PUBLIC ${vorpipe_house_libraries} ${arg_USES}
    PRIVATE ${arg_LIBRARIES} dep::fmt)
  vorpipe_precompiled(${target})
  set_property(GLOBAL APPEND PROPERTY vorpipe_rooms ${target})
endfunction()
