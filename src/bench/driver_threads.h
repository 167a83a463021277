/// How many threads a driver without a GPU uses.
#pragma once

namespace vorpipe {

/// Has Mesa's software drivers keep so many processors busy in devices that are opened from now on; 0: all of
/// them. It sets a variable of the environment, the drivers' only way to be told, unless the user has. That
/// is for a program to do, while none of its threads reads the environment, and not for the library.
void setDriverThreads(int processors);

}  // namespace vorpipe
