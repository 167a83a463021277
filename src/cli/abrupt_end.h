/// How a program ends when it cannot continue: it prints one line, and leaves no unfinished file.
#pragma once

#include <exception>

namespace vorpipe::cli {

/// Opens whichever of standard input, output and error is closed, so that no file of a run gets its
/// descriptor. Output to it is then lost or an error, but never lands in a result file.
void openStandardStreams();

/// Prints an uncaught exception, in one line.
void printUncaught(const std::exception& error);

/// From now on, the program ends with this code on an exception that nothing can catch. Causes: a destructor
/// of some libraries gets no memory, or a concurrent thread cannot start another.
void endOnUncaught(int code);

/// From now on, the program ends with this code if a mapped file is truncated while in use, or its disk
/// fails.
void endOnLostPages(int code);

/// From now on, the program ends with this code if a window loses its X server. Xlib by itself would print
/// its own message and exit with 1.
void endOnLostDisplay(int code);

}  // namespace vorpipe::cli
