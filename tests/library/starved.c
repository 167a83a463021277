/* The first call of a thread that fails, where there is no memory left: run with refusals.so before it. */
#include <string.h>

#include "vorpipe_c.h"

int main(void) {
  vorpipe_input* input = NULL;
  if (vorpipe_input_read("random:10", 1, &input) != VORPIPE_DEVICE || input != NULL) return 1;
  return strstr(vorpipe_last_error(), "memory") == NULL;
}
