#!/bin/sh
# Two treatments within one support, water at rest or a uniform stream, against laws (tests/properties/pairs.py): a scene of
# each pair, drawn by its seed, of the smallest of 80 that keep the laws with a fifth to spare where there are such. LONG=1: also the
# second scenes of some, and pairs that are dear and whose treatments stand in another pair below.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
more="body-side:13 line-period:46 body-sunk:34 wedge-floor:2 wedge-body:1 body-stack:1 flap-floor:2 shut-slab:8 body-edge:32 period-edge:53 \
    afloat-edge:7 mesh-side:7 mesh-across:1 thin-rim:5 hinged-surface:45 driven-side:4 box-surface:38 opening-body:6 \
    period-across-edge:4 shut-slab:2 body-roof:1 wedge-floor:1 body-sunk:1"
[ -n "$LONG" ] || more=
# one of them may break a law by other roundings
python3 "$root/tests/properties/pairs.py" --build "$b" --most 1 body-floor:5 body-corner:32 body-period:53 line-period:45 body-body:44 \
    polygon-floor:60 body-stack:5 flap-floor:5 body-surface:38 body-lid:46 side-edge:32 \
    side-surface:44 ghost-surface:13 line-line:45 free-side:53 side-surface3:70 mesh-period:46 thin-side:22 hinged-side:13 driven-surface:56 \
    fall-floor:4 fv-side-surface:32 fv-blocked-surface:4 box-body:60 opening-side:63 absorbing-side:20 fv-opening-side:45 $more >pairs.txt 2>&1 ||
    bad "pairs of treatments" pairs.txt
echo "pairs: $(tail -n 1 pairs.txt); $failed faults"
[ $failed = 0 ]
