#include "promise.h"

int broken_promises = 0;

int main(void) {
  vorpipe_session_options options = {sizeof options};
  vorpipe_session* session = NULL;
  options.backend = "cpu";
  options.threads = 2;
  PROMISE(vorpipe_last_error()[0] == 0);
  PROMISE(strncmp(vorpipe_version(), "0.", 2) == 0);
  DONE(vorpipe_session_open(&options, &session));
  if (session == NULL) return 1;
  devices_promises();
  selftest_promises();
  cells_promises(session);
  input_promises(session);
  files_promises(session);
  pictures_promises(session);
  looks_promises(session);
  relaxing_promises(session);
  transporting_promises(session);
  flowing_promises(session);
  refusals(session);
  vorpipe_session_free(session);
  vorpipe_session_free(NULL);
  if (broken_promises > 0) fprintf(stderr, "%d promises are broken\n", broken_promises);
  return broken_promises > 0;
}
