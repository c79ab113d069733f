// SPDX-License-Identifier: Apache-2.0
// sturz-python: Python with the module `_sturz` built in and the package `sturz` on its path;
// otherwise Debian's python3 in all respects.
#include <pybind11/embed.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

// NOLINTNEXTLINE(bugprone-reserved-identifier): the name that Python gives it
extern "C" PyObject* PyInit__sturz();

namespace {

/// The package beside this program, in a build folder or below a prefix, is found first.
void put_package_on_path() {
  std::error_code none;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
  for (const auto& folder : {here, here.parent_path() / "lib/python3/dist-packages"}) {
    if (!std::filesystem::exists(folder / "sturz/__init__.py", none)) continue;
    const char* const others = std::getenv("PYTHONPATH");
    std::string path = folder.string();
    if (others != nullptr) path.append(":").append(others);
    setenv("PYTHONPATH", path.c_str(), 1);
    return;
  }
}

}  // namespace

int main(int argc, char** argv) {
  // As in `sturz`: waiting threads must sleep, and OpenMP reads that before main starts.
  if (!std::getenv("OMP_WAIT_POLICY") && setenv("OMP_WAIT_POLICY", "passive", 1) == 0)
    execv("/proc/self/exe", argv);
  put_package_on_path();
  PyImport_AppendInittab("_sturz", PyInit__sturz);
  return Py_BytesMain(argc, argv);
}
