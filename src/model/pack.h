#pragma once

#include "uncertainty_identification/model/block.h"

// functions on vectors are all inlined into one clone, so that no vector crosses a call
#pragma GCC diagnostic ignored "-Wpsabi"

/// Vector arithmetic on one sample of a block (private to src/).
namespace uncertainty_identification {

/// One sample of all lanes as a GCC/clang vector; reads and writes Signals' memory, whatever its
/// alignment.
typedef double Pack __attribute__((vector_size(sizeof(double) * kLanes), aligned(8), may_alias));

inline const Pack* packs(const Signals& signals) {
  return reinterpret_cast<const Pack*>(signals.data());
}
inline Pack* packs(Signals* signals) { return reinterpret_cast<Pack*>(signals->data()); }

}  // namespace uncertainty_identification

/// Compiles a kernel several times and picks the widest vector unit at run time, so that default
/// builds carry no architecture flags (which would change Eigen's alignment and with it the ABI).
/// By features: names of architectures would match the CPUs of one vendor only.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define UI_VECTOR_CLONES __attribute__((target_clones("avx512f", "fma", "default")))
#else
#define UI_VECTOR_CLONES
#endif
