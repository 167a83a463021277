# How a shader module is made: GLSL -> SPIR-V -> optimized -> checked. One that has loops to unroll is made a second time
# with its loops, rolled; from that, or from the only one, comes GLSL 4.10, but for compute shaders, which OpenGL 4.1
# does not know. Everything goes to the build folder; the target update-spv copies it to shaders/spv.
# Where a compiler is missing, the modules of shaders/spv are embedded as they are. Where they are of the same
# sources, defines and flags, there is no need to compile them again but for tests, which compare the two; and tests
# do so with those that take no time.

include(${CMAKE_CURRENT_LIST_DIR}/manifest.cmake)
find_program(GLSLANG NAMES glslangValidator glslang)
find_program(SPIRV_OPT spirv-opt)
find_program(SPIRV_VAL spirv-val)
find_program(SPIRV_CROSS spirv-cross)

set(vulkan vulkan1.1)
set(glslang_flags -V --target-env ${vulkan})
# Names stay in the SPIR-V: OpenGL 4.1 binds blocks and samplers by name.
set(optimize_flags -O)
# OpenGL 4.1 has no storage buffers: every specialization constant (they are all flags) is false
# there, and what it guards is folded away.
set(fold_flags --set-spec-const-default-value "0:false" --freeze-spec-const --fold-spec-const-op-composite -O)
# Without a hint for drivers: some obey one that asks to unroll, and take minutes for what that makes (decision D121).
# As text, too, a loop is shorter than what it unrolls to, and OpenGL drivers keep the programs that they have made of it.
set(rolled_flags -DROLLED)
set(cross_flags --version 410 --no-es --no-420pack-extension)

string(JOIN " " glslang_line flags glslang ${glslang_flags})
string(JOIN " " optimize_line flags spirv_opt ${optimize_flags})
string(JOIN " " rolled_line flags glslang rolled ${rolled_flags})
string(JOIN " " fold_line flags spirv_opt for OpenGL ${fold_flags})
string(JOIN " " cross_line flags spirv_cross ${cross_flags})
set(recipe_flags "${glslang_line}" "${optimize_line}" "${rolled_line}" "${fold_line}" "${cross_line}")

set(glsl_dir ${CMAKE_CURRENT_LIST_DIR}/glsl)
set(committed_dir ${CMAKE_CURRENT_LIST_DIR}/spv)
set(built_dir ${CMAKE_CURRENT_BINARY_DIR}/spv)
set(shader_recipe ${CMAKE_CURRENT_BINARY_DIR}/recipe.txt)
set(shader_modules "")
set(shader_files "")
set(recipe_modules "")

if(GLSLANG AND SPIRV_OPT AND SPIRV_VAL AND SPIRV_CROSS)
  set(shaders_dir ${built_dir})
  file(MAKE_DIRECTORY ${built_dir})
  foreach(tool_and_option "GLSLANG --version" "SPIRV_OPT --version" "SPIRV_CROSS --revision")
    separate_arguments(tool_and_option)
    list(GET tool_and_option 0 tool)
    list(GET tool_and_option 1 option)
    vorpipe_tool_version(${${tool}} ${option} version)
    string(TOLOWER ${tool} name)
    string(APPEND recipe_tools "tool ${name} ${version}\n")
  endforeach()
else()
  set(shaders_dir ${committed_dir})
  message(STATUS "glslang, SPIRV-Tools or SPIRV-Cross is missing: using the shaders of shaders/spv")
endif()

# Unrolled loops are what takes the optimizer long. That shaders/spv has these as they would be made, their sources' and
# their own hashes in MANIFEST say.
set(compiled_shaders none)
if(VORPIPE_TESTS)
  set(compiled_shaders short)
endif()
set(VORPIPE_COMPILED_SHADERS ${compiled_shaders} CACHE STRING
    "Compile shaders that shaders/spv has of the same sources: none; short, those without loops to unroll; all")
if(NOT VORPIPE_COMPILED_SHADERS MATCHES "^(none|short|all)$")
  message(FATAL_ERROR "VORPIPE_COMPILED_SHADERS is none, short or all, not ${VORPIPE_COMPILED_SHADERS}")
