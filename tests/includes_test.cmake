# Who may include what: a module those that src/CMakeLists.txt says it uses, each of which comes before it, base and the
# public headers; a program's modules no insides of the library; and which sources alone know a library.
# cmake -D root=DIR -P includes_test.cmake
cmake_minimum_required(VERSION 3.25)

# Regular expressions of the own headers that files of a kind may include; the first that matches a file's path holds
# for it. Below come the modules.
set(kinds "^vorpipe(\\.h$|/)" "^base/" "^backend/registry/" "^c/")
set(may_include
    "^vorpipe/"
    "^(vorpipe(/.*)?\\.h|base/.*)$"
    "^(vorpipe\\.h|base/try\\.h|backend/[^/]*\\.h|backend/registry/.*|backend/cpu/(cpu|exact_tier)\\.h|backend/vulkan/vulkan_backend\\.h|backend/opengl/opengl_backend\\.h)$"
    "^(vorpipe\\.h|vorpipe/.*|vorpipe_c\\.h|base/try\\.h|c/[^/]*|io/.*|selftest/selftest_json\\.h)$")

file(STRINGS ${root}/src/CMakeLists.txt lines REGEX "^vorpipe_module\\(")
if(NOT lines)
  message(FATAL_ERROR "No modules in src/CMakeLists.txt.")
endif()
set(below "")
foreach(line IN LISTS lines)
  if(NOT line MATCHES "^vorpipe_module\\(([a-z/]+)( USES ([a-z/ ]+[a-z]))?")
    message(FATAL_ERROR "src/CMakeLists.txt: cannot read: ${line}")
  endif()
  set(module ${CMAKE_MATCH_1})
  string(REPLACE " " ";" uses "${CMAKE_MATCH_3}")
  foreach(used IN LISTS uses)
    if(NOT used IN_LIST below)
      message(SEND_ERROR "src/CMakeLists.txt: ${module} uses ${used}, which does not come before it")
    endif()
  endforeach()
  list(JOIN uses "|" uses)
  list(APPEND kinds "^${module}/[^/]*$")
  list(APPEND may_include "^(vorpipe(/.*)?\\.h|base/.*|(layout|bins|cell|grid|list|polyhedron)\\.glsl|shaders\\.h|(${module}|${uses})/[^/]*)$")
  list(APPEND below ${module})
endforeach()

# Headers, most of them a library's, and the only files that may include them. Clang 14, the fuzz targets' compiler on
# Debian 12, cannot compile the views of GCC 12's <ranges>.
set(guarded_headers
    "^backend/registry/"
    "^(vulkan/|volk\\.h)"
    "^(epoxy|GL|GLES.|EGL|OpenGL)/"
    "^GLFW/"
    "^imgui"
    "^glm/"
    "^flann/"
    "^csv\\.h$"
    "^png\\.h$"
    "^(jpeglib|jerror)\\.h$"
    "^zlib\\.h$"
    "^sqlite3\\.h$"
    "^xxhash\\.h$"
    "^geos_c\\.h$"
    "^base/geos\\.h$"
    "^boost/geometry/"
    "^CLI/"
    "^(tbb|oneapi)/"
    "^Eigen/"
    "^ranges$"
    "\\.glsl$")
