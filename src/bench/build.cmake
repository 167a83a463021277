# The revision is looked up again when git's head has moved or anything was compiled, and nothing but one small
# file is compiled for it.
set(build_dir ${CMAKE_CURRENT_BINARY_DIR}/generated)
set(vorpipe_flags "${CMAKE_CXX_FLAGS}")
set(vorpipe_build_type "${CMAKE_BUILD_TYPE}")
string(TOUPPER "CMAKE_CXX_FLAGS_${CMAKE_BUILD_TYPE}" flags_of_type)
get_target_property(own_flags vorpipe_options INTERFACE_COMPILE_OPTIONS)
list(FILTER own_flags INCLUDE REGEX "^-[fmO]")
string(REPLACE ";" " " vorpipe_flags "${CMAKE_CXX_FLAGS};${${flags_of_type}};-std=c++20;${own_flags}")
string(STRIP "${vorpipe_flags}" vorpipe_flags)
configure_file(bench/build.h.in ${build_dir}/bench/build.h @ONLY)

set(head "")
execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} rev-parse --git-path logs/HEAD OUTPUT_VARIABLE log ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(log)
  get_filename_component(log ${log} ABSOLUTE BASE_DIR ${PROJECT_SOURCE_DIR})
  if(EXISTS ${log})
    set(head ${log})
  endif()
endif()
get_property(compiled GLOBAL PROPERTY vorpipe_modules)
add_custom_command(
  OUTPUT ${build_dir}/revision.cpp
  COMMAND ${CMAKE_COMMAND} -D source=${PROJECT_SOURCE_DIR} -D output=${build_dir}/revision.cpp -P
          ${CMAKE_CURRENT_LIST_DIR}/revision.cmake
  DEPENDS ${head} ${compiled} ${CMAKE_CURRENT_LIST_DIR}/revision.cmake
  VERBATIM)

add_library(vorpipe_bench_build STATIC ${build_dir}/revision.cpp)
target_include_directories(vorpipe_bench_build PUBLIC ${build_dir})
target_link_libraries(vorpipe_bench_build PRIVATE vorpipe_options)

