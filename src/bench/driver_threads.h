/// Environment variables that set the threads and lanes of software drivers.
#pragma once

namespace vorpipe {

/// Sets how many threads Mesa's software drivers use in devices that are opened from now on: one for each of
/// `processors` processors; 0: for all. Where LP_NATIVE_VECTOR_WIDTH sets their lanes, disables their cache.
/// It sets environment variables, the drivers' only interface for this, unless the user has. Only a program
/// may do that, while none of its threads reads the environment; the library must not.
void setDriverThreads(int processors);

}  // namespace vorpipe
