#pragma once

#include "uncertainty_identification/model/block.h"

// All functions on vectors are inlined, so vectors are never passed in calls and the warning about
// their ABI does not apply.
#pragma GCC diagnostic ignored "-Wpsabi"

/// Vector arithmetic on one sample of a block (used inside src/model only).
namespace uncertainty_identification {

/// Half of a sample's lanes as a vector type of GCC and clang. It reads and writes the memory of
/// Signals, whatever its alignment.
typedef double HalfPack
    __attribute__((vector_size(sizeof(double) * kLanes / 2), aligned(8), may_alias));

#define UI_INLINE inline __attribute__((always_inline))

/// One sample of all lanes, in two vectors: one as wide as eight lanes would go through memory with
/// each operation where registers hold four.
struct Pack {
  HalfPack low, high;

  UI_INLINE Pack& operator+=(const Pack& other) {
    low += other.low;
    high += other.high;
    return *this;
  }
  UI_INLINE Pack& operator-=(const Pack& other) {
    low -= other.low;
    high -= other.high;
    return *this;
  }
};

UI_INLINE Pack operator+(const Pack& l, const Pack& r) { return {l.low + r.low, l.high + r.high}; }
UI_INLINE Pack operator-(const Pack& l, const Pack& r) { return {l.low - r.low, l.high - r.high}; }
UI_INLINE Pack operator*(const Pack& l, const Pack& r) { return {l.low * r.low, l.high * r.high}; }
UI_INLINE Pack operator*(double l, const Pack& r) { return {l * r.low, l * r.high}; }

inline const Pack* packs(const Signals& signals) {
  return reinterpret_cast<const Pack*>(signals.data());
}
inline Pack* packs(Signals* signals) { return reinterpret_cast<Pack*>(signals->data()); }

}  // namespace uncertainty_identification

/// Compiles a kernel for several vector units and selects the widest available one at run time. So
/// default builds need no architecture flags, which would change Eigen's alignment and with it the
/// ABI. The targets are features, because names of architectures would only match processors of one
/// vendor.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define UI_VECTOR_CLONES __attribute__((target_clones("avx512f", "fma", "default")))
#else
#define UI_VECTOR_CLONES
#endif
