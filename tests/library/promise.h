/* What the tests of the library have in common. */
#ifndef PROMISE_H
#define PROMISE_H

#include <stdio.h>
#include <string.h>

#include "vorpipe_c.h"

extern int broken_promises;

/* Says where a promise is broken, and goes on. */
#define PROMISE(holds)                                                                                      \
  do {                                                                                                      \
    if (!(holds)) {                                                                                         \
      ++broken_promises;                                                                                    \
      fprintf(stderr, "%s:%d: %s\n    last error: %s\n", __FILE__, __LINE__, #holds, vorpipe_last_error()); \
    }                                                                                                       \
  } while (0)

#define DONE(call) PROMISE((call) == VORPIPE_DONE)

/* A call is refused, with a code and with words in its message. */
#define REFUSED(expected, words, call)                    \
  do {                                                    \
    PROMISE((call) == (expected));                        \
    PROMISE(strstr(vorpipe_last_error(), words) != NULL); \
  } while (0)

int hasNote(const vorpipe_input* input, const char* words);

void cells_promises(vorpipe_session* session);
void pictures_promises(vorpipe_session* session);
void input_promises(vorpipe_session* session);
void files_promises(vorpipe_session* session);
void looks_promises(vorpipe_session* session);
void relaxing_promises(vorpipe_session* session);
void transporting_promises(vorpipe_session* session);
void flowing_promises(vorpipe_session* session);
void refusals(vorpipe_session* session);
void devices_promises(void);
void selftest_promises(void);

#endif
