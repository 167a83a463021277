# What shaders/spv/MANIFEST says of each module, and how to find out whether it still holds.

# The text of a shader with every #include replaced by the file's own text.
function(vorpipe_flatten file result)
  get_filename_component(dir ${file} DIRECTORY)
  file(READ ${file} rest)
  set(text "")
  while(rest MATCHES "#include \"([^\"]+)\"")
    set(directive "${CMAKE_MATCH_0}")
    set(included "${dir}/${CMAKE_MATCH_1}")
    string(FIND "${rest}" "${directive}" at)
    string(SUBSTRING "${rest}" 0 ${at} before)
    string(LENGTH "${directive}" length)
    math(EXPR at "${at} + ${length}")
    string(SUBSTRING "${rest}" ${at} -1 rest)
    vorpipe_flatten(${included} inner)
    string(APPEND text "${before}${inner}")
  endwhile()
  set(${result} "${text}${rest}" PARENT_SCOPE)
endfunction()

# The MANIFEST's line for a module: name, file, hash of the flattened source, defines.
function(vorpipe_manifest_row glsl_dir module file defines result)
  vorpipe_flatten(${glsl_dir}/${file} text)
  string(SHA256 hash "${text}")
  string(STRIP "module ${module} ${file} ${hash} ${defines}" row)
  set(${result} "${row}" PARENT_SCOPE)
endfunction()

# What a tool calls its own version, on one line.
function(vorpipe_tool_version tool option result)
  execute_process(COMMAND ${tool} ${option} OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE ignored)
  string(REGEX MATCH "[^\n]+" line "${text}")
  string(REPLACE ";" "," line "${line}")
  set(${result} "${line}" PARENT_SCOPE)
endfunction()
