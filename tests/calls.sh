#!/bin/sh
# Calls that run upward as the linker sees them: a name that a folder takes from a folder above it, although no include
# shows it; prototypes in the header of another folder; and exported names that two libraries define.
# usage: tests/calls.sh BUILD
# SPDX-License-Identifier: BSD-3-Clause
b=$(cd "${1:-build}" && pwd)
cd "$(dirname "$0")/.." || exit 1
export LC_ALL=C
failed=0
bad() { echo "FAIL: $*"; failed=$((failed + 1)); }

# Folders from the lowest floor to the highest, as in tests/style.sh; the main programs stand above all of them
layers_common="base params files geometry waves scene run"
layers_fv="grid boundary surface operators poisson watch time coupling output case"
layers_sph="rigid particles pairs parallel walls surface open_boundaries bodies refinement watch time coupling output case"

upward() { # PROGRAM LAYERS: lines "name caller owner", files without their ending
    (cd "$b/o" && nm -A "$1"/*/*.o) | awk -v layers="$2" '
        BEGIN { n = split(layers, l, " "); for (i = 1; i <= n; i++) at[l[i]] = i }
        { split($1, f, ":"); file = f[1]; sub(/\.o$/, "", file); split(file, d, "/"); kind = $(NF - 1); name = $NF
          if (!(d[2] in at)) { if (!told[d[2]]++) print "-", file, "in-no-floor-of-tests/calls.sh" }
          else if (kind ~ /^[TDBRVWC]$/) { has[name] = d[2]; owner[name] = file }
          else if (kind == "U") uses[name] = uses[name] " " file }
        END { for (name in has) { m = split(uses[name], u, " ")
                  for (i = 1; i <= m; i++) { split(u[i], d, "/")
                      if (at[has[name]] > at[d[2]]) print name, u[i], owner[name] } } }' | sort
}
# Prototypes in a header of another folder than the one that defines them; what the linker sees stays as it is
elsewhere() { # PROGRAM: lines "header name object"
    { (cd "$b/o" && nm -A "$1"/*/*.o) && grep -HE '^[a-z].*[ *][a-z_0-9]+\(' "$1"/*/*.h | grep -v ':static '; } | awk '
        { split($1, f, ":"); dir = f[1]; sub("/[^/]*$", "", dir) }
        f[1] ~ /o$/ { if ($(NF - 1) == "T") { at[$NF] = dir; object[$NF] = f[1] }; next }
        { sub(/\(.*/, ""); sub(/.*[ *]/, ""); if (($0 in at) && at[$0] != dir) print f[1], $0, object[$0] }'
}
for p in common fv sph coupler; do
    found=$(elsewhere $p | awk '{ print $1 " declares " $2 " of " $3 ", another folder" }')
    [ -z "$found" ] || bad "$found"
done
for p in common fv sph; do
    eval "layers=\$layers_$p"
    ls "$b/o/$p"/*/*.o >/dev/null 2>&1 || bad "$b/o/$p has no objects: build first"
    found=$(upward $p "$layers" | awk 'NF { print $2 " calls " $1 " of " $3 ", a folder above it" }')
    [ -z "$found" ] || bad "$found"
done

found=$(for a in sph fv common cpl; do
    nm -A "$b/lib$a.a" 2>/dev/null | awk -v a=lib$a.a '{ split($1, f, ":") } $(NF - 1) ~ /^[TDBRC]$/ { print $NF, a ":" f[2] }'
done | sort -u | awk '$1 == last { print $1 " is defined in " at " and in " $2 } { last = $1; at = $2 }')
[ -z "$found" ] || bad "exported names in two libraries: $found"
[ $failed = 0 ] && echo "calls: only downward"
[ $failed = 0 ]
