#!/bin/sh
# Rules of the tree that no compiler checks: what includes what, unique file names, licence lines, layout, what the
# programs link. SPDX-License-Identifier: BSD-3-Clause
b=$(cd "${1:-build}" && pwd)
cd "$(dirname "$0")/.." || exit 1
failed=0
bad() { echo "FAIL: $*"; failed=$((failed + 1)); }

found=$(grep -n '#include "\.\./' common/*.[ch] 2>/dev/null) && bad "common/ includes of its siblings: $found"
found=$(grep -n '#include "\(\.\./\)*\(sph\|fv\|coupler\|tests\)/' $(find sph fv coupler -name '*.[ch]') | grep -v '"\(\.\./\)*coupler/cpl\(_partner\)\?\.h"')
[ -z "$found" ] || bad "programs may share cpl.h and common/ only: $found"
found=$(grep -l 'coupler/cpl\.h' $(find sph fv -name '*.c') | grep -v '_coupling\.c')
[ -z "$found" ] || bad "only X_coupling.c knows cpl.h: $found"
found=$(grep -n 'common/' coupler/cpl.h coupler/client/*.[ch] coupler/transport/*.[ch] | grep '#include')
[ -z "$found" ] || bad "libcpl depends on MPI alone: $found"
# folders of the coupler from below: cpl.h, transport and mapping know no other; client and server not each other
found=$(grep -n '#include "\.\./\(client\|server\|mapping\|transport\|coupler\)' coupler/transport/*.[ch] coupler/mapping/*.[ch]
    grep -n '#include "\.\./\(server\|mapping\)' coupler/client/*.[ch]
    grep -n '#include "\.\./client' coupler/server/*.[ch])
[ -z "$found" ] || bad "folders of the coupler: $found"
found=$(find sph fv coupler common -name '*.[ch]' | sed 's,.*/,,' | sort | uniq -d)
[ -z "$found" ] || bad "file names twice in the tree: $found"
found=$(grep -oE '^struct [a-z_0-9]+ \{' $(find sph fv coupler common -name '*.[ch]') | awk -F '[: ]' '
    $3 in at { print $3 " of " at[$3] " and " $1 } { at[$3] = $1 }')
[ -z "$found" ] || bad "struct tags twice in the tree: $found"
# members of a program's state: what three folders or more use; what fewer use is a struct of its owner's
members() { # PROGRAM: how many names struct PROGRAM declares
    awk -v begin="^struct $1 [{]" '$0 ~ begin { on = 1; next } on && /^}/ { on = 0 } on' "$1/$1.h" | tr '\n' ' ' |
        sed 's,/\*,\n&,g; s,\*/,&\n,g' | grep -v '^/\*' | tr -d '\n' | sed 's/\[[^]]*\]//g; s/)([^)]*)/)/g' | tr -cd ';,' | wc -c
}
for limit in fv:50 sph:45; do
    found=$(members ${limit%:*})
    [ "$found" -gt 9 ] && [ "$found" -le ${limit#*:} ] || bad "struct ${limit%:*} has $found members, at most ${limit#*:}: let the folder that uses them own them"
done
# Folders of a program from the lowest layer to the highest; "." is its state, the headers beside the main program
layers_fv="grid . boundary surface operators poisson watch time coupling output case"
layers_sph=". rigid particles pairs parallel walls surface open_boundaries bodies refinement watch time coupling output case"
# What still runs upward or in a circle: the state of sph holds particles and watches by value; walls and
# bodies would have to be split from what they fill, push and check
known="sph/sph.h sph/particles/particles.h
sph/sph.h sph/watch/sph_watch.h
sph/pairs/scheme_gradients.c sph/surface/sph_surface.h
sph/walls/walls.c sph/walls/forces.h"
includes() { # PROGRAM: lines "file included" within it
    grep -H '^#include "' $(find "$1" -name '*.[ch]') | awk -v top="$1/" -v known="$known" '
        BEGIN { n = split(known, k, "\n"); for (i = 1; i <= n; i++) skip[k[i]] = 1 }
        { split($0, part, ":"); split($0, quoted, "\""); dir = part[1]; to = quoted[2]; sub("/[^/]*$", "", dir)
          while (to ~ /^\.\.\//) { sub("^../", "", to); sub("/?[^/]*$", "", dir) }
          to = (dir == "" ? "" : dir "/") to
          if (index(to, top) == 1 && !((part[1] " " to) in skip)) print part[1], to }'
}
for s in fv sph; do
    eval "layers=\$layers_$s"
    found=$(includes $s | awk -v layers="$layers" '
        function layer(f, p) { return split(f, p, "/") == 3 ? at[p[2]] : f ~ /c$/ ? 99 : at["."] }
        BEGIN { n = split(layers, l, " "); for (i = 1; i <= n; i++) at[l[i]] = i }
        !layer($1) || !layer($2) { print $1 ": in no layer of tests/style.sh" }
        layer($2) > layer($1) { print $1 " includes " $2 " of a layer above" }')
    [ -z "$found" ] || bad "$found"
    # X.c and X.h are one here; the main program includes what it likes
    found=$(includes $s | sed "/^$s\/[a-z_]*\.c /d; s/\.[ch]//g" | awk '$1 != $2' | tsort 2>&1 >/dev/null | sed 's/tsort: //')
    [ -z "$found" ] || bad "includes in a circle: $found"
done
# One header of a folder is its door: no other folder includes more than it. The state of sph holds particles by
# value, and the pairs of two levels are compiled from the loops of one
found=$(grep -H '^#include "' $(find sph fv coupler common -mindepth 2 -name '*.[ch]') sph/*.[ch] fv/*.[ch] | awk '
    { split($0, part, ":"); split($0, quoted, "\""); dir = part[1]; sub("/[^/]*$", "", dir); at = dir; to = quoted[2]
      while (to ~ /^\.\.\//) { sub("^../", "", to); sub("/?[^/]*$", "", dir) }
      to = (dir == "" ? "" : dir "/") to; of = to; sub("/[^/]*$", "", of)
      if (of == at || of !~ /\// || (part[1] == "sph/sph.h" && to == "sph/particles/particles.h") ||
          (part[1] == "sph/refinement/mixed_pairs.c" && to == "sph/pairs/riemann_loops.h")) next
      if (!(of in door)) door[of] = to
      else if (door[of] != to) print part[1] " includes " to ", others of that folder " door[of] }')
[ -z "$found" ] || bad "folders with two doors: $found"
# what criteria of cases may name is one list
for name in $(grep -rhoE '"error\.[a-z_0-9]+"' --include='*.c' sph fv coupler common | sort -u); do
    grep -q "^ .*$name" common/run/accept.c || bad "$name is missing in the list of common/run/accept.c"
done
for name in $(grep -rhoE 'summary_(real|int|bool|text|texts)\([^,]+, *(key_text\()?"[a-zA-Z_0-9]+' --include='*.c' sph fv common | sed 's/.*"//' | sort -u); do
    grep -qE "^ .*\"$name\"" common/run/accept.c || bad "$name is missing in the first words of common/run/accept.c"
done
found=$(python3 tests/includes.py) || found=${found:-tests/includes.py failed}
[ -z "$found" ] || bad "$found"
found=$(find sph fv coupler common tests -name '*.[ch]' -exec grep -L 'SPDX-License-Identifier: BSD-3-Clause' {} +)
[ -z "$found" ] || bad "no licence line: $found"
found=$(ldd "$b/sph" "$b/coupler" | grep -i -E 'hypre|sundials')
[ -z "$found" ] || bad "sph and coupler link what they do not use: $found"
cases/parameters "$b" | cmp -s - cases/parameters.md || bad "cases/parameters.md is older than the tables: cases/parameters >cases/parameters.md"
if command -v clang-format >/dev/null && clang-format --version | grep -q ' 14\.'; then
    # what the last hundred commits have touched and what is not committed yet; with LONG=1, or without git, all
    recent=$([ -n "$LONG" ] || { git diff --name-only HEAD -- '*.[ch]' && git log -100 --name-only --format= -- '*.[ch]'; } 2>/dev/null | sort -u)
    found=$(clang-format --dry-run -Werror $(ls -d ${recent:-$(find sph fv coupler common tests -name '*.[ch]')} 2>/dev/null) 2>&1 | grep error: | head -n 3)
    [ -z "$found" ] || bad "layout, clang-format -i mends it: $found"
fi
[ $failed = 0 ] && echo "style: all rules kept"
[ $failed = 0 ]
