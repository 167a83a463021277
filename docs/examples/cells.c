#include <stdio.h>
#include <vorpipe_c.h>

/* The area and the neighbors of each of a thousand cells. */
int main(void) {
  vorpipe_session* session = NULL;
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram = NULL;
  vorpipe_array area, offsets;
  vorpipe_code code = vorpipe_session_open(NULL, &session);
  if (code == VORPIPE_DONE) code = vorpipe_input_read("random:1000", 1, &input);
  if (code == VORPIPE_DONE) code = vorpipe_cells(session, input, NULL, &diagram);
  if (code == VORPIPE_DONE) code = vorpipe_diagram_array(diagram, VORPIPE_CELL_AREA, &area);
  if (code == VORPIPE_DONE) code = vorpipe_diagram_array(diagram, VORPIPE_CELL_OFFSETS, &offsets);
  if (code == VORPIPE_DONE) {
    const double* areas = area.data;
    const uint64_t* first = offsets.data;
    for (uint64_t i = 0; i < area.count; ++i) {
      printf("cell %d: area %g, %d neighbors\n", (int)i, areas[i], (int)(first[i + 1] - first[i]));
    }
    code = vorpipe_diagram_save(diagram, "cells.svg");
  }
  if (code != VORPIPE_DONE) fprintf(stderr, "%s\n", vorpipe_last_error());
  vorpipe_diagram_free(diagram);
  vorpipe_input_free(input);
  vorpipe_session_free(session);
  return code;
}
