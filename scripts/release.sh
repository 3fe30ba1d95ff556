#!/usr/bin/env bash
# What has to hold before a release: `scripts/release.sh VERSION`, in a clean checkout.
set -euo pipefail
cd "$(dirname "$0")/.."
version=${1:?"usage: scripts/release.sh VERSION, such as 0.3.0"}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

say() { printf '\n== %s\n' "$1"; }

say "the version is the same everywhere, and the tree is clean"
grep -qx "version = \"$version\"" pyproject.toml
grep -qx "version: $version" CITATION.cff
grep -q "^## $version" CHANGELOG.md
test -z "$(git status --porcelain)"

say "the two commands of the README, in a fresh clone"
git clone -q . "$folder/clone"
make -C "$folder/clone" run
make -C "$folder/clone" test

say "wheel and sdist, each in an environment of its own"
"$folder/clone/.venv/bin/python" -m build --outdir "$folder/dist" "$folder/clone"
for file in "$folder"/dist/*; do
  environment="$folder/$(basename "$file").env"
  python3 -m venv "$environment"
  "$environment/bin/pip" install --quiet "$file"
  (cd "$folder" && "$environment/bin/undulator" run --surface gelatin --out "$folder/videos")
done

say "CITATION.cff is valid"
python3 -m venv "$folder/cff"
"$folder/cff/bin/pip" install --quiet cffconvert
"$folder/cff/bin/cffconvert" --validate --infile CITATION.cff

say "everything that CI runs"
make check
say "done: tag v$version, upload $version, and say in CHANGELOG.md what changed"
