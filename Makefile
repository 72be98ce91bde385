# Estran. The commands: make demo | check | check-long | test-fast | properties | all | report | stability | bench | deps | install | deb | clean
# SPDX-License-Identifier: BSD-3-Clause
SHELL = /bin/sh
CC = mpicc
B = build
VERSION = 1.0
COMMIT := $(shell git rev-parse --short HEAD 2>/dev/null || echo unknown)

# ---- what it needs, as Debian 12 packages -------------------------------------------------------------
PACKAGES = build-essential pkg-config libopenmpi-dev openmpi-bin libhdf5-openmpi-dev hdf5-tools python3-h5py python3-matplotlib \
           libhypre-dev libsundials-dev libconfig-dev liblapacke-dev libmuparser-dev libcmocka-dev libassimp-dev

# ---- how it is built ----------------------------------------------------------------------------------
# No -ffast-math: it gains nothing here and lets NaN pass unseen. -fno-math-errno frees sqrt. -g1 names lines and functions; more
# than that takes the compiler a quarter of its time (for a debugger: make B=build/debug OPT="-O0 -g").
OPT = -O3 -march=native -fno-math-errno -fno-trapping-math -ffp-contract=fast
WARN = -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi
HDF5_CFLAGS = $(patsubst -I%,-isystem %,$(shell pkg-config --cflags hdf5-openmpi 2>/dev/null))
HDF5_LIBS = $(shell pkg-config --libs hdf5-openmpi 2>/dev/null)
SAN =
flags = -std=c11 -D_GNU_SOURCE -g1 $(OPT) $(WARN) $(HDF5_CFLAGS) -isystem /usr/include/hypre $(SAN)
CFLAGS = $(flags)
# links a test in a third of the time
FAST_LD = $(if $(shell command -v ld.gold 2>/dev/null),-fuse-ld=gold)
LIBS = $(HDF5_LIBS) -llapacke -lconfig -lmuparser -lm
# Reads meshes; without it they are refused.
ASSIMP_LIBS = $(strip $(shell pkg-config --libs assimp 2>/dev/null))
FV_LIBS = -lHYPRE -lsundials_kinsol -lsundials_nvecparallel -lsundials_sunlinsolspgmr

objects = $(filter-out $(UNLINKED:%=$(B)/o/%.o),$(patsubst %.c,$(B)/o/%.o,$(wildcard $(1)/*.c $(1)/*/*.c)))
cpl_o = $(call objects,coupler/client) $(call objects,coupler/transport)
mains = $(B)/o/sph/sph.o $(B)/o/fv/fv.o $(B)/o/coupler/coupler.o
sph_o = $(filter-out $(mains),$(call objects,sph))
fv_o = $(filter-out $(mains),$(call objects,fv))
soname := libcpl.so.$(shell sed -n 's/^ *CPL_VERSION = \([0-9]*\),.*/\1/p' coupler/cpl.h)
coupler_o = $(call objects,coupler/server) $(call objects,coupler/mapping)
version_o = $(B)/o/common/base/version.o

all: $(B)/sph $(B)/fv $(B)/coupler $(B)/$(soname)

$(B)/sph: $(B)/o/sph/sph.o $(version_o) $(B)/o/coupler/cpl_partner.o $(B)/libsph.a $(B)/libcpl.a $(B)/libcommon.a
	@echo "LD $@"
	@$(CC) $(SAN) -o $@ $^ $(ASSIMP_LIBS) $(LIBS)
$(B)/fv: $(B)/o/fv/fv.o $(version_o) $(B)/o/coupler/cpl_partner.o $(B)/libfv.a $(B)/libcpl.a $(B)/libcommon.a
	@echo "LD $@"
	@$(CC) $(SAN) -o $@ $^ $(FV_LIBS) $(ASSIMP_LIBS) $(LIBS)
$(B)/coupler: $(B)/o/coupler/coupler.o $(version_o) $(B)/libcoupler.a $(B)/libcpl.a $(B)/libcommon.a
	@echo "LD $@"
	@$(CC) $(SAN) -o $@ $^ $(LIBS)
