# Writes a source file that says which revision this is, if it does not say so already.
# cmake -D source=DIR -D output=FILE -P revision.cmake
find_program(GIT git)
set(revision unknown)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${source} describe --always --dirty --abbrev=12 --exclude *
                  OUTPUT_VARIABLE described ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
  if(NOT failed)
    set(revision ${described})
  endif()
endif()
file(CONFIGURE OUTPUT ${output} CONTENT [[
#include "bench/build.h"

std::string_view vorpipe::bench::build::revision() { return "@revision@"; }
]] @ONLY)
