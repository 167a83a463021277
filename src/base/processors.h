/// Function multiversioning: one version for each instruction set, selected when the program starts. Results
/// are the same to the bit, since products and sums are fused by std::fma alone (-ffp-contract=off).
#pragma once

// The resolvers would run before the thread sanitizer is initialized.
// Clang 14 calls clones by a name that other sources do not know: its programs have the default alone.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_THREAD__) && !defined(__clang__)
/// For loops that are vectorized: by four doubles with AVX2, by eight with AVX-512.
#define FOR_WIDE_TOO __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
/// For std::fma, which without the instruction is a library call.
#define FOR_FUSED_TOO __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define FOR_WIDE_TOO
#define FOR_FUSED_TOO
#endif