endif()
set(committed_rows "")
if(NOT VORPIPE_COMPILED_SHADERS STREQUAL all)
  file(GLOB shader_sources CONFIGURE_DEPENDS ${glsl_dir}/*)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${shader_sources} ${committed_dir}/MANIFEST)
  file(STRINGS ${committed_dir}/MANIFEST committed_rows)
  set(rows_of_all "${recipe_flags}")
  if(VORPIPE_COMPILED_SHADERS STREQUAL short)
    string(REGEX MATCHALL "[^\n]+" tool_rows "${recipe_tools}")
    list(APPEND rows_of_all ${tool_rows})
  endif()
  foreach(line IN LISTS rows_of_all)
    if(NOT line IN_LIST committed_rows)
      set(committed_rows "")
    endif()
  endforeach()
endif()

# vorpipe_compile_spirv(name out source flag...): out.spv, optimized and checked.
function(vorpipe_compile_spirv name out source)
  add_custom_command(
    OUTPUT ${out}.raw.spv
    COMMAND ${GLSLANG} --quiet ${glslang_flags} ${ARGN} --depfile ${out}.d -o ${out}.raw.spv ${source}
    DEPENDS ${source}
    DEPFILE ${out}.d
    COMMENT "Compiling shader ${name}"
    VERBATIM)
  add_custom_command(
    OUTPUT ${out}.spv
    COMMAND ${SPIRV_OPT} ${optimize_flags} ${out}.raw.spv -o ${out}.unchecked.spv
    COMMAND ${SPIRV_VAL} --target-env ${vulkan} ${out}.unchecked.spv
    COMMAND ${CMAKE_COMMAND} -E rename ${out}.unchecked.spv ${out}.spv
    DEPENDS ${out}.raw.spv
    COMMENT "Optimizing shader ${name}"
    VERBATIM)
endfunction()

# vorpipe_shader(module file define...): the module of that name is made from glsl/file.
function(vorpipe_shader module file)
  set(shader_modules ${shader_modules} ${module} PARENT_SCOPE)
  set(source ${glsl_dir}/${file})
  list(TRANSFORM ARGN PREPEND -D OUTPUT_VARIABLE defines)
  string(JOIN " " row module ${module} ${file} ${defines})
  set(recipe_modules "${recipe_modules}${row}\n" PARENT_SCOPE)
  vorpipe_module_files("${row}" files)
  set(shader_files ${shader_files} ${files} PARENT_SCOPE)
  if(shaders_dir STREQUAL committed_dir)
    return()
  endif()
  set(out ${built_dir}/${module})
  string(JOIN " " words ${defines})
  vorpipe_manifest_row(${glsl_dir} ${module} ${file} "${words}" committed_row)
  if(committed_row IN_LIST committed_rows AND (words MATCHES MAX_EDGES OR VORPIPE_COMPILED_SHADERS STREQUAL none))
    foreach(copied IN LISTS files)
      add_custom_command(
        OUTPUT ${built_dir}/${copied}
        COMMAND ${CMAKE_COMMAND} -E copy ${committed_dir}/${copied} ${built_dir}/${copied}
        DEPENDS ${committed_dir}/${copied}
        COMMENT "Copying shader ${copied}"
        VERBATIM)
    endforeach()
    return()
  endif()
  set(looped ${out}.spv)
  vorpipe_compile_spirv(${module} ${out} ${source} ${defines})
  if(${module}.rolled.spv IN_LIST files)
    set(looped ${out}.rolled.spv)
    vorpipe_compile_spirv("${module}, rolled" ${out}.rolled ${source} ${rolled_flags} ${defines})
  endif()
  if(NOT ${module}.410.glsl IN_LIST files)
    return()
  endif()
  string(REGEX REPLACE ".*\\." "" stage ${file})
  add_custom_command(
    OUTPUT ${out}.410.glsl
    COMMAND ${SPIRV_OPT} ${fold_flags} ${looped} -o ${out}.folded.spv
    COMMAND ${SPIRV_CROSS} ${out}.folded.spv ${cross_flags} --output ${out}.unchecked.glsl
    COMMAND ${GLSLANG} --quiet -S ${stage} ${out}.unchecked.glsl
    COMMAND ${CMAKE_COMMAND} -E rename ${out}.unchecked.glsl ${out}.410.glsl
    DEPENDS ${looped}
    COMMENT "Translating shader ${module} for OpenGL 4.1"
    VERBATIM)
endfunction()

# vorpipe_embed_shaders(target): a static library of all modules so far, with its header shaders.h.
function(vorpipe_embed_shaders target)
  string(JOIN "\n" flag_lines ${recipe_flags})
  file(CONFIGURE OUTPUT ${shader_recipe} @ONLY CONTENT
"@recipe_tools@@flag_lines@
@recipe_modules@")

  list(TRANSFORM shader_files PREPEND ${shaders_dir}/ OUTPUT_VARIABLE files)
  set(embed ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/embed.cmake)
  set(check "")
  if(shaders_dir STREQUAL committed_dir)
    set(check -D recipe=${shader_recipe} -D glsl=${glsl_dir})
    file(GLOB glsl_files CONFIGURE_DEPENDS ${glsl_dir}/*)
    list(APPEND files ${committed_dir}/MANIFEST ${glsl_files})
  endif()
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/generated)
  add_custom_command(
    OUTPUT ${generated}/shaders.cpp ${generated}/shaders.h
    COMMAND ${CMAKE_COMMAND} -D "modules=${shader_modules}" -D from=${shaders_dir} -D to=${generated} ${check} -P ${embed}
    DEPENDS ${files} ${embed}
    COMMENT "Embedding the shaders"
    VERBATIM)
  add_library(${target} STATIC ${generated}/shaders.cpp)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} SYSTEM PUBLIC ${generated})

  # Which names the tools that are here, and so must not copy what others made.
  if(NOT shaders_dir STREQUAL committed_dir AND NOT VORPIPE_COMPILED_SHADERS STREQUAL none)
    add_custom_target(
      update-spv
      COMMAND
        ${CMAKE_COMMAND} -D recipe=${shader_recipe} -D from=${built_dir} -D glsl=${glsl_dir} -D to=${committed_dir} -P
        ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/update.cmake
      DEPENDS ${files}
      COMMENT "Writing shaders/spv"
      VERBATIM)
  endif()
endfunction()
