#!/bin/sh
# Stands for a test that lacks what it needs: skip.sh REASON
echo "SKIPPED: $1"
if [ -n "${VORPIPE_SKIPPED-}" ]; then printf '%s\t\t%s\n' "$VORPIPE_TEST_NAME" "$1" >>"$VORPIPE_SKIPPED"; fi
exit 77