$(cpl_o): CFLAGS += -fPIC # for the shared library, too
$(B)/$(soname): $(cpl_o) coupler/cpl.map
	@echo "LD $@"
	@$(CC) $(SAN) -shared -Wl,-soname,$(soname) -Wl,--version-script=coupler/cpl.map -o $@ $(filter %.o,$^) -lm
# what others link: one object that shows cpl_... alone, so that no other name of ours meets one of theirs
$(B)/public/libcpl.a: $(cpl_o)
	@mkdir -p $(@D)
	@rm -f $@; ld -r -o $(@D)/cpl.o $^ && objcopy --wildcard --keep-global-symbol='cpl_*' $(@D)/cpl.o && ar rcs $@ $(@D)/cpl.o
$(B)/libcommon.a: $(filter-out $(version_o),$(call objects,common))
$(B)/libcpl.a: $(cpl_o)
$(B)/libsph.a: $(sph_o)
$(B)/libfv.a: $(fv_o)
$(B)/libcoupler.a: $(coupler_o)
$(B)/lib%.a:
	@rm -f $@; ar rcs $@ $^

# System headers are read once for all files, a fifth of what a compile takes (tests/includes.py finds an include that is missing);
# -O0 is for units
$(B)/system.h: Makefile
	@mkdir -p $@.gch
	@printf '#include <%s.h>\n' errno float limits math mpi stdarg stdbool stdint stdio stdlib string >$@
$(B)/system.h.gch/%: $(B)/system.h
	@$(CC) $(flags) $(filter -O0,-$*) -x c-header -c -o $@ $<
$(B)/o/%.o: %.c | $(B)/system.h.gch/OPT $(B)/system.h.gch/O0
	@mkdir -p $(@D)
	@echo "CC $@"
	@$(CC) $(CFLAGS) -include $(B)/system.h -MMD -MP -c -o $@ $<
ifneq ($(ASSIMP_LIBS),)
$(B)/o/common/geometry/trimesh_read.o: CFLAGS += -DHAVE_ASSIMP $(patsubst -I%,-isystem %,$(shell pkg-config --cflags assimp))
endif
# the script beside each run's output, as lines of C
$(B)/o/common/run/run_view.o: $(B)/o/common/run/view.inc
$(B)/o/common/run/run_view.o: CFLAGS += -I$(B)/o/common/run
$(B)/o/common/run/view.inc: common/run/view.py
	@mkdir -p $(@D)
	@sed 's/[\\"]/\\&/g; s/.*/"&\\n",/' $< >$@
# anew with each commit, and with it the programs; tests do not mind
$(version_o): CFLAGS += -DVERSION='"$(VERSION)"' -DCOMMIT='"$(COMMIT)"'
$(version_o): $(wildcard .git/logs/HEAD)

