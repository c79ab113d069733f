// SPDX-License-Identifier: Apache-2.0
/// Tells whether the thread sanitizer watches this build.
#pragma once

namespace sturz::test {

#if defined(__SANITIZE_THREAD__)
inline constexpr bool under_thread_sanitizer = true;
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
inline constexpr bool under_thread_sanitizer = true;
#else
inline constexpr bool under_thread_sanitizer = false;
#endif
#else
inline constexpr bool under_thread_sanitizer = false;
#endif

/// The packaged TBB is not instrumented: the sanitizer would report races that are none.
inline constexpr const char* skip_tbb = "TBB is not instrumented; the plain threads are tested";

}  // namespace sturz::test
