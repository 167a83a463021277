# vorpipe_reads_headers_once(target): its sources are compiled with headers that were read before. ccache asks for
# this to keep what comes of it. And GCC 12 then warns of std::string's own code, where a text is added to another
# (its bug 105651): where headers are read with each source, as in the preset asan, these warnings are on.
function(vorpipe_reads_headers_once target)
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread>)
  if(CCACHE AND CMAKE_CXX_COMPILER_LAUNCHER STREQUAL CCACHE)
    set_target_properties(
      ${target} PROPERTIES CXX_COMPILER_LAUNCHER
                           "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros;${CCACHE}")
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
  endif()
endfunction()

# What names many templates and does nothing for long is optimized a little.
add_library(vorpipe_quick INTERFACE)
target_compile_options(vorpipe_quick INTERFACE $<$<NOT:$<CONFIG:Debug>>:-Og>)

# VORPIPE_PRECOMPILE: headers that most sources include are read once for all, which is a quarter of a build from
# nothing. The preset asan is without, so that there every source is held to naming what it uses.
if(VORPIPE_PRECOMPILE)
  set(empty ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
  file(CONFIGURE OUTPUT ${empty} CONTENT "")
  # They serve sources that are compiled by the same options alone.
  add_library(vorpipe_precompiled OBJECT ${empty})
  add_library(vorpipe_precompiled_quick OBJECT ${empty})
  target_link_libraries(vorpipe_precompiled_quick PRIVATE vorpipe_quick)
  foreach(target vorpipe_precompiled vorpipe_precompiled_quick)
    target_link_libraries(${target} PRIVATE vorpipe_options dep::fmt)
    vorpipe_reads_headers_once(${target})
    target_precompile_headers(
      ${target}
      PRIVATE
      <algorithm>
      <array>
      <chrono>
      <cmath>
      <cstdint>
      <functional>
      <map>
      <memory>
      <optional>
      <span>
      <stop_token>
      <string>
      <string_view>
      <utility>
      <vector>
      <fmt/format.h>
      <fmt/ranges.h>
      <tl/expected.hpp>)
  endforeach()
endif()

# vorpipe_precompiled(target): its sources are compiled with those headers.
function(vorpipe_precompiled target)
  if(NOT VORPIPE_PRECOMPILE)
    return()
  endif()
  vorpipe_reads_headers_once(${target})
  get_target_property(libraries ${target} LINK_LIBRARIES)
  if(vorpipe_quick IN_LIST libraries)
    target_precompile_headers(${target} REUSE_FROM vorpipe_precompiled_quick)
  else()
    target_precompile_headers(${target} REUSE_FROM vorpipe_precompiled)
  endif()
endfunction()
