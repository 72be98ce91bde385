#!/bin/sh
# Rules of the tree that no compiler checks: what includes what, unique file names, licence lines, layout, what the
# programs link. SPDX-License-Identifier: BSD-3-Clause
b=$(cd "${1:-build}" && pwd)
cd "$(dirname "$0")/.." || exit 1
failed=0
bad() { echo "FAIL: $*"; failed=$((failed + 1)); }

found=$(grep -n '#include "\.\./' common/*.[ch]) && bad "common/ includes of its siblings: $found"
found=$(grep -n '#include "\.\./' sph/*.[ch] fv/*.[ch] coupler/*.[ch] | grep -v '"\.\./common/' | grep -v '"\.\./coupler/cpl\(_partner\)\?\.h"')
[ -z "$found" ] || bad "programs may share cpl.h and common/ only: $found"
found=$(grep -l 'coupler/cpl\.h' sph/*.c fv/*.c | grep -v '_coupling\.c')
[ -z "$found" ] || bad "only X_coupling.c knows cpl.h: $found"
found=$(grep -l '"\.\./common/' coupler/cpl_client.c coupler/cpl_data.c coupler/cpl_patch.c coupler/wire.c coupler/alive.c coupler/failure.c coupler/handshake.c coupler/region.c)
[ -z "$found" ] || bad "libcpl depends on MPI alone: $found"
found=$(ls sph fv coupler common | grep '\.[ch]$' | sort | uniq -d)
[ -z "$found" ] || bad "file names twice in the tree: $found"
for f in sph/*.[ch] fv/*.[ch] coupler/*.[ch] common/*.[ch] tests/*.[ch]; do
    grep -q 'SPDX-License-Identifier: BSD-3-Clause' "$f" || bad "$f has no licence line"
done
found=$(ldd "$b/sph" "$b/coupler" | grep -i -E 'hypre|sundials')
[ -z "$found" ] || bad "sph and coupler link what they do not use: $found"
if command -v clang-format >/dev/null && clang-format --version | grep -q ' 14\.'; then
    clang-format --dry-run -Werror sph/*.[ch] fv/*.[ch] coupler/*.[ch] common/*.[ch] tests/*.[ch] 2>out.txt ||
        bad "layout: $(grep -c error: out.txt) places, clang-format -i mends them: $(head -n 3 out.txt)"
    rm -f out.txt
fi
[ $failed = 0 ] && echo "style: all rules kept"
[ $failed = 0 ]
