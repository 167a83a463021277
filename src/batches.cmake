# VORPIPE_BATCHES: sources that lie together are compiled as one, because most of what each takes is headers and
# templates that all of them have: a build from nothing takes less than half. Who edits one source again and again says
# -D VORPIPE_BATCHES=OFF. In the preset asan each source stands alone, and must name all that it uses, which the test
# named_headers holds it to.
option(VORPIPE_BATCHES "Compile sources that lie together as one" ON)
if(VORPIPE_BATCHES)
  # GCC collects its garbage at each doubling of 128 MB. A batch needs 1.2 GB without that, 1 GB with it, and a tenth
  # more time.
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=2097152>)
  # No more at once than the machine has memory for.
  cmake_host_system_information(RESULT megabytes QUERY TOTAL_PHYSICAL_MEMORY)
  math(EXPR at_once "${megabytes} / 1300 + 1")
  set_property(GLOBAL APPEND PROPERTY JOB_POOLS batches=${at_once})
  set(CMAKE_JOB_POOL_COMPILE batches)
endif()

# vorpipe_batches(target [LEAST count] [ALONE name...]): its sources in batches of whole folders, as many as it takes to
# have `count` sources, or a dozen; a folder of more than 45 is several batches. ALONE are files with private names that others of the batch have as well, of which
# the compiler says "redefinition" or "shadows"; before a name that files of other folders have too stands its folder,
# as in sites/weights.cpp.
function(vorpipe_batches target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "LEAST" "ALONE")
  if(NOT DEFINED arg_LEAST)
    set(arg_LEAST 12)
  endif()
  if(NOT VORPIPE_BATCHES)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  set(count 0)
  foreach(source IN LISTS sources)
    cmake_path(GET source FILENAME name)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME last)
    if(name IN_LIST arg_ALONE OR "${last}/${name}" IN_LIST arg_ALONE)
      continue()
    endif()
    string(REPLACE "${CMAKE_CURRENT_SOURCE_DIR}/" "" folder "${folder}")
    if(count EQUAL 0 OR count GREATER_EQUAL 45 OR (count GREATER_EQUAL ${arg_LEAST} AND NOT folder STREQUAL folder_before))
      string(MAKE_C_IDENTIFIER "batch_${folder}_${name}" group)
      set(count 0)
    endif()
    set(folder_before "${folder}")
    math(EXPR count "${count} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# Sources that are compiled each alone.
set(vorpipe_alone
    check/nearest_site.cpp
    cpu/nearest_site.cpp
    cells/site_mesh.cpp
    geometry/triangulation.cpp
    globe_places.cpp
    legend.cpp
    session/locator.cpp
    bench/plot.cpp
    domain/clip_cell.cpp
    view/panel.cpp
    picture_files.cpp
    opengl/cells.cpp
    opengl/geometry.cpp
    png_file.cpp
    polygon_drawing.cpp
    cells/bisectors.cpp
    sites/site_set.cpp
    sites/weights.cpp
    stages.cpp
    svg_picture.cpp
    thesis.cpp
    cells/tied_vertices.cpp
    vulkan/compute_cells.cpp
    vulkan/compute_draw.cpp
    vulkan/draw.cpp
    vulkan/geometry.cpp
    vulkan/sorted_sites.cpp
    vulkan/triangle_list.cpp)
