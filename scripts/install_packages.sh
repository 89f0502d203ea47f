#!/usr/bin/env bash
# Installs those packages of packages.txt that are missing: scripts/install_packages.sh run|test|full
# "run" stands for the packages that the program needs, "test" adds those of its tests, and "full" those of its longest checks.
# Asks no questions, and does nothing if nothing is missing.
set -euo pipefail
list="$(dirname "${BASH_SOURCE[0]}")/packages.txt"

fail() {
  echo "$1" >&2
  exit 1
}

purpose="${1:-}"
case "$purpose" in
  run) wanted=$(awk '$1 == "run" { print $2 }' "$list") ;;
  test) wanted=$(awk '$1 == "run" || $1 == "test" { print $2 }' "$list") ;;
  full) wanted=$(awk '$1 == "run" || $1 == "test" || $1 == "full" { print $2 }' "$list") ;;
  *) echo "install_packages.sh: '$purpose' (must be run, test or full); say what the packages are for" >&2; exit 2 ;;
esac

command -v dpkg-query > /dev/null ||
  fail "packages: no dpkg-query (not a Debian system); install what $list names, then build with cmake"

missing=()
for package in $wanted; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi

# sudo may ask for a password at a terminal; it never waits for one elsewhere.
if [ "$(id -u)" -eq 0 ]; then
  as_root=()
elif command -v sudo > /dev/null && { sudo -n true 2> /dev/null || { [ -t 0 ] && sudo -v; }; }; then
  as_root=(sudo)
else
  fail "packages: ${missing[*]} (missing, and neither root nor sudo at hand); run as root: apt-get install ${missing[*]}"
fi

echo "Installing ${missing[*]}"
get=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300)
"${get[@]}" update
"${get[@]}" install --no-install-recommends "${missing[@]}"
