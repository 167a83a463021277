/// Functions in several versions, of which a program takes the one for its processor as it starts. The
/// results are the same to the bit, since no product and sum are ever fused but by std::fma.
#pragma once

// The thread sanitizer is not ready yet when such versions are chosen.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_THREAD__)
/// For loops that compilers turn into vectors, of four or eight doubles where there are such.
#define FOR_WIDE_TOO __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
/// For std::fma, which else is a call.
#define FOR_FUSED_TOO __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define FOR_WIDE_TOO
#define FOR_FUSED_TOO
#endif
