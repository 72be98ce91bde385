#!/bin/sh
# make install: what it puts where, that others can compile, link and run with it, and that uninstall leaves nothing.
# SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
unset MAKEFLAGS MAKELEVEL
mpi="timeout -k 1 60 $mpi"
bad() { echo "FAIL: $*"; tail -n 5 text 2>/dev/null; failed=$((failed + 1)); }
install() { make -C "$root" --no-print-directory B="$b" "$@" >text 2>&1 || bad "make $*"; }

install install prefix="$tmp/p"
so=$(sed -n 's/^ *CPL_VERSION = \([0-9]*\),.*/libcpl.so.\1/p' "$root/coupler/cpl.h")
for f in bin/estran-sph bin/estran-fv bin/estran-coupler bin/estran-run bin/estran-plot lib/libcpl.a lib/libcpl.so "lib/$so" lib/pkgconfig/cpl.pc include/cpl.h \
    share/estran/python/cpl.py share/estran/examples/heat.c share/estran/cases/taylor_green/case.cfg share/estran/cases/estran/reading.py; do
    [ -e "p/$f" ] || bad "$f is not installed"
done
[ "$(objdump -p "p/lib/$so" | awk '$1 == "SONAME" { print $2 }')" = "$so" ] || bad "the shared library has another name within"
# nothing but cpl_... can meet names of others
found=$(nm -D --defined-only "p/lib/$so" | awk '$3 !~ /^cpl_/ { print $3 }')$(nm -g --defined-only p/lib/libcpl.a | awk 'NF == 3 && $3 !~ /^cpl_/ { print $3 }')
[ -z "$found" ] || bad "the libraries show: $found"

# an outsider: C with both libraries, C++ reads the header, pkg-config knows where
export PKG_CONFIG_PATH="$tmp/p/lib/pkgconfig"
cp p/share/estran/examples/heat.c .
# shellcheck disable=SC2046
mpicc -std=c11 -Wall -Wextra -Werror -o shared heat.c $(pkg-config --cflags --libs cpl) -lm >text 2>&1 || bad "heat.c with libcpl.so"
# shellcheck disable=SC2046
mpicc -std=c11 -o static heat.c $(pkg-config --cflags cpl) p/lib/libcpl.a -lm >text 2>&1 || bad "heat.c with libcpl.a"
printf '#include <cpl.h>\nint main() { return cpl_version() != CPL_VERSION; }\n' >plus.cc
# shellcheck disable=SC2046
mpicxx -std=c++11 -DOMPI_SKIP_MPICXX -Wall -Wextra -Werror -o plus plus.cc $(pkg-config --cflags --libs cpl) >text 2>&1 || bad "cpl.h from C++"
LD_LIBRARY_PATH="$tmp/p/lib" ./plus || bad "the library has another version than the header"
ldd shared | grep -q "$so" || bad "heat.c is not linked with $so"
$mpi -np 1 env LD_LIBRARY_PATH="$tmp/p/lib" ./shared left o 10 : -np 1 p/bin/estran-coupler p/share/estran/examples/heat.cfg -o o --force \
    : -np 1 ./static right o 10 >text 2>&1 || bad "a job of what was installed"
p/bin/estran-run taylor_green --check >text 2>&1 || bad "estran-run"
[ -z "$ESTRAN_BUILD" ] && { grep -q 'taylor_green' text || bad "estran-run says nothing of the case"; }

install uninstall prefix="$tmp/p"
[ -z "$(find p ! -type d)" ] || bad "uninstall leaves $(find p ! -type d)"

# for packages: below DESTDIR, but speaks of prefix
install install prefix=/usr/nowhere DESTDIR="$tmp/d"
grep -q '^libdir=/usr/nowhere/lib$' d/usr/nowhere/lib/pkgconfig/cpl.pc || bad "cpl.pc below DESTDIR: $(cat d/usr/nowhere/lib/pkgconfig/cpl.pc)"
grep -q '/usr/nowhere/lib/estran' d/usr/nowhere/bin/estran-run || bad "estran-run below DESTDIR"
install uninstall prefix=/usr/nowhere DESTDIR="$tmp/d"
[ -z "$(find d ! -type d)" ] || bad "uninstall leaves $(find d ! -type d)"
[ $failed = 0 ]
