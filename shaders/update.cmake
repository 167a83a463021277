# Copies the built shaders to shaders/spv and writes its MANIFEST.
# cmake -D recipe=FILE -D from=DIR -D glsl=DIR -D to=DIR -P update.cmake
#
# The recipe, written when the build is configured, has a line for each tool with its version, one
# for each step with its flags, and one for each module with its source and its defines. The MANIFEST
# has these and one for each file with its hash.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/manifest.cmake)

set(copied "")
set(manifest "# What the files beside this one were made from. Made by the target update-spv.\n")
file(STRINGS ${recipe} lines)
file(GLOB old ${to}/*.spv ${to}/*.glsl)
if(old)
  file(REMOVE ${old})
endif()
foreach(line IN LISTS lines)
  if(line MATCHES "^module ([^ ]+) ([^ ]+) ?(.*)$")
    vorpipe_manifest_row(${glsl} ${CMAKE_MATCH_1} ${CMAKE_MATCH_2} "${CMAKE_MATCH_3}" row)
    vorpipe_module_files("${line}" files)
    foreach(file IN LISTS files)
      file(COPY ${from}/${file} DESTINATION ${to})
      file(SHA256 ${from}/${file} hash)
      string(APPEND copied "file ${file} ${hash}\n")
    endforeach()
    set(line "${row}")
  endif()
  string(APPEND manifest "${line}\n")
endforeach()
file(WRITE ${to}/MANIFEST "${manifest}${copied}")
