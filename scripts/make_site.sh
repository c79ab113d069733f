#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the documentation site from the repository's Markdown into build/site, offline; open build/site/index.html.
# Warnings (a page that is not linked, a link that leads nowhere) are errors. --serve shows it on http://localhost:8000.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/packages.sh
install_packages "${site_packages[@]}"
out=${STURZ_SITE:-build/site}
sphinx-build -q -W --keep-going -j auto -c docs/site -d "$out.doctrees" . "$out"
cat > "$out/index.html" <<'HTML'
<!doctype html><meta charset="utf-8"><meta http-equiv="refresh" content="0; url=docs/site/index.html"><a href="docs/site/index.html">sturz</a>
HTML
echo "Site: $out/index.html"
if [ "${1:-}" = --serve ]; then exec python3 -m http.server --bind 127.0.0.1 --directory "$out" 8000; fi
