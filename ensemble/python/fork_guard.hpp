// SPDX-License-Identifier: Apache-2.0
/// What a child made by fork() without exec may still compute, as of multiprocessing's "fork". Of
/// the parent's threads it has the one that forked: an OpenMP team that waits for the others, and a
/// lock that one of them held, would wait for ever.
#pragma once

namespace sturz::python {

/// Called once, when the module is loaded.
void watch_forks();

/// Threads of a member in this process: in a forked child one, whatever was wanted.
int threads_here(int wanted);

/// Around each member. \throws std::runtime_error in a child that was forked while a member was
/// computed, since what was locked then is not known
class Computing {
 public:
  Computing();
  ~Computing();
  Computing(const Computing&) = delete;
  Computing& operator=(const Computing&) = delete;
};

/// As the constructor above.
void require_whole_process();

}  // namespace sturz::python
