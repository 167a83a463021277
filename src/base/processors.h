/// Function multiversioning: one version for each instruction set, selected when the program starts. Results
/// are identical to the bit, since only std::fma fuses products and sums (-ffp-contract=off).
#pragma once

// The resolvers would run before the thread sanitizer is initialized. Clang 14 calls clones by a name that
// other source files do not see: its programs use only the default.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_THREAD__) && !defined(__clang__)
/// For loops that are vectorized: by four doubles with AVX2, by eight with AVX-512.
#define FOR_WIDE_TOO __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
/// For std::fma, which without the instruction is a library call.
#define FOR_FUSED_TOO __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define FOR_WIDE_TOO
#define FOR_FUSED_TOO
#endif
