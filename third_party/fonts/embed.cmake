# Writes a source with the bytes of a font.
# cmake -D font=FILE -D source=FILE -P embed.cmake
cmake_minimum_required(VERSION 3.25)

file(READ ${font} bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1, " bytes "${bytes}")
string(REPEAT "0x.., " 16 line)
string(REGEX REPLACE "(${line})" "\\1\n    " bytes "${bytes}")
file(WRITE ${source}
     "// Made by third_party/fonts/embed.cmake.\n#include \"io/pictures/font_file.h\"\n\nnamespace vorpipe {\n"
     "namespace {\n\nconstexpr unsigned char bytes[] = {\n    ${bytes}};\n\n}  // namespace\n\n"
     "std::span<const unsigned char> fontFile() { return bytes; }\n\n}  // namespace vorpipe\n")
