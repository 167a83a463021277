# Floating point need not trap or set errno, so that both sides of a selection can be computed; no result
# changes by that.
set_source_files_properties(
  backend/cpu/exact_cells.cpp backend/cpu/tree_cells.cpp PROPERTIES COMPILE_OPTIONS "-fno-trapping-math;-fno-math-errno"
                                                      SKIP_PRECOMPILE_HEADERS ON)
# Calls of operations on long numbers, as fast as with -O3, which takes three times as long to compile.
set_source_files_properties(backend/cpu/long_cells.cpp PROPERTIES COMPILE_OPTIONS "-O1;-fno-trapping-math;-fno-math-errno"
                                                           SKIP_PRECOMPILE_HEADERS ON)
# The cells side by side: vectors of 4 numbers, which every processor has, of 8 for those that have AVX2, and of 16
# for those that have AVX-512 as in x86-64-v4.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-march=x86-64-v4 VORPIPE_HAS_X86_64_V4)
set(lane_flags_8 -mavx2)
set(lane_flags_16 -march=x86-64-v4 -mprefer-vector-width=512)
# Each once for sites without weights, and once for sites with them.
function(vorpipe_add_lanes lanes name)
  set(target vorpipe_lanes_${lanes}_${name})
  add_library(${target} OBJECT backend/cpu/grid_lanes.cpp)
  target_compile_definitions(${target} PRIVATE VORPIPE_LANES=${lanes} VORPIPE_LANES_FUNCTION=${name}In${lanes}Lanes
                                               ${ARGN})
  # -O3 takes twice as long to compile.
  target_compile_options(${target} PRIVATE $<IF:$<CONFIG:Release>,-O3,-O2> -fno-trapping-math -fno-math-errno
                                           -Wno-psabi ${lane_flags_${lanes}})
  target_link_libraries(${target} PRIVATE vorpipe_options vorpipe_glsl)
  target_sources(vorpipe_backend_cpu PRIVATE $<TARGET_OBJECTS:${target}>)
endfunction()
foreach(lanes 4 8 16)
  if(lanes EQUAL 4 OR VORPIPE_HAS_X86_64_V4)
    vorpipe_add_lanes(${lanes} find)
    vorpipe_add_lanes(${lanes} findWeighted WEIGHTED)
  endif()
endforeach()
if(VORPIPE_HAS_X86_64_V4)
  set_source_files_properties(backend/cpu/find_in_lanes.cpp PROPERTIES COMPILE_DEFINITIONS VORPIPE_WIDE_LANES)
endif()
