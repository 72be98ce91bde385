#!/bin/sh
# Error of the velocity where the case refines, and elsewhere, over U: root of the mean square over the particles
# there. usage: cases/apr_vortices/inside.sh DIR        (of the last snapshot)        SPDX-License-Identifier: BSD-3-Clause
dir=${1:?usage: inside.sh DIR}
tmp=$(mktemp -d) || exit 1
trap 'rm -rf "$tmp"' EXIT
for f in "$dir"/sph_[0-9]*.h5; do :; done
numbers() { # of dataset $1, a line for each particle with $2 of them
    h5dump -d "/$1" -y -w 0 -m '%.9g' -o "$tmp/raw" "$f" >"$tmp/said" &&
        tr -d ' \n' <"$tmp/raw" | tr ',' '\n' | awk -v n="$2" '{ printf "%s%s", $1, NR % n ? " " : "\n" }'
}
time=$(h5dump -a /time "$f" | sed -n 's/^ *(0): *//p')
numbers position 2 >"$tmp/x"
numbers velocity 3 >"$tmp/u"
has_level=$(h5dump -n "$f" | grep -c '/level$')
if [ "$has_level" = 1 ]; then numbers level 1 >"$tmp/l"; else sed 's/.*/0/' "$tmp/x" >"$tmp/l"; fi
paste "$tmp/x" "$tmp/u" "$tmp/l" | awk -v t="$time" '
    { k = 8 * atan2(1, 1); d = exp(-2 * k * k * 0.005 * t); w = 4 ^ -$6
      a = $3 - d * sin(k * $1) * cos(k * $2); b = $4 + d * cos(k * $1) * sin(k * $2)
      in_box = $1 > 0.38 && $1 < 0.62 && $2 > 0.38 && $2 < 0.62
      e[in_box] += w * (a * a + b * b); n[in_box] += w; count[in_box]++ }
    END { printf "inside %.6f  outside %.6f  particles %d %d\n", sqrt(e[1] / n[1]), sqrt(e[0] / n[0]), count[1], count[0] }'
