#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes every study of docs/studies again; --list, --only NAME, --older, --data FOLDER, --help: scripts/studies.py says more.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/packages.sh
case " $* " in
  *" --list "* | *" --table "* | *" --check "* | *" --help "* | *" -h "*) ;;
  *)
    install_packages "${study_packages[@]}"
    [ -x build/release/ensemble/app/sturz ] && [ -x build/release/tests/bench/sturz_bench ] || {
      echo "build/release has no program or no tests yet." \
           "Build them: cmake --preset release -DSTURZ_TESTS=ON && cmake --build build/release" >&2
      exit 1
    }
    ;;
esac
exec /usr/bin/python3 scripts/studies.py "$@"