set(users
    "^(session/|bench/|backend/registry/)"
    "^(backend/vulkan/|view/window/(glfw\\.h|vulkan_.*)$)"
    "^(backend/opengl/|view/window/opengl_)"
    "^view/window/glfw\\.h$"
    "^view/(imgui_io|panel|panel_.*|widgets)\\."
    "^backend/cpu/"
    "^cells/flann_"
    "^io/base/csv_reader\\."
    "^io/pictures/png_file\\."
    "^io/pictures/jpeg_file\\.cpp$"
    "^io/(base/(zip_file|input_file)|pictures/deflate)\\.cpp$"
    "^io/base/"
    "^io/base/read_log\\.cpp$"
    "^base/geos\\.h$"
    "^(domain/(geos_outline|hull|mended)|io/cells/cells_mesh)\\."
    "^domain/"
    "^cli/options/command_line\\.cpp$"
    "^base/parallel\\.cpp$"
    "^motion/linear/laplacian\\.cpp$"
    "^io/cells/npz_arrays\\.h$"
    "^(backend|space)/")

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
vorpipe_expect(TRUE picture/picture.cpp backend/backend.h TRUE)
vorpipe_expect(TRUE cells/ties.cpp cells/cell_check.h TRUE)
vorpipe_expect(TRUE cells/ties.cpp geometry/predicates.h TRUE)
vorpipe_expect(FALSE geometry/predicates.cpp cells/ties.h TRUE)
vorpipe_expect(FALSE check/run.h backend/registry/registry.h TRUE)
vorpipe_expect(FALSE check/cells.cpp cells/diagram_writer.h TRUE)
vorpipe_expect(TRUE cells/flann_search.cpp flann/flann.hpp FALSE)
vorpipe_expect(TRUE backend/registry/registry.cpp backend/cpu/cpu.h TRUE)
vorpipe_expect(FALSE backend/registry/registry.cpp backend/cpu/tree.h TRUE)
vorpipe_expect(TRUE backend/vulkan/device.cpp backend/capabilities.h TRUE)
vorpipe_expect(TRUE cli/commands/render.cpp io/pictures/png_file.h TRUE)
vorpipe_expect(FALSE cli/options/options.cpp cli/input.h TRUE)
vorpipe_expect(FALSE cli/commands/render.cpp domain/cells_run.h TRUE)
vorpipe_expect(TRUE io/cells/cells_npz.cpp io/base/zip_file.h TRUE)
vorpipe_expect(FALSE io/base/zip_file.cpp io/cells/cells_file.h TRUE)
vorpipe_expect(FALSE io/base/number.cpp csv.h FALSE)
vorpipe_expect(FALSE io/pictures/png_file.cpp domain/cells_run.h TRUE)
vorpipe_expect(FALSE picture/picture.cpp backend/cpu/cpu.h TRUE)
vorpipe_expect(FALSE picture/picture.cpp ../backend/cpu/cpu.h TRUE)
vorpipe_expect(FALSE picture/picture.cpp cell.glsl TRUE)
vorpipe_expect(FALSE bench/lab.cpp cells/exact_search.h TRUE)
vorpipe_expect(FALSE picture/picture.cpp flann/flann.hpp FALSE)
vorpipe_expect(TRUE base/parallel.cpp tbb/parallel_for.h FALSE)
vorpipe_expect(FALSE picture/picture.cpp tbb/parallel_for.h FALSE)
vorpipe_expect(TRUE motion/linear/laplacian.cpp Eigen/SparseCholesky FALSE)
vorpipe_expect(FALSE motion/linear/laplacian_solver.cpp Eigen/SparseCholesky FALSE)
vorpipe_expect(FALSE picture/view.cpp ranges FALSE)
vorpipe_expect(FALSE backend/opengl/cells.cpp backend/vulkan/device.h TRUE)
vorpipe_expect(FALSE backend/opengl/cells.cpp backend/registry/registry.h TRUE)
vorpipe_expect(FALSE backend/backend.h volk.h FALSE)
vorpipe_expect(FALSE backend/cpu/cpu.cpp epoxy/gl.h FALSE)
vorpipe_expect(TRUE view/window/vulkan_canvas.h backend/vulkan/plane.h TRUE)
vorpipe_expect(FALSE view/painter.cpp backend/vulkan/plane.h TRUE)
vorpipe_expect(FALSE view/window/frame_parts.cpp volk.h FALSE)
vorpipe_expect(FALSE view/viewer.cpp imgui.h FALSE)
vorpipe_expect(FALSE vorpipe.h glm/vec2.hpp FALSE)
vorpipe_expect(FALSE elsewhere/file.cpp vorpipe.h TRUE)

file(GLOB_RECURSE files RELATIVE ${root}/src ${root}/src/*.h ${root}/src/*.cpp)
# The environment belongs to the whole process: a library that writes it races with other threads that read it.
foreach(file IN LISTS files)
  file(STRINGS ${root}/src/${file} lines REGEX "[^A-Za-z_](setenv|unsetenv|putenv|clearenv) *\\(")
  if(lines AND NOT file STREQUAL "bench/driver_threads.cpp")
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
