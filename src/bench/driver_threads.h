/// Variables of the environment that set the threads and lanes of software drivers.
#pragma once

namespace vorpipe {

/// Sets how many threads Mesa's software drivers use in devices that are opened from now on: one for each of
/// `processors` processors; 0: for all. Where LP_NATIVE_VECTOR_WIDTH sets their lanes, keeps them from their
/// cache. It sets variables of the environment, the drivers' only way to be told, unless the user has. That
/// is for a program to do, while none of its threads reads the environment, and not for the library.
void setDriverThreads(int processors);

}  // namespace vorpipe
