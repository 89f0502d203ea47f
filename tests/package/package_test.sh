#!/usr/bin/env bash
# package_test.sh BUILD CPACK: makes the Debian package of a build, installs it below a scratch root with a separate dpkg
# database, runs the installed program, removes it, and checks that nothing is left. The machine's own packages are not touched.
set -euo pipefail
build=$1
cpack=$2

skip() { echo "skipped: $1"; exit 77; }
fail() { echo "FAILED: $1"; exit 1; }
command -v dpkg-shlibdeps > /dev/null || skip "no dpkg-shlibdeps (Debian: dpkg-dev)"
[ "$(id -u)" -eq 0 ] || skip "only root may install"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
root=$scratch/root
mkdir -p "$root" "$scratch/dpkg/updates" "$scratch/dpkg/info"
touch "$scratch/dpkg/status" "$scratch/dpkg/available"
# The dependencies are looked up in the machine's own database instead.
own_dpkg() { dpkg --admindir="$scratch/dpkg" --instdir="$root" --force-depends --log=/dev/null "$@"; }

echo "== make =="
"$cpack" -G DEB --config "$build/CPackConfig.cmake" -B "$scratch" > "$scratch/cpack.log" 2>&1 || { cat "$scratch/cpack.log"; fail "cpack"; }
package=$(ls "$scratch"/sunfleck_*.deb)
dpkg-deb --info "$package"

echo "== dependencies =="
depends=$(dpkg-deb --field "$package" Depends)
# Lists installed packages by name, and what they provide.
there=$(dpkg-query -W -f '${db:Status-Status} ${Package} ${Provides}\n' | sed -n 's/^installed //p' | sed 's/([^)]*)//g' | tr -s ', ' '\n')
for needed in $(echo "$depends" | tr ',' '\n' | sed 's/|.*//; s/(.*//'); do
  grep -qxF "$needed" <<< "$there" || fail "depends on $needed, which is not installed"
done
for needed in libc6 libhwy1 libtbb12 libnetcdf19 libvulkan1; do
  echo "$depends" | grep -q "$needed" || fail "$needed is no dependency: $depends"
done

echo "== install =="
own_dpkg -i "$package"
for file in bin/sunfleck share/sunfleck/scenes/maize_sparse.toml share/sunfleck/plots/profile.gp share/doc/sunfleck/README.md share/doc/sunfleck/copyright; do
  [ -f "$root/usr/$file" ] || fail "usr/$file is not installed"
done
[ -z "$(find "$root" -type f -path '*local*')" ] || fail "files below usr/local"
file "$root/usr/bin/sunfleck" | grep -q 'stripped' || fail "not stripped"

echo "== run =="
program=$root/usr/bin/sunfleck
"$program" --version
"$program" run "$root/usr/share/sunfleck/scenes/two_squares.toml" -o "$scratch/results" --device cpu --grid 0.05 --images profile --quiet
if command -v gnuplot > /dev/null; then
  [ -s "$scratch/results/profile.png" ] || fail "no profile.png"
  # The installed script draws, not the one of the source tree.
  echo "print no_such_variable" > "$root/usr/share/sunfleck/plots/profile.gp"
  "$program" run "$root/usr/share/sunfleck/scenes/two_squares.toml" -o "$scratch/results" --device cpu --grid 0.05 --images profile --quiet 2> "$scratch/warning"
  grep -q no_such_variable "$scratch/warning" || fail "the installed profile.gp is not used"
fi
grep -q '"complete": true' "$scratch/results/summary.json" || fail "the run is not complete"
module=$(find "$root/usr/lib" -name '_core*.so' -path '*sunfleck*')
if [ -n "$module" ]; then
  PYTHONPATH=$(dirname "$(dirname "$module")") /usr/bin/python3 -B -c "import sunfleck; print(sunfleck.__file__, sunfleck.sky('uniform').spherical_irradiance)"
fi

echo "== remove =="
own_dpkg --purge sunfleck
left=$(find "$root" -type f -o -type l)
[ -z "$left" ] || fail "left behind: $left"
echo "nothing is left"
