# Writes shaders.h and shaders.cpp: the SPIR-V of every module as words, its GLSL 4.10 as text.
# cmake -D modules=a;b -D from=DIR -D to=DIR [-D recipe=FILE -D glsl=DIR] -P embed.cmake
# With a recipe, refuses modules whose MANIFEST says that their GLSL was another one.
cmake_minimum_required(VERSION 3.25)

if(recipe)
  include(${CMAKE_CURRENT_LIST_DIR}/manifest.cmake)
  vorpipe_stale_rows(${recipe} ${glsl} ${from}/MANIFEST stale)
  if(stale)
    message(FATAL_ERROR "shaders/spv is older than shaders/glsl: install glslang, spirv-tools and spirv-cross")
  endif()
endif()

string(REPEAT "0x........, " 8 line_of_words)
set(declarations "")
set(definitions "")
set(accessors "")

# Defines an array with a module's words. SPIR-V words lie in the file lowest byte first.
macro(define_words name bytes)
  string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1, " words "${bytes}")
  string(REGEX REPLACE "(${line_of_words})" "\\1\n    " words "${words}")
  string(APPEND definitions "constexpr std::uint32_t ${name}[] = {\n    ${words}};\n\n")
endmacro()

foreach(module IN LISTS modules)
  file(READ ${from}/${module}.spv unrolled HEX)
  define_words(${module}_unrolled "${unrolled}")
  set(rolled_words ${module}_unrolled)
  if(EXISTS ${from}/${module}.rolled.spv)
    file(READ ${from}/${module}.rolled.spv rolled HEX)
    # There may have been nothing to unroll.
    if(NOT rolled STREQUAL unrolled)
      set(rolled_words ${module}_rolled)
      define_words(${rolled_words} "${rolled}")
    endif()
  endif()
  string(APPEND declarations "Spirv ${module}();\n")
  string(APPEND accessors "Spirv ${module}() { return {\"${module}\", ${module}_unrolled, ${rolled_words}}; }\n")
  # A compute shader has no text for OpenGL 4.1.
  if(EXISTS ${from}/${module}.410.glsl)
    file(READ ${from}/${module}.410.glsl text)
    string(APPEND declarations "std::string_view ${module}_410();\n")
    string(APPEND definitions "constexpr char ${module}_text[] = R\"glsl(${text})glsl\";\n\n")
    string(APPEND accessors "std::string_view ${module}_410() { return {${module}_text, sizeof(${module}_text) - 1}; }\n")
  endif()
endforeach()

file(WRITE ${to}/shaders.h
     "/// Every shader module: its SPIR-V, and the GLSL 4.10 made from it. Made by shaders/embed.cmake.\n"
     "#pragma once\n\n#include <cstdint>\n#include <span>\n#include <string_view>\n\n"
     "namespace vorpipe::shaders {\n\n"
     "/// A module with its loops unrolled, and with its loops; the same where it has none to unroll.\n"
     "struct Spirv {\n  std::string_view name;\n  std::span<const std::uint32_t> unrolled, rolled;\n};\n\n${declarations}\n}  // namespace vorpipe::shaders\n")
file(WRITE ${to}/shaders.cpp
     "// Made by shaders/embed.cmake.\n#include \"shaders.h\"\n\nnamespace vorpipe::shaders {\n\n"
     "namespace {\n\n${definitions}}  // namespace\n\n${accessors}\n}  // namespace vorpipe::shaders\n")
