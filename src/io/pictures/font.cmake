# The letters of the panel and of PDFs are a part of the program.
set(font_file ${CMAKE_CURRENT_BINARY_DIR}/font_file.cpp)
set(fonts ${PROJECT_SOURCE_DIR}/third_party/fonts)
add_custom_command(
  OUTPUT ${font_file}
  COMMAND ${CMAKE_COMMAND} -D font=${fonts}/DejaVuSansCondensed.ttf -D source=${font_file} -P ${fonts}/embed.cmake
  DEPENDS ${fonts}/DejaVuSansCondensed.ttf ${fonts}/embed.cmake
  VERBATIM)
target_sources(vorpipe_io_pictures PRIVATE ${font_file})
set_source_files_properties(${font_file} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
