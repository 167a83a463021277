/// What a program leaves behind where it cannot go on: a line that says so, and no file that is unfinished.
#pragma once

#include <exception>

namespace vorpipe::cli {

/// Opens what of standard input, output and error is closed, so that no file of a run gets its number: what
/// is written there is lost, or an error, and never in a file of results.
void openStandardStreams();

/// Tells of an exception that nothing has taken, in one line.
void printUncaught(const std::exception& error);

/// From now on the program ends with this code, where something is thrown that nothing can take: where memory
/// is refused to destructors of some libraries, or a thread to one that runs beside others.
void endOnUncaught(int code);

/// From now on, where a file that is mapped is cut off while it is in use, or its disk fails, the program
/// ends with this code.
void endOnLostPages(int code);

/// From now on, where the X server of a window goes away, the program ends with this code. Xlib's own way is
/// to say so in words of its own and to end it with 1.
void endOnLostDisplay(int code);

}  // namespace vorpipe::cli
