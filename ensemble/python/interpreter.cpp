// SPDX-License-Identifier: Apache-2.0
// sturz-python: Python with the module `_sturz` built in; otherwise /usr/bin/python3 in all
// respects.
#include <pybind11/embed.h>
#include <unistd.h>

#include <cstdlib>

// NOLINTNEXTLINE(bugprone-reserved-identifier): the name that Python gives it
extern "C" PyObject* PyInit__sturz();

int main(int argc, char** argv) {
  // As in `sturz`: waiting threads must sleep, and OpenMP reads that before main starts.
  if (!std::getenv("OMP_WAIT_POLICY") && setenv("OMP_WAIT_POLICY", "passive", 1) == 0)
    execv("/proc/self/exe", argv);
  PyImport_AppendInittab("_sturz", PyInit__sturz);
  return Py_BytesMain(argc, argv);
}
