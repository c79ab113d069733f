#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the Debian package from build/release and tries it in a bare Debian 12 of its own: installs it
# with apt, runs it, looks at the results, the manual page and the completion, removes it again.
# Needs root and a Debian mirror (the one of this machine's apt is taken). Five to ten minutes, most
# of them downloads, and so no part of test.sh. Nothing stays behind but the package.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/packages.sh

[ "$(id -u)" -eq 0 ] || { echo "test_package.sh must run as root (it makes a chroot)." >&2; exit 1; }
[ -f build/release/CPackConfig.cmake ] ||
  { echo "build/release is not configured. Run ./quickstart.sh or ./test.sh first." >&2; exit 1; }
install_packages "${packaging_packages[@]}"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

echo "--- package"
cmake --build build/release --target sturz >"$work/build.log" 2>&1 ||
  { tail -n 30 "$work/build.log" >&2; exit 1; }
mkdir -p build/package
rm -f build/package/*.deb
(cd build/release && cpack -G DEB -B ../package) >"$work/cpack.log" ||
  { cat "$work/cpack.log" >&2; exit 1; }
package=$(echo build/package/*.deb)
dpkg-deb --field "$package" Package Version Architecture Section Maintainer Depends Installed-Size
version=$(sed -n 's/^project(sturz VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
[ "$(dpkg-deb --field "$package" Version)" = "$version" ] ||
  { echo "The package's version is not the project's ($version)." >&2; exit 1; }

# What the package must give again: the members' state hashes, the last column of the table.
build/release/ensemble/app/sturz ensemble scenarios/cases/zhangjiawan/scenario.yaml -n 4 \
  -o "$work/here" >"$work/here.log" 2>&1 || { cat "$work/here.log" >&2; exit 1; }
sed 's/.*,//' "$work/here/members.csv" >"$work/expected"

# What runs inside. Every line that fails ends the test.
cat >"$work/inside.sh" <<'INSIDE'
set -eux
export DEBIAN_FRONTEND=noninteractive
cd "$(dirname "$0")"
apt-get -q -y install --no-install-recommends ./sturz.deb >apt.log 2>&1 || { cat apt.log; exit 1; }
sturz --version | grep -F "sturz $VERSION ("
sturz cases
sturz cases zhangjiawan
sturz describe zhangjiawan/scenario.yaml
sturz ensemble zhangjiawan/scenario.yaml -n 4 -o results
for file in hazard.nc report.html members.csv manifest.json; do test -s "results/$file"; done
test "$(ls results/members/*.nc | wc -l)" -eq 4
test "$(grep -c ',settled,\|,left_terrain,\|,out_of_time,' results/members.csv)" -eq 4
# The same bits as the program has in its build folder.
sed 's/.*,//' results/members.csv | diff expected -
if ldd "$(command -v sturz)" | grep 'not found'; then exit 1; fi
# The BLAS that the package asks for is the one that is used.
readlink -f /etc/alternatives/libblas.so.3-x86_64-linux-gnu | grep openblas-pthread
bash -c 'source /usr/share/bash-completion/completions/sturz; complete -p sturz
         COMP_WORDS=(sturz cases z); COMP_CWORD=2; _sturz; test "${COMPREPLY[*]}" = zhangjiawan'
apt-get -q -y install --no-install-recommends man-db >apt.log 2>&1 || { cat apt.log; exit 1; }
man sturz >page; grep -F -e --retry-failed page
test -s /usr/share/doc/sturz/copyright
test -s /usr/share/doc/sturz/docs/user_guide.md
apt-get -q -y purge sturz >apt.log 2>&1
test ! -e /usr/share/sturz
test ! -e /usr/bin/sturz
INSIDE

# Debian's own lines of this machine's sources, whatever the mirror is called.
apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Identifier: Packages' \
    'Origin: Debian' | grep ' bookworm' >"$work/sources.list" ||
  { echo "apt on this machine knows no Debian 12 (bookworm) mirror." >&2; exit 1; }

echo "--- bare Debian 12"
cp "$package" "$work/sturz.deb"
mmdebstrap --quiet --variant=apt --format=null --aptopt='Acquire::Check-Valid-Until "false"' \
  --customize-hook='mkdir "$1/opt/try"' \
  --customize-hook="copy-in $work/sturz.deb $work/inside.sh $work/expected /opt/try" \
  --customize-hook="chroot \"\$1\" env VERSION=$version sh /opt/try/inside.sh" \
  bookworm - - <"$work/sources.list"
echo "The package $package installs, runs and goes away on a bare Debian 12."
