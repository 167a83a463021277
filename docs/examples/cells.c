/* The areas of a thousand cells, and a drawing of them. */
#include <stdio.h>
#include <vorpipe_c.h>

int main(void) {
  vorpipe_session* session = NULL;
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram = NULL;
  vorpipe_array area = {0};
  int code;
  if ((code = vorpipe_session_open(NULL, &session)) || (code = vorpipe_input_read("random:1000", 1, &input)) ||
      (code = vorpipe_cells(session, input, NULL, &diagram)) ||
      (code = vorpipe_diagram_array(diagram, VORPIPE_CELL_AREA, &area)) ||
      (code = vorpipe_diagram_save(diagram, "cells.svg"))) {
    fprintf(stderr, "%s\n", vorpipe_last_error());
  }
  for (int i = 0; i < (int)area.count; ++i) printf("cell %d: area %g\n", i, ((const double*)area.data)[i]);
  vorpipe_diagram_free(diagram);
  vorpipe_input_free(input);
  vorpipe_session_free(session);
  return code;
}
