# Who may include what: cli -> io -> vorpipe.h <- core -> backend/backend.h <- backend/*; a room those that the
# CMakeLists.txt beside it says it uses; and which folder alone knows a library.
# cmake -D root=DIR -P includes_test.cmake
cmake_minimum_required(VERSION 3.25)

# Regular expressions of the own headers that each kind of file may include; the first that matches
# a file's path holds for it.
set(kinds
    "^vorpipe(\\.h$|/)"
    "^base/"
    "^geos\\.h$"
    "^backend/registry/"
    "^backend/cpu/[^/]*$"
    "^backend/vulkan/[^/]*$"
    "^backend/opengl/[^/]*$"
    "^backend/[^/]*$"
    "^selftest/"
    "^c/moving/"
    "^c/"
    "^cli/[^/]*$")
set(may_include
    "^vorpipe/"
    "^(vorpipe\\.h|base/.*)$"
    "^vorpipe\\.h$"
    "^(vorpipe\\.h|backend/[^/]*\\.h|backend/registry/.*|backend/cpu/(cpu|exact_tier)\\.h|backend/vulkan/vulkan_backend\\.h|backend/opengl/opengl_backend\\.h)$"
    "^(vorpipe\\.h|base/.*|backend/[^/]*\\.h|backend/cpu/.*|layout\\.glsl)$"
    "^(vorpipe\\.h|base/.*|backend/[^/]*\\.h|backend/vulkan/.*|layout\\.glsl|shaders\\.h)$"
    "^(vorpipe\\.h|base/.*|backend/[^/]*\\.h|backend/opengl/.*|layout\\.glsl|shaders\\.h)$"
    "^(vorpipe\\.h|base/.*|backend/[^/]*\\.h|layout\\.glsl)$"
    "^(vorpipe\\.h|vorpipe/selftest\\.h|selftest/.*)$"
    "^(vorpipe\\.h|vorpipe/(fluid|masses)\\.h|c/.*|io/.*)$"
    "^(vorpipe\\.h|vorpipe/(fluid|free_surface|selftest|shapes)\\.h|vorpipe_c\\.h|c/[^/]*|io/.*|selftest/selftest_json\\.h)$"
    "^(vorpipe\\.h|cli/.*)$")

# Adds the rooms of a folder: a room may include itself, those that it uses, each of which comes before it, and
# what matches `all_may`.
function(vorpipe_read_rooms folder all_may)
  set(list src/${folder}/CMakeLists.txt)
  file(STRINGS ${root}/${list} rooms REGEX "^vorpipe_room\\(")
  if(NOT rooms)
    message(FATAL_ERROR "No rooms in ${list}.")
  endif()
  set(below "")
  foreach(line IN LISTS rooms)
    if(NOT line MATCHES "^vorpipe_room\\(([a-z]+)( USES ([a-z ]+[a-z]))?")
      message(FATAL_ERROR "${list}: cannot read: ${line}")
    endif()
    set(room ${CMAKE_MATCH_1})
    string(REPLACE " " ";" uses "${CMAKE_MATCH_3}")
    foreach(used IN LISTS uses)
      if(NOT used IN_LIST below)
        message(SEND_ERROR "${list}: ${room} uses ${used}, which does not come before it")
      endif()
    endforeach()
    list(JOIN uses "|" uses)
    list(APPEND kinds "^${folder}/${room}/")
    list(APPEND may_include "^(${folder}/(${room}|${uses})/.*|${all_may})$")
    list(APPEND below ${room})
  endforeach()
  set(kinds ${kinds} PARENT_SCOPE)
  set(may_include ${may_include} PARENT_SCOPE)
endfunction()
vorpipe_read_rooms(
  core "vorpipe(/(free_surface|patterns|shapes|tiled))?\\.h|base/.*|geos\\.h|backend/(backend|collect|device_needs|exact_tier|forwarding_backend|precision|registry/registry|tie)\\.h")
vorpipe_read_rooms(backend/cpu "vorpipe\\.h|base/.*|backend/[^/]*\\.h|(layout|bins|cell|grid|list)\\.glsl")
vorpipe_read_rooms(backend/vulkan "vorpipe\\.h|base/.*|backend/[^/]*\\.h|layout\\.glsl|shaders\\.h")
vorpipe_read_rooms(backend/opengl "vorpipe\\.h|base/.*|backend/[^/]*\\.h|layout\\.glsl|shaders\\.h")
vorpipe_read_rooms(moving "vorpipe\\.h|vorpipe/(fluid|free_surface|masses|stipple)\\.h|base/.*|core/outline/edge_tree\\.h")
vorpipe_read_rooms(io "vorpipe(/(fluid|free_surface|patterns|shapes|tiled))?\\.h|geos\\.h|base/parallel\\.h")
vorpipe_read_rooms(
  bench "vorpipe\\.h|base/.*|io/(text/json_text|sites/site_source)\\.h|core/(cells/cells_run|picture/picture)\\.h|backend/(backend|exact_tier|forwarding_backend|registry/registry)\\.h")
