# Whether the documents quote the examples as they are. cmake -D root=DIR -P quotes_test.cmake
cmake_minimum_required(VERSION 3.25)
foreach(example_and_page "count_pixels.cpp;docs/guide.md" "measure_cells.cpp;docs/domains.md" "read_cells.cpp;docs/guide.md"
        "list_devices.cpp;docs/backends.md" "cells.c;docs/library.md" "wrapper.cpp;docs/library.md")
  list(GET example_and_page 0 example)
  list(GET example_and_page 1 page)
  file(READ ${root}/docs/examples/${example} text)
  file(READ ${root}/${page} quoting)
  string(FIND "${quoting}" "${text}" at)
  if(at EQUAL -1)
    message(SEND_ERROR "${page} does not quote docs/examples/${example} as it is")
  endif()
endforeach()
