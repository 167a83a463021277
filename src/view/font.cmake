# The letters of the panel are a part of the program.
set(font_file ${CMAKE_CURRENT_BINARY_DIR}/font_file.cpp)
set(fonts ${PROJECT_SOURCE_DIR}/third_party/fonts)
add_custom_command(
  OUTPUT ${font_file}
  COMMAND ${CMAKE_COMMAND} -D font=${fonts}/DejaVuSansCondensed.ttf -D source=${font_file} -P ${fonts}/embed.cmake
  DEPENDS ${fonts}/DejaVuSansCondensed.ttf ${fonts}/embed.cmake
  VERBATIM)
add_library(vorpipe_view_font STATIC ${font_file})
target_link_libraries(vorpipe_view_font PRIVATE vorpipe_options)

