# SPDX-License-Identifier: Apache-2.0
# Debian 12 packages, kept in one place; sourced by quickstart.sh, test.sh and the scripts of this folder.
# libopenblas0-pthread stands beside libopenturns-dev on purpose: alone, OpenTURNS pulls ATLAS in
# and makes it the BLAS of the whole machine.

build_packages=(
  g++ cmake ninja-build ccache mold pkg-config git ca-certificates python3
  libgdal-dev libnetcdf-dev libhdf5-dev libtbb-dev libeigen3-dev libyaml-cpp-dev libspdlog-dev libfmt-dev
  zlib1g-dev libcli11-dev libcpp-httplib-dev nlohmann-json3-dev pybind11-dev python3-dev libssl-dev libutfcpp-dev librandom123-dev libopenturns-dev libopenblas0-pthread
)
test_packages=(
  clang-format clang-tidy clang libclang-rt-14-dev libomp-14-dev llvm
  libgtest-dev libgmock-dev python3-numpy python3-xarray python3-netcdf4 python3-geopandas python3-yaml gdal-bin netcdf-bin
  python3-sphinx python3-myst-parser furo python3-matplotlib
  qgis python3-qgis
  chromium man-db slurmctld slurmd slurm-client munge parallel snakemake
)
# For scripts/make_studies.sh and scripts/make_pictures.sh, and for scripts/make_site.sh.
study_packages=(python3-numpy python3-netcdf4 python3-gdal python3-matplotlib)
site_packages=(python3-sphinx python3-myst-parser furo)
# For scripts/test_package.sh only.
packaging_packages=(dpkg-dev mmdebstrap)

# missing_packages NAME...: those that dpkg does not know as installed.
missing_packages() {
  local name
  for name in "$@"; do
    dpkg-query -W -f='${Status}\n' "$name" 2>/dev/null | grep -q '^install ok installed$' ||
      printf '%s\n' "$name"
  done
}

# install_packages NAME...: one apt line for what is missing, nothing when all is there.
install_packages() {
  local missing sudo=()
  mapfile -t missing < <(missing_packages "$@")
  if [ "${#missing[@]}" -eq 0 ]; then
    echo "Packages: all ${#} are installed."
    return 0
  fi
  command -v apt-get >/dev/null ||
    { echo "These packages are missing and apt-get is not here: ${missing[*]}." \
           "Install their like by hand." >&2; return 1; }
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      { echo "Packages are missing (${missing[*]}) and neither root nor sudo is at hand." \
             "Run once as root." >&2; return 1; }
    sudo=(sudo)
  fi
  echo "Packages: installing ${#missing[@]} (${missing[*]})"
  "${sudo[@]}" apt-get update -q -y >/dev/null ||
    { echo "apt-get update failed: is the network up?" >&2; return 1; }
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends \
      "${missing[@]}" >/dev/null ||
    { echo "apt-get install failed; its message stands above." >&2; return 1; }
}

# install_node: the page's scripts are bundled with node and npm. Without them the build still
# works and reports keep static figures, so this never fails.
install_node() {
  command -v node >/dev/null && command -v npm >/dev/null && return 0
  install_packages nodejs npm ||
    echo "node and npm are not available: the report page will show static figures." >&2
  return 0
}