vorpipe_read_rooms(
  view "vorpipe\\.h|vorpipe/.*|base/(parallel|stopwatch)\\.h|io/.*|backend/(vulkan|opengl)/[a-z]+/.*|shaders\\.h")
vorpipe_read_rooms(cli "vorpipe\\.h|vorpipe/(fluid|free_surface|masses|selftest|shapes|stipple|tiled)\\.h|selftest/selftest_json\\.h|base/(parallel|stopwatch)\\.h|io/.*|bench/.*|view/.*")

# Headers, most of them a library's, and the only files that may include them.
set(guarded_headers
    "^backend/registry/"
    "^backend/(vulkan|opengl)/[a-z]+/"
    "^(vulkan/|volk\\.h)"
    "^(epoxy|GL|GLES.|EGL|OpenGL)/"
    "^GLFW/"
    "^imgui"
    "^glm/"
    "^flann/"
    "^csv\\.h$"
    "^png\\.h$"
    "^zlib\\.h$"
    "^sqlite3\\.h$"
    "^xxhash\\.h$"
    "^geos_c\\.h$"
    "^geos\\.h$"
    "^boost/geometry/"
    "^CLI/"
    "^(tbb|oneapi)/"
    "^Eigen/")
set(users
    "^(core/locate/|core/session/|core/tiled/|bench/|backend/registry/)"
    "^(backend/(vulkan|opengl)|view/window)/"
    "^(backend/vulkan/|view/window/(glfw\\.h|vulkan_.*|swapchain\\..*)$)"
    "^(backend/opengl/|view/window/opengl_)"
    "^view/window/glfw\\.h$"
    "^view/panel/"
    "^backend/cpu/"
    "^core/search/flann_"
    "^io/text/csv_reader\\."
    "^io/pictures/png_file\\."
    "^io/(arrays/(npz|zip)_file|files/inflater|pictures/deflate)\\.cpp$"
    "^io/geopackage/"
    "^io/files/content_hash\\.cpp$"
    "^geos\\.h$"
    "^(core/outline/(geos_outline|hull|mended|repaired|validity)|io/meshes/hole_triangles)\\."
    "^core/outline/"
    "^cli/options/(command_line|help_format)\\.cpp$"
    "^base/parallel(_sort)?\\.cpp$"
    "^moving/linear/factored\\.cpp$")

# Sets allowed to whether file (relative to src) may include header, quoted or in angle brackets.
function(vorpipe_may_include file header quoted allowed)
  set(${allowed} TRUE PARENT_SCOPE)
  foreach(headers user IN ZIP_LISTS guarded_headers users)
    if(header MATCHES "${headers}" AND NOT file MATCHES "${user}")
      set(${allowed} FALSE PARENT_SCOPE)
    endif()
  endforeach()
  if(quoted)
    foreach(kind headers IN ZIP_LISTS kinds may_include)
      if(file MATCHES "${kind}")
        if(NOT header MATCHES "${headers}")
          set(${allowed} FALSE PARENT_SCOPE)
        endif()
        return()
      endif()
    endforeach()
    set(${allowed} FALSE PARENT_SCOPE)
  endif()
endfunction()

# The rules themselves, tried on includes that they must allow or refuse.
function(vorpipe_expect expected file header quoted)
  vorpipe_may_include(${file} ${header} ${quoted} allowed)
  if(NOT allowed STREQUAL expected)
    message(FATAL_ERROR "The rules are wrong about ${file} including ${header}: ${allowed}.")
  endif()