# ---- tests: unit/ is one program, jobs/ scripts and their partners (mock*.c know cpl.h alone) ----------------
bench_bin = $(patsubst tests/bench/%.c,$(B)/tests/%,$(wildcard tests/bench/bench_*.c))
tests_bin = $(B)/tests/units $(B)/tests/toy
mocks = $(B)/tests/mock $(B)/tests/mock_any $(B)/tests/mock_calls
$(mocks): $(B)/tests/%: $(B)/o/tests/jobs/%.o $(B)/libcpl.a
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(CC) $(SAN) -o $@ $^ -lm
$(B)/o/coupler/examples/%.o: CFLAGS += -Icoupler
examples = $(B)/examples/heat $(B)/examples/plate $(B)/examples/spring
examples: $(examples)
$(examples): $(B)/examples/%: $(B)/o/coupler/examples/%.o $(B)/public/libcpl.a # as an outsider would
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(CC) $(SAN) -o $@ $^ -lm
$(bench_bin): $(B)/tests/%: $(B)/o/tests/bench/%.o
$(B)/tests/toy: $(B)/o/tests/jobs/toy.o
$(B)/tests/units: $(patsubst %.c,$(B)/o/%.o,$(wildcard tests/unit/unit.c tests/unit/*/test_*.c))
$(tests_bin) $(bench_bin): $(B)/libsph.a $(B)/libfv.a $(B)/libcoupler.a $(B)/libcpl.a $(B)/libcommon.a | $(version_o)
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(CC) $(SAN) $(FAST_LD) -o $@ $(filter %.o,$^) $(version_o) -Wl,--start-group $(filter %.a,$^) -Wl,--end-group $(FV_LIBS) $(ASSIMP_LIBS) $(LIBS) -lcmocka
preloaded = $(B)/tests/kill_at.so $(B)/tests/starts.so
$(preloaded): $(B)/tests/%.so: tests/jobs/%.c
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(CC) $(filter-out -MMD,$(CFLAGS)) -shared -fPIC -o $@ $< -ldl
# the tests' own lines take little of their time, and more than half of the compiler's if it is to make them fast
$(B)/o/tests/unit/%.o: CFLAGS += -O0 -DUNIT=$(basename $(@F))
units: $(tests_bin)
tests: all $(tests_bin) $(mocks) $(examples) $(preloaded)
# what no unit links is not compiled for them; one that comes to need it is told so by the linker
unlinked = $(basename $(wildcard coupler/server/*.c)) common/run/solids fv/output/fv_draw \
    $(addprefix sph/case/,first_water sph_body_paths sph_meshes sph_params sph_sense sph_unused standard_check) sph/bodies/body_backs \
    sph/bodies/body_check $(addprefix sph/coupling/,body_coupling body_water coupling_check coupling_solids sph_coupling) \
    sph/refinement/regions_describe sph/walls/wall_ends
# (a pointer that overflows is one past memory, too; nothing is warned of twice)
asan:
	@$(MAKE) --no-print-directory B=$(B)/asan OPT="-Og -march=native -fno-math-errno" WARN=-w UNLINKED="$(unlinked)" \
	    SAN="-fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,pointer-overflow -fno-sanitize-recover=all -fno-omit-frame-pointer" units

# ---- what a user types ---------------------------------------------------------------------------------
deps:
	@cases/deps $(PACKAGES)
demo: deps
	@$(MAKE) --no-print-directory -j2 all
	@cases/demo
check: deps
	@$(MAKE) --no-print-directory -j2 tests
	@$(MAKE) --no-print-directory -j2 asan
	@tests/run $(B)
check-long: $(bench_bin) # the same with all random scenes and finer ones
	@LONG=1 $(MAKE) --no-print-directory check
test-fast: # units alone, for development
	@$(MAKE) --no-print-directory -j2 tests
	@FAST=1 tests/run $(B)
properties: all $(preloaded) # SEED=, N= or MINUTES=, JOBS=, KEEP=
	@tests/properties/run $(B)
report: all
	@cases/report
stability: all
	@cases/stability
bench: tests $(bench_bin)
	@cases/bench $(B)
clean:
	rm -rf build

# ---- make install: prefix=/usr/local, DESTDIR= (for packages) --------------------------------------------
prefix = /usr/local
bindir = $(prefix)/bin
libdir = $(prefix)/lib
includedir = $(prefix)/include
datadir = $(prefix)/share/estran
D = $(DESTDIR)
case_files = $(filter-out %.png %.svg %.pyc,$(wildcard cases/*/*.*)) $(addprefix cases/,run tune plot new sweep ensemble report report.list parameters.md job.slurm)
progdir = $(libdir)/estran
programs = sph fv coupler
scripts = run plot new sweep ensemble
completions = $(prefix)/share/bash-completion/completions
install: all $(B)/public/libcpl.a
	@install -d $(D)$(bindir) $(D)$(progdir) $(D)$(libdir)/pkgconfig $(D)$(includedir) $(D)$(datadir)/python $(D)$(datadir)/examples $(D)$(completions)
	@install $(addprefix $(B)/,$(programs)) $(D)$(progdir)
	@for p in $(programs); do printf '#!/bin/sh\nexec %s/%s "$$@"\n' $(progdir) $$p >$(D)$(bindir)/estran-$$p && chmod 755 $(D)$(bindir)/estran-$$p || exit 1; done
	@for p in $(scripts); do printf '#!/bin/sh\nESTRAN_BUILD=$${ESTRAN_BUILD:-%s} exec %s/cases/%s "$$@"\n' $(progdir) $(datadir) $$p >$(D)$(bindir)/estran-$$p && \
	    chmod 755 $(D)$(bindir)/estran-$$p || exit 1; done
	@install -m 644 coupler/cpl.h $(D)$(includedir)
	@install -m 644 $(B)/public/libcpl.a $(D)$(libdir)
	@install $(B)/$(soname) $(D)$(libdir) && ln -sf $(soname) $(D)$(libdir)/libcpl.so
	@install -m 644 coupler/python/cpl.py $(D)$(datadir)/python
	@install -m 644 coupler/examples/* $(D)$(datadir)/examples
	@for f in $(case_files); do install -D -m $$([ -x $$f ] && echo 755 || echo 644) $$f $(D)$(datadir)/$$f || exit 1; done
	@install -m 644 cases/completion.bash $(D)$(completions)/estran-run
	@for p in plot sweep ensemble sph fv; do ln -sf estran-run $(D)$(completions)/estran-$$p; done
	@! command -v help2man >/dev/null || { install -d $(D)$(prefix)/share/man/man1 && for p in $(programs) $(scripts); do \
	    help2man --no-info --no-discard-stderr --version-string=$(VERSION) -n "estran-$$p of Estran, free-surface flow" -o $(D)$(prefix)/share/man/man1/estran-$$p.1 \
	        $$(case " $(scripts) " in *" $$p "*) echo cases;; *) echo $(B);; esac)/$$p || exit 1; done; }
	@printf 'prefix=%s\nlibdir=%s\nincludedir=%s\n\nName: cpl\nDescription: %s\nVersion: %s\nLibs: -L$${libdir} -lcpl\nLibs.private: -lm -lpthread\nCflags: -I$${includedir}\n' \
	    $(prefix) $(libdir) $(includedir) 'client library of the Estran coupler (compile and link with mpicc)' $(VERSION) >$(D)$(libdir)/pkgconfig/cpl.pc
	@echo "installed below $(D)$(prefix); as a shared library: ldconfig, or LD_LIBRARY_PATH=$(libdir)"
uninstall:
	rm -f $(addprefix $(D)$(bindir)/estran-,$(programs) $(scripts)) $(addprefix $(D)$(libdir)/,libcpl.a libcpl.so $(soname) pkgconfig/cpl.pc) $(D)$(includedir)/cpl.h
	rm -f $(addprefix $(D)$(prefix)/share/man/man1/estran-,$(addsuffix .1,$(programs) $(scripts))) $(addprefix $(D)$(completions)/estran-,run plot sweep ensemble sph fv)
	rm -rf $(D)$(datadir) $(D)$(progdir)
# build/estran_VERSION_ARCH.deb of what make install installs, for this kind of processor (-march=native)
arch := $(shell dpkg --print-architecture 2>/dev/null)
depends = openmpi-bin, libopenmpi3, libhdf5-openmpi-103-1, libhypre-2.26.0, libsundials-kinsol6, libsundials-nvecparallel-mpi6, libconfig9, libmuparser2v5, libassimp5, python3-h5py, python3-matplotlib
deb: all
	@rm -rf $(B)/deb && $(MAKE) --no-print-directory install prefix=/usr DESTDIR=$(abspath $(B))/deb >/dev/null
	@install -D -m 644 LICENSE $(B)/deb/usr/share/doc/estran/copyright && mkdir $(B)/deb/DEBIAN
	@printf 'Package: estran\nVersion: %s\nArchitecture: %s\nMaintainer: Estran <dev@estran>\nDepends: %s\nSuggests: ffmpeg, paraview\nDescription: %s\n' \
	    $(VERSION) $(arch) '$(depends)' 'free-surface flow by SPH and finite volumes, alone or coupled' >$(B)/deb/DEBIAN/control
	@dpkg-deb --root-owner-group --build $(B)/deb $(B)/estran_$(VERSION)_$(arch).deb

-include $(shell find $(B) -name '*.d' 2>/dev/null)
.SECONDARY:
.PHONY: examples install uninstall deb all tests units asan deps demo check check-long test-fast properties report stability bench clean
