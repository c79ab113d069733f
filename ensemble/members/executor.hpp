// SPDX-License-Identifier: Apache-2.0
/// Runs independent pieces of work on several threads; hides which thread library does it.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>

namespace sturz {

class Executor {
 public:
  virtual ~Executor() = default;
  virtual int workers() const = 0;
  /// Calls body(0), ..., body(n - 1), each once. Pieces begin in ascending order: a free worker
  /// takes the next one, whatever the others still do. Once `stop` is set no piece begins any
  /// more; those that run are waited for. The first exception of a body acts like `stop` and is
  /// thrown again here.
  virtual void for_each(std::size_t n, const std::atomic<bool>& stop,
                        const std::function<void(std::size_t)>& body) = 0;
};

/// `plain` is std::thread: the thread sanitizer understands it, but not the packaged TBB.
enum class ThreadLibrary { tbb, plain };

/// \param workers >= 1; one worker runs everything on the calling thread
std::unique_ptr<Executor> make_executor(int workers, ThreadLibrary library = ThreadLibrary::tbb);

}  // namespace sturz