endfunction()
vorpipe_expect(TRUE core/picture/picture.cpp backend/backend.h TRUE)
vorpipe_expect(TRUE core/ties/ties.cpp core/vertices/cell_check.h TRUE)
vorpipe_expect(FALSE core/vertices/cell_check.cpp core/ties/ties.h TRUE)
vorpipe_expect(FALSE core/check/run.h backend/registry/registry.h TRUE)
vorpipe_expect(FALSE core/check/cells.cpp core/diagram/diagram_writer.h TRUE)
vorpipe_expect(TRUE core/search/flann_search.cpp flann/flann.hpp FALSE)
vorpipe_expect(TRUE backend/registry/registry.cpp backend/cpu/cpu.h TRUE)
vorpipe_expect(TRUE backend/cpu/tree/ring.h backend/cpu/clip/glsl.h TRUE)
vorpipe_expect(FALSE backend/cpu/lanes/grid_cells.cpp backend/cpu/tree/tree.h TRUE)
vorpipe_expect(TRUE backend/vulkan/device/device.cpp backend/capabilities.h TRUE)
vorpipe_expect(TRUE backend/vulkan/kernels/painter.h backend/vulkan/memory/target.h TRUE)
vorpipe_expect(FALSE backend/vulkan/memory/target.h backend/vulkan/geometry/pipelines.h TRUE)
vorpipe_expect(FALSE backend/vulkan/geometry/draw.cpp backend/vulkan/compute/compute.h TRUE)
vorpipe_expect(TRUE backend/opengl/pipelines/cells.cpp backend/opengl/memory/buffer.h TRUE)
vorpipe_expect(FALSE backend/opengl/device/device.cpp backend/opengl/pipelines/geometry.h TRUE)
vorpipe_expect(TRUE cli/commands/render.cpp io/pictures/png_file.h TRUE)
vorpipe_expect(TRUE io/cells/cells_npz.cpp io/arrays/zip_file.h TRUE)
vorpipe_expect(FALSE io/arrays/zip_file.cpp io/cells/cells_file.h TRUE)
vorpipe_expect(FALSE io/text/number.cpp csv.h FALSE)
vorpipe_expect(FALSE core/picture/picture.cpp backend/cpu/cpu.h TRUE)
vorpipe_expect(TRUE bench/tables/scaling.cpp bench/lab/lab.h TRUE)
vorpipe_expect(FALSE bench/measured/machine.cpp bench/lab/lab.h TRUE)
vorpipe_expect(FALSE bench/lab/lab.cpp core/judge/judge.h TRUE)
vorpipe_expect(FALSE core/picture/picture.cpp flann/flann.hpp FALSE)
vorpipe_expect(TRUE base/parallel.cpp tbb/parallel_for.h FALSE)
vorpipe_expect(FALSE core/picture/picture.cpp tbb/parallel_for.h FALSE)
vorpipe_expect(TRUE moving/linear/factored.cpp Eigen/SparseCholesky FALSE)
vorpipe_expect(FALSE moving/linear/laplacian_solver.cpp Eigen/SparseCholesky FALSE)
vorpipe_expect(FALSE core/picture/picture.cpp ../backend/cpu/cpu.h TRUE)
vorpipe_expect(FALSE backend/opengl/pipelines/cells.cpp backend/vulkan/device/device.h TRUE)
vorpipe_expect(FALSE backend/opengl/pipelines/cells.cpp backend/registry/registry.h TRUE)
vorpipe_expect(FALSE backend/backend.h volk.h FALSE)
vorpipe_expect(FALSE backend/cpu/cpu.cpp epoxy/gl.h FALSE)
vorpipe_expect(FALSE io/pictures/png_file.cpp core/cells/cells_run.h TRUE)
vorpipe_expect(FALSE cli/options/options.cpp cli/runs/input.h TRUE)
vorpipe_expect(FALSE cli/commands/render.cpp core/cells/cells_run.h TRUE)
vorpipe_expect(TRUE view/window/vulkan_canvas.h backend/vulkan/memory/plane.h TRUE)
vorpipe_expect(FALSE view/frames/painter.cpp backend/vulkan/memory/plane.h TRUE)
vorpipe_expect(FALSE view/window/frame_parts.cpp volk.h FALSE)
vorpipe_expect(FALSE view/app/viewer.cpp imgui.h FALSE)
vorpipe_expect(FALSE vorpipe.h glm/vec2.hpp FALSE)
vorpipe_expect(FALSE elsewhere/file.cpp vorpipe.h TRUE)

file(GLOB_RECURSE files RELATIVE ${root}/src ${root}/src/*.h ${root}/src/*.cpp)
# The environment belongs to the whole process: a library that writes it races with other threads that read it.
foreach(file IN LISTS files)
  file(STRINGS ${root}/src/${file} lines REGEX "[^A-Za-z_](setenv|unsetenv|putenv|clearenv) *\\(")
  if(lines AND NOT file STREQUAL "bench/measured/driver_threads.cpp")
    message(SEND_ERROR "src/${file} must not change the environment")
  endif()
endforeach()
list(LENGTH files count)
if(count EQUAL 0)
  message(FATAL_ERROR "No sources in ${root}/src.")
endif()
set(broken 0)
foreach(file IN LISTS files)
  file(STRINGS ${root}/src/${file} lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    set(quoted FALSE)
    if(line MATCHES "\"([^\"]+)\"")
      set(quoted TRUE)
    elseif(NOT line MATCHES "<([^>]+)>")
      message(FATAL_ERROR "src/${file}: cannot read: ${line}")
    endif()
    vorpipe_may_include(${file} ${CMAKE_MATCH_1} ${quoted} allowed)
    if(NOT allowed)
      message(SEND_ERROR "src/${file} must not include ${CMAKE_MATCH_1}")
      math(EXPR broken "${broken} + 1")
    endif()
  endforeach()
endforeach()
message(STATUS "${count} files, ${broken} includes against the rules")
