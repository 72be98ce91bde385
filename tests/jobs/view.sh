#!/bin/sh
# view.py beside a run: what it knows of the scene, and the pieces of it that need no ParaView.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
cat >slope.cfg <<'EOF'
format = 1;
time:    { end = 0.01; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (-0.25, 0); max = (2, 1); };
initial: { field = "rest"; U = 1.0; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { points = ((1.0, 0), (2, 0.4)); } );
shapes:  ( { form = "box"; box = ((-0.25, 0), (0.5, 0.5)); } );
sph:     { dx = 0.05; };
EOF
timeout 60 "$b/sph" slope.cfg -o out >log.txt 2>&1 || { tail -n 3 log.txt; exit 1; }
# the scene drawn: labels of things at almost one place stand on lines of their own
{
    cat slope.cfg
    echo 'probes: ( { name = "first"; at = (0.2, 0.1); }, { name = "second"; at = (0.21, 0.1); }, { name = "third"; at = (0.22, 0.11); } );'
} >probes.cfg
timeout 60 "$b/sph" probes.cfg --check=picture -o drawn >log.txt 2>&1 || { tail -n 3 log.txt; exit 1; }
sed -n 's/^<text x="\([0-9.]*\)" y="\([0-9.]*\)" font-size="12">\(first\|second\|third\)<.*/\2/p' drawn/sph-scene.svg | sort -g |
    awk 'NR > 1 && $1 - last < 12 { print "labels " $1 - last " px apart"; bad = 1 } { last = $1 } END { exit bad || NR != 3 }' ||
    { echo "FAIL: labels of the picture stand on each other"; exit 1; }
# what drives the water along a period tilts neither its level, nor the view
sed 's/(0, -9.81)/(2, -9.81)/; s/max = (2, 1); /&periodic = (true, false); /
    s/^walls:.*/walls: ( { side = "y_min"; kind = "no_slip"; } );/; s/^shapes:.*/shapes: ( { form = "below"; level = 0.5; } );/' slope.cfg |
    sed 's/rho = 1000.0;/& nu = 1e-3;/' >driven.cfg
timeout 60 "$b/sph" driven.cfg -o driven >log.txt 2>&1 && timeout 60 "$b/sph" driven.cfg --check=picture -o even >log.txt 2>&1 || { tail -n 3 log.txt; exit 1; }
sed -n 's/^<path d="\(M.*\) Z" stroke="none".*#9ecae1.*/\1/p' even/sph-scene.svg | tr 'ML' '\n\n' | awk 'NF { y[$2]++ } END { for (k in y) n++; exit n != 2 }' ||
    { echo "FAIL: the level of driven water is drawn askew"; exit 1; }
grep -q '^dim, up = 2, \[-0, 1, ' driven/view.py || { echo "FAIL: the view of driven water is tilted"; exit 1; }
python=
for p in python3 /usr/bin/python3; do
    "$p" -c 'import numpy' 2>/dev/null && python=$p && break
done
[ -n "$python" ] || { echo "note: no python3 with numpy: view.py is not run"; grep -q '^    \[1, 0, 0, 2, 0.4, 0\],$' out/view.py; exit; }
"$python" "$root/tests/jobs/view.py" out/view.py
